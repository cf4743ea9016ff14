// A study, planned.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/study/study_reading.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  StudyReading reading = read_study_file(folder.put("study.yaml", bytes), {});
  plan_episodes(reading.study, reading.problems);
}

}  // namespace vantage::fuzz
