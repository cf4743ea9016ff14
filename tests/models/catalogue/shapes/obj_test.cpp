#include "vantage/models/catalogue/shapes/obj.hpp"

#include <gtest/gtest.h>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

TEST(Obj, WritesFixedDecimalsOnceAndNoNegativeZero) {
  TriangleMesh mesh;
  mesh.add_vertex({0.1234567, -0.0000001, 0.0}, {0, 0, 1}, {0.5, 0.25});
  mesh.add_vertex({1.0, 0.0, 0.0}, {0, 0, 1}, {0.5, 0.25});
  mesh.add_vertex({0.0, 1.0, 0.0}, {0, 0, 1}, {1.0, 0.0});
  mesh.triangles.push_back({0, 1, 2});
  EXPECT_EQ(to_obj(mesh),
            "v 0.12346 0.00000 0.00000\n"
            "v 1.00000 0.00000 0.00000\n"
            "v 0.00000 1.00000 0.00000\n"
            "vt 0.5000 0.2500\n"
            "vt 1.0000 0.0000\n"
            "vn 0.000 0.000 1.000\n"
            "f 1/1/1 2/1/1 3/2/1\n");
}

TEST(Obj, LeavesOutTrianglesThatRoundToALine) {
  TriangleMesh mesh;
  mesh.add_vertex({0.0, 0.0, 0.0}, {0, 0, 1}, {0, 0});
  mesh.add_vertex({0.000001, 0.0, 0.0}, {0, 0, 1}, {0, 0});
  mesh.add_vertex({0.0, 1.0, 0.0}, {0, 0, 1}, {0, 0});
  mesh.triangles.push_back({0, 1, 2});
  EXPECT_EQ(to_obj(mesh).find("f "), std::string::npos);
}

TEST(Obj, MissingDirectoryIsAnOutputError) {
  EXPECT_THROW(write_obj({}, "/nonexistent-directory/mesh.obj"), OutputError);
}

}  // namespace
}  // namespace vantage
