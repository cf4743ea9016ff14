/// One scene with every kind of geom, for the tests that compare a sensor with a reference.
#pragma once

#include <cmath>
#include <string>

#include "tests/support/mjcf.hpp"

namespace vantage::test {

/// A bumpy ellipsoid-like solid of 2 * rings * segments triangles, as MJCF's vertex and face lists.
inline std::string bumpy_mesh(int rings, int segments) {
  std::string vertex;
  std::string face;
  const auto add = [&](double x, double y, double z) {
    vertex += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " ";
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const double polar = M_PI * (r + 0.5) / rings;
      const double angle = 2.0 * M_PI * s / segments;
      const double radius = 0.3 * (1.0 + 0.15 * std::sin(3.0 * angle) * std::sin(polar));
      add(radius * std::sin(polar) * std::cos(angle),
          0.7 * radius * std::sin(polar) * std::sin(angle), 0.9 * radius * std::cos(polar));
    }
  }
  add(0.0, 0.0, 0.27);
  add(0.0, 0.0, -0.27);
  const auto triangle = [&](int a, int b, int c) {
    face += std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + " ";
  };
  for (int s = 0; s < segments; ++s) {
    const int next = (s + 1) % segments;
    triangle(rings * segments, s, next);
    triangle(rings * segments + 1, (rings - 1) * segments + next, (rings - 1) * segments + s);
    for (int r = 0; r + 1 < rings; ++r) {
      triangle(r * segments + s, (r + 1) * segments + s, (r + 1) * segments + next);
      triangle(r * segments + s, (r + 1) * segments + next, r * segments + next);
    }
  }
  return "<mesh name='bumpy' vertex='" + vertex + "' face='" + face + "'/>";
}

inline MjcfModel sensor_scene() {
  MjcfModel scene = compile_mjcf(R"(
    <mujoco>
      <statistic extent="1" center="0 0 0"/>
      <visual>
        <map znear="0.05" zfar="20"/>
        <quality numslices="128" numstacks="128" shadowsize="0"/>
      </visual>
      <asset>
        <hfield name="hills" nrow="12" ncol="12" size="0.5 0.4 0.3 0.1"/>
        <material name="glow" emission="1" specular="0" shininess="0" rgba="0.2 0.6 0.4 1"/>
        <material name="ghost" rgba="1 1 1 0"/>)" +
                                 bumpy_mesh(20, 24) + R"(
      </asset>
      <worldbody>
        <light pos="0 0 4" dir="0 0 -1"/>
        <geom name="floor" type="plane" size="0 0 1"/>
        <geom name="tile" type="plane" size="0.5 0.3 1" pos="-2 2 0.4" euler="20 10 0"/>
        <geom name="box" type="box" size="0.2 0.3 0.25" pos="1 0 0.4" euler="10 20 30"/>
        <geom name="sphere" type="sphere" size="0.25" pos="0 1 0.5"/>
        <geom name="capsule" type="capsule" size="0.1 0.3" pos="-1 0 0.5" euler="40 0 10"/>
        <geom name="cylinder" type="cylinder" size="0.2 0.25" pos="0 -1 0.5" euler="0 50 0"/>
        <geom name="ellipsoid" type="ellipsoid" size="0.3 0.15 0.2" pos="1 1 0.5" euler="5 6 7"/>
        <geom name="hills" type="hfield" hfield="hills" pos="-1.2 -1.2 0.3" euler="0 0 25"/>
        <geom name="mesh" type="mesh" mesh="bumpy" pos="1.2 -1.2 0.5" euler="30 0 60"/>
        <geom name="unseen" type="sphere" size="3" rgba="1 1 1 0"/>
        <geom name="unseen_material" type="sphere" size="3" material="ghost"/>
        <body name="robot/base" pos="0 0 1.2">
          <freejoint/>
          <geom name="shell" type="box" size="0.15 0.1 0.05"/>
          <body name="arm" pos="0.3 0 0.1">
            <joint axis="0 1 0"/>
            <geom name="arm_mesh" type="mesh" mesh="bumpy"/>
          </body>
        </body>
        <body name="lamp" pos="0 0 0.3">
          <geom name="lamp" type="box" size="0.1 0.1 0.1" material="glow"/>
        </body>
        <camera name="oblique" pos="3 -2.2 2.2" xyaxes="0.6 0.8 0 -0.38 0.29 0.88"/>
        <camera name="level" pos="0 -3 0.3" xyaxes="1 0 0 0 0 1"/>
      </worldbody>
    </mujoco>)");
  for (int r = 0; r < 12; ++r) {
    for (int c = 0; c < 12; ++c) {
      scene.model->hfield_data[12 * r + c] =
          static_cast<float>(0.5 + 0.5 * std::sin(0.9 * r) * std::cos(0.7 * c));
    }
  }
  return scene;
}

}  // namespace vantage::test
