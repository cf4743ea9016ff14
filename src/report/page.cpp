#include "vantage/report/page.hpp"

#include <algorithm>

#include "generated/report_assets.hpp"
#include "vantage/core/error.hpp"

namespace vantage {

std::string html_escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      case '\'': safe += "&#39;"; break;
      default: safe += c;
    }
  }
  return safe;
}

std::string filled_page(std::string_view asset, std::span<const Replacement> replacements) {
  std::string_view page = embedded_asset(asset);
  std::string filled;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{")) {
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    filled.append(page.substr(0, open));
    page.remove_prefix(close + 2);
    if (name == "style") {
      filled.append(embedded_asset("style.css"));
      continue;
    }
    const auto match = std::ranges::find(replacements, name, &Replacement::name);
    expects(match != replacements.end(), "every slot of the page is known");
    filled.append(match->text);
  }
  return filled.append(page);
}

}  // namespace vantage
