// An episode.
#include "vantage/tasks/episode.hpp"

#include "tests/fuzz/fuzz_target.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const ResolvedEpisode episode = load_episode(folder.put("episode.yaml", bytes), {});
  load_episode(folder.put("again.yaml", episode_yaml(episode)), {});
}

}  // namespace vantage::fuzz
