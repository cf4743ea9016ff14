// The same box from every kind of file, and files that are none.
#include "vantage/building/mesh_file.hpp"

#include <gmock/gmock.h>

#include "tests/building/drawn_building.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;

constexpr auto kPly = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 2 0
0 0 3
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

constexpr auto kStl = R"(solid s
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 2 0
vertex 1 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 3
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 3
vertex 0 2 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1 0 0
vertex 0 2 0
vertex 0 0 3
endloop
endfacet
endsolid s
)";

/// A triangle (0, 0, 0), (1, 0, 0), (0, 0, -2), which is level where y points up.
constexpr auto kGltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[0,5,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAADA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,-2],"max":[1,0,0]}]})";

class MeshFile : public testing::Test {
 protected:
  BuildingMesh read(const std::string& name, const std::string& text,
                    const MeshReading& reading = {}) {
    write_file(folder_ / name, text);
    return read_building_mesh(folder_ / name, reading);
  }
  std::string refusal(const std::string& name, const std::string& text) {
    try {
      read(name, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  support::TemporaryDirectory folder_;
};

Eigen::AlignedBox3d extent_of(const BuildingMesh& mesh) {
  Eigen::AlignedBox3d extent_m;
  for (const auto& p_m : mesh.vertices_m) extent_m.extend(p_m);
  return extent_m;
}

TEST_F(MeshFile, PlyAndStlAreTheSame) {
  for (const BuildingMesh& mesh : {read("m.ply", kPly), read("m.stl", kStl)}) {
    EXPECT_EQ(mesh.vertices_m.size(), 4U);
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.colours.size(), 4U);
    EXPECT_TRUE(extent_of(mesh).max().isApprox(Eigen::Vector3d(1, 2, 3)));
  }
}

TEST_F(MeshFile, GltfHasItsOwnAxesAndNodes) {
  EXPECT_EQ(usual_up_axis("a/House.GLB"), UpAxis::y);
  EXPECT_EQ(usual_up_axis("house.obj"), UpAxis::z);
  const BuildingMesh mesh = read("m.gltf", kGltf, {.up = UpAxis::y});
  ASSERT_EQ(mesh.triangles.size(), 1U);
  const Eigen::AlignedBox3d extent_m = extent_of(mesh);
  EXPECT_TRUE(extent_m.min().isApprox(Eigen::Vector3d(0, 0, 5)));
  EXPECT_TRUE(extent_m.max().isApprox(Eigen::Vector3d(1, 2, 5)));
  EXPECT_GT(mesh.normal(mesh.triangles[0]).z(), 0.0);
}

TEST_F(MeshFile, UnitsAreScaled) {
  test::DrawnBuilding building;
  building.box({0, 0, 0}, {1000, 2000, 2500});
  const BuildingMesh mesh = read("m.obj", building.obj(), {.scale = 0.001});
  EXPECT_TRUE(extent_of(mesh).max().isApprox(Eigen::Vector3d(1, 2, 2.5)));
  EXPECT_EQ(mesh.triangles.size(), 12U);
}

TEST_F(MeshFile, WhatIsNoMeshIsRefused) {
  EXPECT_THAT(refusal("a.obj", "this is no mesh\n"), HasSubstr("a.obj: "));
  EXPECT_THAT(refusal("a.stl", "nothing"), HasSubstr("a.stl: not a mesh that can be read"));
  EXPECT_THAT(refusal("a.docx", "nothing"), HasSubstr("a.docx: not a mesh that can be read"));
  EXPECT_THAT(refusal("far.obj", "v 90000 0 0\nv 90001 0 0\nv 90000 1 0\nf 1 2 3\n"),
              HasSubstr("too large"));
  try {
    read_building_mesh(folder_ / "absent.obj", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("absent.obj: no such file"));
  }
}

/// Two triangles, whose first corners are that far apart along an axis.
std::string two_triangles(int axis, double apart_m) {
  Eigen::Vector3d other_m(1, 1, 1);
  other_m[axis] += apart_m;
  return fmt::format("v 1 1 1\nv 2 0 0\nv 0 2 0\nv {} {} {}\nv 3 0 0\nv 0 3 0\nf 1 2 3\nf 4 5 6\n",
                     other_m.x(), other_m.y(), other_m.z());
}

TEST_F(MeshFile, VerticesAtOnePlaceAreOne) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(read("near.obj", two_triangles(axis, 0.00003)).vertices_m.size(), 5U) << axis;
    EXPECT_EQ(read("far.obj", two_triangles(axis, 0.00008)).vertices_m.size(), 6U) << axis;
  }
}

TEST_F(MeshFile, ReachesEightKilometresFromItsOrigin) {
  EXPECT_EQ(read("a.obj", "v 0 7999 0\nv 1 7999 0\nv 0 7998 0\nf 1 2 3\n").triangles.size(), 1U);
  EXPECT_THAT(refusal("a.obj", "v 0 0 -8001\nv 1 0 -8000\nv 0 1 -7999\nf 1 2 3\n"),
              HasSubstr("a.obj: too large: a vertex is 8e+03 m from the origin"));
}

