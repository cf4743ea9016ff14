#include "vantage/report/report_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

[[noreturn]] void malformed(const std::filesystem::path& path, std::size_t line,
                            const std::string& why) {
  throw InputError(fmt::format("{}:{}: {}", path.string(), line, why));
}

/// Whole lines without their end, be it "\n" or "\r\n".
bool next_line(std::istringstream& stream, std::string& line) {
  if (!std::getline(stream, line)) return false;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

std::optional<std::vector<std::string>> split_csv(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (quoted) return std::nullopt;
  return fields;
}

}  // namespace

std::vector<TrajectorySample> read_tum(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (text.empty()) malformed(path, 1, "the file is empty");
  std::istringstream stream(text);
  std::vector<TrajectorySample> samples;
  std::string line;
  for (std::size_t number = 1; next_line(stream, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    std::array<double, 8> v{};
    for (double& value : v) {
      if (!(fields >> value) || !std::isfinite(value)) {
        malformed(path, number, "expected 8 numbers: time x y z qx qy qz qw");
      }
    }
    const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
    if (q.norm() < 1e-6) malformed(path, number, "the quaternion is zero");
    const Eigen::Vector3d heading = q.normalized() * Eigen::Vector3d::UnitX();
    samples.push_back(
        {v[0], {v[1], v[2], v[3]}, std::atan2(heading.y(), heading.x()), q.normalized()});
  }
  return samples;
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::istringstream stream(read_file(path));
  CsvTable table;
  std::string line;
  for (std::size_t number = 1; next_line(stream, line); ++number) {
    if (line.empty()) continue;
    auto fields = split_csv(line);
    if (!fields) malformed(path, number, "a quote is not closed");
    if (table.columns.empty()) {
      table.columns = std::move(*fields);
    } else if (fields->size() != table.columns.size()) {
      malformed(path, number,
                fmt::format("{} fields, the header has {}", fields->size(), table.columns.size()));
    } else {
      table.rows.push_back(std::move(*fields));
    }
  }
  if (table.columns.empty()) malformed(path, 1, "no header line");
  return table;
}

std::string csv_field(std::string_view text) {
  std::string field;
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c == '\n' || c == '\r' ? ' ' : c;
  }
  return field.find_first_of(",\"") == std::string::npos ? field : '"' + field + '"';
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

}  // namespace vantage
