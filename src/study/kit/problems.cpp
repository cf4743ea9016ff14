#include "vantage/study/kit/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {

void Problems::add(const std::string& text, ExitCode code) {
  if (std::ranges::find(texts_, text) != texts_.end()) return;
  texts_.push_back(text);
  code_ = code_ == ExitCode::usage ? code_ : code;
}

void Problems::throw_if_any() const {
  if (texts_.empty()) return;
  if (code_ == ExitCode::usage) throw ConfigError(texts_);
  throw InputError(texts_.size() == 1
                       ? texts_.front()
                       : fmt::format("{} (and {} more)", texts_.front(), texts_.size() - 1));
}

}  // namespace vantage
