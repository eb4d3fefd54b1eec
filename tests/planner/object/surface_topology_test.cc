#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "planner/object/polygon_soup.h"
#include "planner/object/triangle_mesh.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace surface_topology_test {

using ::testing::HasSubstr;

/// Make a soup of triangles with the numbers of its "file".
TriangleMesh MeshOf(const PolygonSoup& soup) {
  TriangleMesh mesh;
  mesh.vertices = soup.vertices;
  for (int v = 0; v < std::ssize(soup.vertices); ++v) mesh.vertex_in_file.push_back(v);
  for (const auto& facet : soup.facets) {
    mesh.facet_of_triangle.push_back(static_cast<int>(mesh.facet_of_triangle.size()));
    mesh.triangles.push_back({facet[0], facet[1], facet[2]});
  }
  return mesh;
}

TriangleMesh Tetrahedra(const std::vector<Eigen::Vector3d>& offsets) {
  PolygonSoup all;
  for (const Eigen::Vector3d& offset : offsets) {
    PolygonSoup one = soups::CornerTetrahedronSoup();
    for (Eigen::Vector3d& p : one.vertices) p += offset;
    all = soups::Join(all, one);
  }
  return MeshOf(all);
}

/// Return the defect with its message; nullopt if there is none.
std::optional<std::pair<MeshDefect, std::string>> DefectOf(const TriangleMesh& mesh) {
  try {
    (void)ComputeTopology(mesh, "file.off");
  } catch (const MeshError& error) {
    return std::pair(error.defect(), std::string(error.what()));
  }
  return std::nullopt;
}

TEST(SurfaceTopology, ATriangleAcrossAnEdgeHasItTheOtherWayRound) {
  const TriangleMesh mesh = MeshOf(soups::SphereSoup(8));
  const SurfaceTopology topology = ComputeTopology(mesh, "sphere");
  ASSERT_EQ(topology.neighbor.size(), mesh.triangles.size());
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    std::set<TriangleIndex> different;
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      const TriangleIndex other = topology.neighbor[t][k];
      const auto& corners = mesh.triangles[other];
      const auto place = std::ranges::find(corners, to) - corners.begin();
      ASSERT_LT(place, 3);
      EXPECT_EQ(corners[(place + 1) % 3], from);
      EXPECT_EQ(topology.neighbor[other][place], t);
      different.insert(other);
    }
    EXPECT_EQ(different.size(), 3U);
  }
  EXPECT_EQ(topology.shell_count, 1);
}

TEST(SurfaceTopology, ShellsAreThePartsThatShareNoEdge) {
  const TriangleMesh mesh = Tetrahedra({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  const SurfaceTopology topology = ComputeTopology(mesh, "three");
  EXPECT_EQ(topology.shell_count, 3);
  for (TriangleIndex t{0}; t < 12; ++t) EXPECT_EQ(topology.shell[t], t / 4);
}

TEST(SurfaceTopology, RefusesWhatIsNotOneClosedSheetAndNamesTheEdgeOrVertex) {
  const TriangleMesh good = Tetrahedra({{0, 0, 0}});
  EXPECT_EQ(DefectOf(good), std::nullopt);

  TriangleMesh open = good;
  open.triangles.pop_back();
  auto defect = DefectOf(open);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->first, MeshDefect::kNotClosed);
  EXPECT_THAT(defect->second, HasSubstr("file.off: facet 0: not closed: no other facet at the edge "
                                        "from vertex 1 (1, 0, 0) to vertex 2 (0, 1, 0)"));

  TriangleMesh turned = good;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  defect = DefectOf(turned);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->first, MeshDefect::kNotOriented);
  EXPECT_THAT(defect->second, HasSubstr("with facet 3"));

  TriangleMesh fin = good;
  fin.triangles.push_back(fin.triangles[3]);
  fin.facet_of_triangle.push_back(static_cast<int>(fin.facet_of_triangle.size()));
  defect = DefectOf(fin);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->first, MeshDefect::kNotManifold);
  EXPECT_THAT(defect->second, HasSubstr("3 facets meet"));

  // Two objects with a common vertex: every edge is valid, but the vertex has two fans.
  TriangleMesh pinched = Tetrahedra({{0, 0, 0}, {1, 0, 0}});
  for (auto& triangle : pinched.triangles) {
    for (int& v : triangle) v = v == 4 ? 1 : v - (v > 4 ? 1 : 0);
  }
  pinched.vertices.erase(pinched.vertices.begin() + 4);
  defect = DefectOf(pinched);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->first, MeshDefect::kNotManifold);
  EXPECT_THAT(defect->second, HasSubstr("vertex 1 (1, 0, 0): not manifold"));
}

}  // namespace surface_topology_test
}  // namespace regrasp::object
