/// The parts that the static pages share.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vantage {

std::string html_escaped(std::string_view text);

struct Replacement {
  std::string_view name;
  std::string text;
};

/// The embedded page of that name with each {{slot}} replaced in one pass: inserted text is never
/// looked at again. The slot `style` is filled with style.css.
std::string filled_page(std::string_view asset, std::span<const Replacement> replacements);

}  // namespace vantage
