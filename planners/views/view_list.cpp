#include "vantage/planners/views/view_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMaxViews = 20'000;  // a file of more is most likely not one of views

enum Column : std::size_t { kX, kY, kZ, kYaw, kPitch, kId, kColumns };
constexpr std::array<std::string_view, kColumns> kNames{"x_m",     "y_m",       "z_m",
                                                        "yaw_rad", "pitch_rad", "id"};
constexpr std::size_t kRequired = 4;
constexpr double kMaxDistance_m = 1e6;

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    fields.push_back(trim(line.substr(at, comma - at)));
    if (comma == std::string_view::npos) return fields;
    at = comma + 1;
  }
}

template <class Number>
bool parse(std::string_view text, Number& number) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stopped == end;
}

class ViewReader {
 public:
  explicit ViewReader(std::string name) : name_(std::move(name)) {}

  std::vector<Candidate> read(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const std::string_view line = trim(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line_;
      if (line.empty()) continue;
      columns_.empty() ? take_header(split(line)) : take_view(split(line));
    }
    if (columns_.empty()) throw InputError(name_ + ": is empty, expected " + header());
    if (views_.empty()) throw InputError(name_ + ": no view below the header");
    return std::move(views_);
  }

 private:
  static std::string header() { return "a header x_m,y_m,z_m,yaw_rad[,pitch_rad][,id]"; }

  void take_header(const std::vector<std::string_view>& fields) {
    for (const std::string_view field : fields) {
      const auto found = std::ranges::find(kNames, field);
      if (found == kNames.end()) {
        fail(fmt::format("unknown column '{}'; expected {}", field.substr(0, 40), header()));
      }
      const auto column = static_cast<Column>(found - kNames.begin());
      if (has(column)) fail(fmt::format("column {} is there twice", field));
      columns_.push_back(column);
    }
    for (std::size_t i = 0; i < kRequired; ++i) {
      if (!has(static_cast<Column>(i))) fail(fmt::format("column {} is missing", kNames[i]));
    }
  }

  void take_view(const std::vector<std::string_view>& fields) {
    if (fields.size() != columns_.size()) {
      fail(fmt::format("{} fields, the header has {}", fields.size(), columns_.size()));
    }
    if (views_.size() == kMaxViews) fail(fmt::format("more than {} views", kMaxViews));
    std::array<double, kId> values{};
    Candidate view;
    view.id = static_cast<int>(views_.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (columns_[i] == kId) {
        view.id = id_of(fields[i]);
      } else {
        values[columns_[i]] = number_of(columns_[i], fields[i]);
      }
    }
    view.T_world_sensor =
        make_pose({values[kX], values[kY], values[kZ]}, values[kYaw], values[kPitch]);
    views_.push_back(view);
  }

  int id_of(std::string_view field) {
    int id = 0;
    if (!parse(field, id) || id < 0) wrong(kId, "a whole number >= 0", field);
    if (!ids_.insert(id).second) fail(fmt::format("column id: {} is there twice", id));
    return id;
  }

  double number_of(Column column, std::string_view field) const {
    double value = 0.0;
    if (!parse(field, value) || !std::isfinite(value)) wrong(column, "a finite number", field);
    const double max_value = column == kPitch ? std::numbers::pi / 2.0 + 1e-9 : kMaxDistance_m;
    if (std::abs(value) > max_value) {
      fail(fmt::format("column {}: {} is not in [{:.6g}, {:.6g}]", kNames[column], value,
                       -max_value, max_value));
    }
    return value;
  }

  [[nodiscard]] bool has(Column column) const {
    return std::ranges::find(columns_, column) != columns_.end();
  }
  [[noreturn]] void wrong(Column column, std::string_view expected, std::string_view got) const {
    fail(fmt::format("column {}: expected {}, got '{}'", kNames[column], expected,
                     got.substr(0, 40)));
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, why));
  }

  std::string name_;
  std::size_t line_ = 0;
  std::vector<Column> columns_;
  std::set<int> ids_;
  std::vector<Candidate> views_;
};

}  // namespace

std::vector<Candidate> read_views(const std::filesystem::path& path) {
  return ViewReader(path.string()).read(read_file(path));
}

std::string views_csv(std::span<const Candidate> views) {
  std::string text = fmt::format("{}\n", fmt::join(kNames, ","));
  for (const Candidate& view : views) {
    const Eigen::Vector3d p = view.T_world_sensor.translation();
    text += fmt::format("{},{},{},{},{},{}\n", p.x(), p.y(), p.z(), yaw_of(view), pitch_of(view),
                        view.id);
  }
  return text;
}

double yaw_of(const Candidate& view) {
  // Of the left axis, which stays level, for views straight up or down as well.
  const Eigen::Vector3d left = view.T_world_sensor.linear().col(1);
  return std::atan2(0.0 - left.x(), left.y());
}

double pitch_of(const Candidate& view) {
  const Eigen::Vector3d forward = view.T_world_sensor.linear().col(0);
  return std::asin(std::clamp(0.0 - forward.z(), -1.0, 1.0));
}

}  // namespace vantage
