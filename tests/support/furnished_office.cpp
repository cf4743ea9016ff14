#include "tests/support/furnished_office.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/rng.hpp"

namespace vantage::support {
namespace {

struct Wall {
  double x_m, y_m;
  double half_length_m, half_width_m;
  bool along_x;
};

std::vector<Wall> walls_of(const std::string& mjcf) {
  std::vector<Wall> walls;
  std::istringstream lines(mjcf);
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find("<geom name=\"wall_");
    if (at == std::string::npos) continue;
    Wall wall{};
    int number = 0;
    double z_m = 0.0;
    double half_height_m = 0.0;
    double quat_w = 0.0;
    const int read = std::sscanf(
        line.c_str() + at,
        "<geom name=\"wall_%d\" type=\"box\" pos=\"%lf %lf %lf\" size=\"%lf %lf %lf\" quat=\"%lf",
        &number, &wall.x_m, &wall.y_m, &z_m, &wall.half_length_m, &half_height_m,
        &wall.half_width_m, &quat_w);
    wall.along_x = quat_w > 0.6;
    if (read == 8) walls.push_back(wall);
  }
  return walls;
}

std::string box_on(const Wall& wall, Rng& rng) {
  const double half_m = rng.uniform(0.02, 0.06);
  const double deep_m = rng.uniform(0.01, 0.03);
  const double along_m = rng.uniform(-1.0, 1.0) * (wall.half_length_m - half_m);
  const double z_m = rng.uniform(0.4, 1.9);
  const double across_m = wall.half_width_m + deep_m;
  const double to_middle = wall.along_x ? -wall.y_m : -wall.x_m;
  const double off_m = std::copysign(across_m, to_middle);
  const double x_m = wall.x_m + (wall.along_x ? along_m : off_m);
  const double y_m = wall.y_m + (wall.along_x ? off_m : along_m);
  return fmt::format(
      "pos=\"{:.4f} {:.4f} {:.4f}\"><geom type=\"box\" size=\"{:.4f} {:.4f} {:.4f}\" "
      "conaffinity=\"0\" rgba=\"{:.2f} {:.2f} {:.2f} 1\"",
      x_m, y_m, z_m, wall.along_x ? half_m : deep_m, wall.along_x ? deep_m : half_m, half_m,
      rng.uniform(0.2, 1.0), rng.uniform(0.2, 1.0), rng.uniform(0.2, 1.0));
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  if (const auto at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
}

/// `<body pos="..."><geom ...` as a geom of another body.
std::string without_body(const std::string& box) {
  const auto geom = box.find("><geom");
  const std::string pos = box.substr(0, geom);
  return "<geom " + pos + box.substr(geom + 6) + "/>";
}

}  // namespace

std::string furnished_office(int boxes, BoxBodies bodies) {
  const auto folder = data_root() / "models/scenes/office_small_1";
  std::string text = read_file(folder / "scene.xml");
  for (const std::string kind : {"mesh", "texture"}) {
    replace(text, fmt::format("{0}dir=\"{0}{1}\"", kind, kind == "mesh" ? "es" : "s"),
            fmt::format("{}dir=\"{}\"", kind,
                        (folder / (kind == "mesh" ? "meshes" : "textures")).string()));
  }
  const std::vector<Wall> walls = walls_of(text);
  Rng rng = Rng::stream(1, "furnished office");
  std::string things;
  for (int i = 0; i < boxes; ++i) {
    const std::string box = box_on(walls[static_cast<std::size_t>(i) % walls.size()], rng);
    things += bodies == BoxBodies::each ? "<body " + box + "/></body>\n" : without_body(box) + "\n";
  }
  if (bodies == BoxBodies::one) things = "<body name=\"things\">\n" + things + "</body>\n";
  replace(text, "</worldbody>", things + "</worldbody>");
  return text;
}

}  // namespace vantage::support
