#include <cmath>
#include <numbers>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

GeneratedObject make_hammer(Rng& rng) {
  const double length = rng.uniform(0.24, 0.3);
  const double head_r = rng.uniform(0.012, 0.016);
  GeneratedObject hammer;
  const std::array<Vector3d, 6> path{Vector3d(0, 0, 0),
                                     Vector3d(0.01, 0, 0),
                                     Vector3d(0.4 * length, 0, 0),
                                     Vector3d(0.45 * length, 0, 0),
                                     Vector3d(0.8 * length, 0, 0),
                                     Vector3d(length, 0, 0)};
  const std::array<Vector2d, 6> radii{Vector2d(0.012, 0.009), Vector2d(0.016, 0.012),
                                      Vector2d(0.015, 0.012), Vector2d(0.012, 0.009),
                                      Vector2d(0.011, 0.009), Vector2d(0.011, 0.009)};
  append(hammer.mesh, make_tube(path, radii, Vector3d::UnitY(), 14, kWallUv));
  TriangleMesh head;  // along z here, the striking face up
  add_solid(head,
            Profile{{0.75 * head_r, -0.02},
                    {0.8 * head_r, 0.022},
                    {head_r, 0.026},
                    {head_r, 0.044},
                    {0.85 * head_r, 0.047}},
            kPartUv, kPartUv);
  const Eigen::AngleAxisd to_side(-0.5 * std::numbers::pi, Vector3d::UnitX());  // z to +y
  const Vector3d p_head(length - 0.012, 0, 0);
  append(hammer.mesh, head, Eigen::Translation3d(p_head) * Pose(to_side));
  const std::array<Vector2d, 8> claw{Vector2d(-0.013, 0.0),   Vector2d(-0.012, -0.025),
                                     Vector2d(-0.03, -0.06),  Vector2d(-0.024, -0.063),
                                     Vector2d(0.002, -0.045), Vector2d(0.01, -0.02),
                                     Vector2d(0.012, 0.0),    Vector2d(0.0, 0.008)};
  append(hammer.mesh, make_extrusion(claw, 1.5 * head_r, 0.002, {kPartUv, kPartUv, kPartUv}),
         make_pose(p_head - Vector3d(0, 0, 0.75 * head_r), 0.0));
  const RgbColour grip = rng.uniform() < 0.4 ? kBlack : vivid(rng);
  hammer.texture = make_texture(grip, kSteel, 0.75 * kSteel);
  paint(hammer.texture, part_of(kWall, 0.0, 0.42, 1.0, 1.0),
        wood(RgbColour(0.83, 0.65, 0.42), RgbColour(0.55, 0.36, 0.18), 1, rng));
  paint(hammer.texture, part_of(kWall, 0.0, 0.05, 1.0, 0.38), bands(grip, 0.7 * grip, 8));
  hammer.mass_kg = rng.uniform(0.5, 0.75);
  return hammer;
}

GeneratedObject make_screwdriver(Rng& rng) {
  const double grip_r = rng.uniform(0.012, 0.017);
  const double grip = rng.uniform(0.085, 0.11);
  const double shaft_r = rng.uniform(0.0025, 0.004);
  const double shaft = rng.uniform(0.08, 0.14);
  GeneratedObject driver;
  const Profile handle = smooth_curve<Vector2d>(Profile{{0.7 * grip_r, 0.0},
                                                        {grip_r, 0.012},
                                                        {0.95 * grip_r, 0.6 * grip},
                                                        {0.65 * grip_r, 0.85 * grip},
                                                        {0.75 * grip_r, grip}},
                                                3);
  add_solid(driver.mesh, handle, kWallUv, kInnerUv);
  add_solid(
      driver.mesh,
      Profile{
          {shaft_r, grip - 0.002}, {shaft_r, grip + 0.92 * shaft}, {0.5 * shaft_r, grip + shaft}},
      kPartUv, kPartUv);
  lay_down(driver.mesh);
  const RgbColour ground = vivid(rng);
  driver.texture = make_texture(ground, ground, kSteel);
  paint(driver.texture, part_of(kWall, 0.0, 0.15, 1.0, 0.75),
        stripes(ground, rng.uniform() < 0.5 ? kBlack : vivid(rng), 6));
  driver.specular = 0.5;
  driver.mass_kg = 0.12;
  return driver;
}