TEST_F(MeshFile, FacesOfNoAreaAreLeftOut) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\n";
  EXPECT_EQ(read("a.obj", corners + "f 1 2 3\nf 1 2 4\n").triangles.size(), 1U);
  EXPECT_THAT(refusal("a.obj", corners + "f 1 2 3\n"),
              HasSubstr("a.obj: a mesh without triangles"));
}

TEST_F(MeshFile, MirroredNodesFaceAsTheyDid) {
  std::string gltf = kGltf;
  const std::string placed = R"("translation":[0,5,0])";
  gltf.replace(gltf.find(placed), placed.size(), R"("scale":[-2,1,1])");
  const BuildingMesh mesh = read("m.gltf", gltf, {.up = UpAxis::y});
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_TRUE(extent_of(mesh).min().isApprox(Eigen::Vector3d(-2, 0, 0)));
  EXPECT_TRUE(extent_of(mesh).max().isApprox(Eigen::Vector3d(0, 2, 0)));
  EXPECT_NEAR(mesh.normal(mesh.triangles[0]).z(), 4.0, 1e-6);
}

TEST_F(MeshFile, TellsObjectsAndColours) {
  write_file(folder_ / "m.mtl", "newmtl red\nKd 0.75 0.125 0.25\n");
  const std::string one = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const BuildingMesh plain =
      read("a.obj", "o one\n" + one + "f 1 2 3\no other\nv 0 0 2\nv 1 0 2\nv 0 1 2\nf 4 5 6\n");
  ASSERT_EQ(plain.objects.size(), 2U);
  EXPECT_NE(plain.objects[0], plain.objects[1]);
  EXPECT_LT(plain.colours[0].maxCoeff(), 0.0F) << "none";
  const BuildingMesh red = read("b.obj", "mtllib m.mtl\n" + one + "usemtl red\nf 1 2 3\n");
  ASSERT_EQ(red.colours.size(), 1U);
  EXPECT_LT((red.colours[0] - Eigen::Vector3f(0.75F, 0.125F, 0.25F)).norm(), 1e-5F);
}

TEST(UpAxis, IsYInGltfAlone) {
  EXPECT_EQ(usual_up_axis("a.gltf"), UpAxis::y);
  EXPECT_EQ(usual_up_axis("a.glb"), UpAxis::y);
  EXPECT_EQ(usual_up_axis("a.gltf.ply"), UpAxis::z);
  EXPECT_EQ(usual_up_axis("a"), UpAxis::z);
}

/// Turned left by a quarter about y, which points up, and there moved by 1 along its own x.
TEST_F(MeshFile, NodesStandInTheFrameOfTheirParents) {
  std::string gltf = kGltf;
  const std::string node = R"({"mesh":0,"translation":[0,5,0]})";
  gltf.replace(gltf.find(node), node.size(),
               R"({"children":[1],"rotation":[0,0.70710678,0,0.70710678]},)"
               R"({"mesh":0,"translation":[1,0,0]})");
  const BuildingMesh mesh = read("m.gltf", gltf, {.scale = 2.0, .up = UpAxis::y});
  ASSERT_EQ(mesh.triangles.size(), 1U);
  const Eigen::AlignedBox3d extent_m = extent_of(mesh);
  EXPECT_LT((extent_m.min() - Eigen::Vector3d(-4, 2, 0)).norm(), 1e-5);
  EXPECT_LT((extent_m.max() - Eigen::Vector3d(0, 4, 0)).norm(), 1e-5);
  EXPECT_NEAR(mesh.normal(mesh.triangles[0]).z(), 8.0, 1e-4);
}

TEST_F(MeshFile, MayReachEightKilometres) {
  EXPECT_EQ(read("a.obj", "v 0 8000 0\nv 1 7999 0\nv 0 7998 0\nf 1 2 3\n").triangles.size(), 1U);
}

TEST_F(MeshFile, FacesOfSmallUnitsFaceAsTheyDid) {
  const std::string triangle = "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nf 1 2 3\n";
  const BuildingMesh mesh = read("a.obj", triangle, {.scale = 0.001});
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_NEAR(mesh.normal(mesh.triangles[0]).z(), 1.0, 1e-6);
}

TEST_F(MeshFile, AMaterialMayHaveANameOfOneLetter) {
  write_file(folder_ / "m.mtl", "newmtl r\nKd 0.75 0.125 0.25\n");
  const BuildingMesh red =
      read("a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl r\nf 1 2 3\n");
  EXPECT_LT((red.colours.at(0) - Eigen::Vector3f(0.75F, 0.125F, 0.25F)).norm(), 1e-5F);
}

/// Its first number is infinity.
TEST_F(MeshFile, AVertexThatIsNowhereIsRefused) {
  std::string gltf = kGltf;
  const std::string numbers = "base64,AAAAAAAA";
  gltf.replace(gltf.find(numbers), numbers.size(), "base64,AACAfwAA");
  EXPECT_THAT(refusal("m.gltf", gltf), HasSubstr("m.gltf: a vertex is not finite"));
}

}  // namespace
}  // namespace vantage
