// Of episodes that need not come to a value: those that do not get there, or fail before.
#include <fmt/format.h>

#include "bench/tables/study_tables.hpp"

namespace vantage::bench {

std::vector<Sample> StudyTables::arrivals(const std::string& name, const std::string& panel,
                                          const std::string& level) const {
  for (const Episode& e : episodes_) {
    if (e.row != nullptr || !is_of(e, panel, level_of(name, level))) continue;
    throw NotRun(fmt::format("`{}` of `{}`: {} is not run", name, level, e.name));
  }
  return samples(name, panel, level);
}

std::vector<Sample> StudyTables::whether_arrived(const std::string& name, const std::string& panel,
                                                 const std::string& level) const {
  const std::size_t wanted = level_of(name, level);
  std::vector<Sample> found;
  for (const Episode& e : episodes_) {
    if (!is_of(e, panel, wanted)) continue;
    found.push_back(sample_at(e.place, wanted, value_of(e, name) ? 1.0 : 0.0));
  }
  return found;
}

std::vector<double> StudyTables::values(const std::string& name, const std::string& panel,
                                        const std::string& level, double of_failed) const {
  const std::size_t wanted = level_of(name, level);
  std::vector<double> values;
  for (const Episode& e : episodes_) {
    if (!is_of(e, panel, wanted)) continue;
    const auto value = value_of(e, name);
    if (!value && !(has_failed(e) && has(name))) {
      throw NotRun(fmt::format("`{}` of `{}`: {} has none", name, level, e.name));
    }
    values.push_back(value.value_or(of_failed));
  }
  return values;
}

double StudyTables::mean(const std::string& name, const std::string& panel,
                         const std::string& level, double of_failed) const {
  return vantage::mean(values(name, panel, level, of_failed));
}

}  // namespace vantage::bench
