#include "bench/claims/claims.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace vantage::bench {

double quotient(double above, double below) {
  const double value = above / below;
  if (!std::isfinite(value)) throw NotRun(fmt::format("{} / {}", above, below));
  return value;
}

Finding held(std::string source, std::string claim, const std::function<Measured()>& measure) {
  Finding finding{std::move(source), std::move(claim), {}, Verdict::not_run, {}};
  try {
    Measured measured = measure();
    finding.measured = std::move(measured.text);
    finding.verdict = measured.holds ? Verdict::yes : Verdict::no;
    if (!measured.holds) finding.why = std::move(measured.why);
  } catch (const NotRun& missing) {
    finding.measured = missing.what();
  }
  return finding;
}

std::string findings_table(const std::vector<Finding>& findings) {
  std::string text =
      "| claim or goal | what it says | here | holds | if not, why |\n"
      "|---|---|---|---|---|\n";
  for (const Finding& f : findings) {
    const char* verdict = f.verdict == Verdict::yes  ? "yes"
                          : f.verdict == Verdict::no ? "**no**"
                                                     : "not run";
    text +=
        fmt::format("| {} | {} | {} | {} | {} |\n", f.source, f.claim, f.measured, verdict, f.why);
  }
  return text;
}

}  // namespace vantage::bench
