// The claim of a sweep's worker on an episode, in a folder that several machines share.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/study/cluster/claims.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  folder.put("claims/1.json", bytes);
  const auto claim = claim_in_force(folder.path() / "claims");
  if (claim) holder_lives(*claim, {}, {});
}

}  // namespace vantage::fuzz