GeneratedObject make_wrench(Rng& rng) {
  const double half = rng.uniform(0.06, 0.095);  // from the middle to where the jaw begins
  const double w = rng.uniform(0.007, 0.01);
  const double jaw = rng.uniform(0.018, 0.024);
  const double gap = 0.45 * jaw;
  const std::array<Vector2d, 10> end{Vector2d(half, -w),
                                     Vector2d(half + 0.4 * jaw, -jaw),
                                     Vector2d(half + 1.4 * jaw, -jaw),
                                     Vector2d(half + 2.0 * jaw, -gap - 0.002),
                                     Vector2d(half + 0.9 * jaw, -gap),
                                     Vector2d(half + 0.9 * jaw, gap),
                                     Vector2d(half + 2.0 * jaw, gap + 0.002),
                                     Vector2d(half + 1.4 * jaw, jaw),
                                     Vector2d(half + 0.4 * jaw, jaw),
                                     Vector2d(half, w)};
  const double other = rng.uniform(0.75, 0.95);
  std::vector<Vector2d> outline(end.begin(), end.end());
  for (const Vector2d& p : end)
    outline.emplace_back(-p.x(), -p.y() * (std::abs(p.y()) > w ? other : 1.0));
  GeneratedObject wrench;
  append(wrench.mesh,
         make_extrusion(outline, rng.uniform(0.01, 0.014), 0.002, {kWallUv, kInnerUv, kInnerUv}));
  TriangleMesh grip;  // a rubber sleeve
  append(grip, make_rounded_box({1.1 * half, 2.0 * w + 0.006, 0.018}, 0.004, 3,
                                {kPartUv, kPartUv, kPartUv, kPartUv, kPartUv, kPartUv}));
  append(wrench.mesh, grip, make_pose({0.0, 0.0, 0.009}, 0.0));
  wrench.texture = make_texture(kSteel, kSteel, vivid(rng));
  speckle(wrench.texture, kWall, 0.04, 4, rng);
  wrench.specular = 0.8;
  wrench.mass_kg = rng.uniform(0.2, 0.4);
  return wrench;
}

GeneratedObject make_flashlight(Rng& rng) {
  const double length = rng.uniform(0.14, 0.2);
  const double r = rng.uniform(0.014, 0.018);
  const double head = rng.uniform(1.4, 1.8) * r;
  GeneratedObject torch;
  const Vector2d neck(head, length);
  const Vector2d bezel(0.86 * head, length);
  const Vector2d lens(0.84 * head, length - 0.006);
  add_lathe(torch.mesh, Profile{{0.0, 0.0}, {0.85 * r, 0.0}}, kAround, kInnerUv);
  add_lathe(torch.mesh,
            Profile{{0.85 * r, 0.0},
                    {r, 0.006},
                    {r, 0.5 * length},
                    {r, 0.7 * length},
                    {head, 0.82 * length},
                    neck},
            kAround, kWallUv);
  add_lathe(torch.mesh, Profile{neck, bezel}, kAround, kInnerUv);
  add_lathe(torch.mesh, Profile{bezel, lens}, kAround, kPartUv);
  add_lathe(torch.mesh, Profile{lens, {0.0, length - 0.006}}, kAround, kPartUv);
  lay_down(torch.mesh);
  const RgbColour body = rng.uniform() < 0.3 ? kBlack : vivid(rng);
  torch.texture = make_texture(body, mix(body, kBlack, 0.5), RgbColour(0.98, 0.95, 0.75));
  paint(torch.texture, part_of(kWall, 0.0, 0.15, 1.0, 0.55),
        checks(body, mix(body, kBlack, 0.5), 24, 16));
  paint(torch.texture, part_of(kWall, 0.0, 0.72, 1.0, 0.78), vivid(rng));
  torch.specular = 0.6;
  torch.mass_kg = 0.25;
  return torch;
}

GeneratedObject make_sponge(Rng& rng) {
  const Vector3d foam_size{rng.uniform(0.1, 0.12), rng.uniform(0.066, 0.08),
                           rng.uniform(0.02, 0.032)};
  const Vector3d scourer_size(foam_size.x(), foam_size.y(), 0.009);
  GeneratedObject sponge;
  const BoxUv foam_uv = unfold_box(foam_size, kWall);
  const BoxUv scourer_uv = unfold_box(scourer_size, kPart);
  append(sponge.mesh, make_rounded_box(foam_size, 0.005, 3, foam_uv));
  append(sponge.mesh, make_rounded_box(scourer_size, 0.004, 3, scourer_uv),
         make_pose({0.0, 0.0, 0.5 * foam_size.z() + 0.0035}, 0.0));
  const RgbColour foam = any_colour({{0.0, 1.0}, {0.5, 0.8}, {0.95, 0.95}}, rng);
  const RgbColour scourer = mix(dark(rng), kWhite, 0.2);
  sponge.texture = make_texture(foam, foam, scourer);
  speckle(sponge.texture, kWall, 0.08, 3, rng);
  speckle(sponge.texture, kPart, 0.1, 3, rng);
  sponge.mass_kg = 0.02;
  return sponge;
}

}  // namespace vantage::family
