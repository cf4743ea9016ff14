/// What a broken planner may say.
#pragma once

#include <string>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage::support {

/// Answers that are almost right: pieces of good ones, put together at random, and bytes of any
/// kind among them.
inline std::string made_up_answer(Rng& rng) {
  static const std::vector<std::string> pieces{"{",
                                               "}",
                                               "[",
                                               "]",
                                               ":",
                                               ",",
                                               "\"view\"",
                                               "\"pose\"",
                                               "\"protocol\"",
                                               "\"version\"",
                                               "\"vantage-planner\"",
                                               "1",
                                               "0",
                                               "2",
                                               "-1",
                                               "1e999",
                                               "0.5",
                                               "-0.25",
                                               "1e-320",
                                               "null",
                                               "true",
                                               "NaN",
                                               "18446744073709551616",
                                               "\"",
                                               "\\u0000",
                                               "\\ud800",
                                               " ",
                                               "\r",
                                               "\n",
                                               "\n\n",
                                               "{\"view\": 1}\n",
                                               "{\"pose\": [0.1, 0.2, 0.3]}\n",
                                               "[[[[[[[[",
                                               "\xff\xfe",
                                               "\xe2\x82"};
  std::string text;
  const std::size_t count = 1 + rng.uniform_index(12);
  for (std::size_t i = 0; i < count; ++i) {
    if (rng.uniform() < 0.1) {
      text += static_cast<char>(rng.uniform_index(256));
    } else if (rng.uniform() < 0.005) {
      text += std::string(rng.uniform_index(5000), rng.uniform() < 0.5 ? '[' : '{');
    } else {
      text += pieces[rng.uniform_index(pieces.size())];
    }
  }
  return text;
}

}  // namespace vantage::support
