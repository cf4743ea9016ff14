#include "vantage/cli/outcome_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace vantage {
namespace {
namespace fs = std::filesystem;

void print_mapping(const nlohmann::ordered_json& metrics) {
  const auto& scans = metrics["scans"];
  const auto total = metrics["observable_cells"].get<double>();
  const double left =
      scans.empty() ? total : scans.back()["observable_unobserved_cells"].get<double>();
  fmt::print("{}: {} after {} scans, {:.1f} % of the observable cells observed\n",
             metrics["method"].get<std::string>(), metrics["status"].get<std::string>(),
             scans.size(), total > 0.0 ? 100.0 * (1.0 - left / total) : 0.0);
  fmt::print(
      "path {:.2f} m, {} collisions, map precision {:.3f}, recall {:.3f}, {:.1f} x real time\n",
      metrics["path_length_m"].get<double>(), metrics["collisions"].get<int>(),
      metrics["map"]["precision"].get<double>(), metrics["map"]["recall"].get<double>(),
      metrics["real_time_factor"].get<double>());
}

void print_recognition(const nlohmann::ordered_json& metrics) {
  const auto text = [&](const char* key) {
    return metrics[key].is_string() ? metrics[key].get<std::string>() : "nothing yet";
  };
  fmt::print("{}: {} after {} views, recognised {}, which is {} ({})\n", text("method"),
             text("status"), metrics["observations"].size(), text("estimate"),
             metrics["correct"].get<bool>() ? "right" : "wrong", text("truth"));
  fmt::print("entropy {:.2f} bit, path {:.2f} m, {} collisions, {:.1f} x real time\n",
             metrics["entropy_bits"].get<double>(), metrics["path_length_m"].get<double>(),
             metrics["collisions"].get<int>(), metrics["real_time_factor"].get<double>());
}

void print_trajectory(const nlohmann::ordered_json& metrics) {
  const auto number = [&](const char* key) { return metrics[key].get<double>(); };
  int correct = 0;
  for (const auto& object : metrics["objects"]) correct += object["correct"].get<bool>() ? 1 : 0;
  fmt::print("{}: {} after {:.1f} s, recognised {} of {} objects in {} observations\n",
             metrics["method"].get<std::string>(), metrics["status"].get<std::string>(),
             number("flight_time_s"), correct, metrics["objects"].size(),
             metrics["observations_total"].get<int>());
  fmt::print(
      "mean entropy {:.3f} nats, clearance {:.2f} m, path {:.2f} m, {} collisions, {:.1f} x real "
      "time\n",
      number("mean_entropy_nats"), number("minimum_clearance_m"), number("path_length_m"),
      metrics["collisions"].get<int>(), number("real_time_factor"));
}

void print_change(const nlohmann::ordered_json& metrics) {
  const auto text = [&](const char* key) {
    return metrics[key].is_string() ? metrics[key].get<std::string>() : "nothing yet";
  };
  fmt::print("{}: {} after {} views, changed: {}, which is {} ({})\n", text("method"),
             text("status"), metrics["observations"].size(), text("decision"),
             metrics["correct"].get<bool>() ? "right" : "wrong", text("scenario"));
  const auto& probability = metrics["change_probability"];
  fmt::print("probability of a change {}, path {:.2f} m, {} collisions, {:.1f} x real time\n",
             probability.is_number() ? fmt::format("{:.3f}", probability.get<double>()) : "unknown",
             metrics["path_length_m"].get<double>(), metrics["collisions"].get<int>(),
             metrics["real_time_factor"].get<double>());
}

}  // namespace

void print_outcome(const RunOutcome& outcome) {
  const auto metrics = nlohmann::ordered_json::parse(outcome.metrics);
  if (metrics.contains("objects")) {
    print_trajectory(metrics);
  } else if (metrics.contains("change_probability")) {
    print_change(metrics);
  } else if (metrics.contains("observations")) {
    print_recognition(metrics);
  } else {
    print_mapping(metrics);
  }
  fmt::print("state hash {}\n", metrics["state_hash"].get<std::string>());
  if (fs::exists(outcome.directory / "report.html")) {
    fmt::print("report {}\n", (outcome.directory / "report.html").string());
  }
  if (fs::exists(outcome.directory / "video.mp4")) {
    fmt::print("video  {}\n", (outcome.directory / "video.mp4").string());
  }
}

}  // namespace vantage
