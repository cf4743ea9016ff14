#include "vantage/models/catalogue/shapes/obj.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <utility>

#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

/// Lines of one kind, each distinct one written once and numbered from 1.
class LineTable {
 public:
  int index_of(std::string line) {
    const auto next = static_cast<int>(index_.size()) + 1;
    const auto [entry, inserted] = index_.try_emplace(std::move(line), next);
    if (inserted) text_ += entry->first;
    return entry->second;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::unordered_map<std::string, int> index_;
  std::string text_;
};

std::string fixed(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

std::string line(std::string_view key, const Eigen::VectorXd& values, int decimals) {
  std::string text(key);
  for (const double x : values) text += ' ' + fixed(x, decimals);
  return text + '\n';
}

}  // namespace

std::string to_obj(const TriangleMesh& mesh) {
  LineTable points;
  LineTable uvs;
  LineTable normals;
  std::vector<std::array<int, 3>> vertex;  // v, vt, vn of each vertex
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    vertex.push_back({points.index_of(line("v", mesh.positions_m[i], 5)),
                      uvs.index_of(line("vt", mesh.uvs[i], 4)),
                      normals.index_of(line("vn", mesh.normals[i], 3))});
  }
  std::string faces;
  for (const auto& triangle : mesh.triangles) {
    std::array<std::array<int, 3>, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) corner[k] = vertex[static_cast<std::size_t>(triangle[k])];
    const int a = corner[0][0];
    const int b = corner[1][0];
    const int c = corner[2][0];
    if (a == b || b == c || c == a) continue;
    faces += 'f';
    for (const auto& [v, vt, vn] : corner) faces += fmt::format(" {}/{}/{}", v, vt, vn);
    faces += '\n';
  }
  return points.text() + uvs.text() + normals.text() + faces;
}

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& path) {
  write_file(path, to_obj(mesh));
}

}  // namespace vantage
