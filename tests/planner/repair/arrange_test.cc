#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "planner/object/polyhedron.h"
#include "planner/repair/resolve_touching.h"
#include "planner/repair/stages.h"
#include "tests/fixtures/soups.h"

namespace regrasp::repair {
namespace arrange_test {

using object::PolygonSoup;
using object::Polyhedron;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

constexpr double kTight = 1e-9;

PolygonSoup Joined(PolygonSoup one, const PolygonSoup& other) {
  const int first = static_cast<int>(one.vertices.size());
  one.vertices.insert(one.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (std::vector<int> facet : other.facets) {
    for (int& v : facet) v += first;
    one.facets.push_back(std::move(facet));
  }
  return one;
}

PolygonSoup Turned(PolygonSoup soup) {
  for (auto& facet : soup.facets) std::ranges::reverse(facet);
  return soup;
}

/// Arrange a surface. Throws if the reader rejects the result.
Polyhedron Arranged(const PolygonSoup& soup) {
  return Polyhedron::FromSoup(ArrangeSurface(CleanSurface(soup).soup).soup, "arranged");
}

double ArrangedVolume(const PolygonSoup& soup) { return Arranged(soup).mass_properties().volume; }

const PolygonSoup kBar = BoxSoup({1, 0.25, 0.25}, {3, 0.75, 0.75});
const PolygonSoup kBlock = BoxSoup({0, 0, 0}, {2, 1, 1});

TEST(ArrangeSurface, ShellsThatPassThroughEachOtherBecomeTheirUnion) {
  EXPECT_NEAR(ArrangedVolume(Joined(kBlock, kBar)), 2.25, kTight);
  // The result does not depend on the order or the orientation of the shells.
  EXPECT_NEAR(ArrangedVolume(Joined(kBar, kBlock)), 2.25, kTight);
  EXPECT_NEAR(ArrangedVolume(Joined(kBlock, Turned(kBar))), 2.25, kTight);
}

TEST(ArrangeSurface, FacesInOnePlaneAreOneOrNone) {
  const PolygonSoup beside = BoxSoup({1, 0, 0}, {3, 1, 1});
  const Polyhedron overlapping = Arranged(Joined(kBlock, beside));
  EXPECT_NEAR(overlapping.mass_properties().volume, 3, kTight);
  EXPECT_EQ(overlapping.face_count(), 6);
  const PolygonSoup above = BoxSoup({0.5, 0.25, 1}, {1.5, 0.75, 2});
  EXPECT_NEAR(ArrangedVolume(Joined(kBlock, above)), 2.5, kTight);
  EXPECT_NEAR(ArrangedVolume(Joined(kBlock, kBlock)), 2, kTight);
}

TEST(ArrangeSurface, ACavityStaysOne) {
  const PolygonSoup large = BoxSoup({0, 0, 0}, {3, 3, 3}), small = BoxSoup({1, 1, 1}, {2, 2, 2});
  EXPECT_NEAR(ArrangedVolume(Joined(large, Turned(small))), 26, kTight);
  EXPECT_NEAR(ArrangedVolume(Joined(large, small)), 27, kTight);
}

TEST(ArrangeSurface, ASpikeThatPassesThroughTheFarSideTakesAwayWhatItIsIn) {
  // The top of the cube is replaced by a spike to a point below its bottom. The region with winding
  // number 1 remains.
  PolygonSoup cube = BoxSoup({0, 0, 0}, {1, 1, 1});
  std::erase(cube.facets, std::vector<int>{4, 5, 7, 6});
  cube.vertices.push_back({0.5, 0.5, -1});
  for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) {
    cube.facets.push_back({a, b, 8});
  }
  // A frustum of height 1 between squares of sides 1 and 1/2 is removed.
  EXPECT_NEAR(ArrangedVolume(cube), 1 - (1 + 0.5 + 0.25) / 3, kTight);
}

TEST(ArrangeSurface, PartsThatTouchAlongAnEdgeBecomeOneBody) {
  const PolygonSoup touching = Joined(BoxSoup({0, 0, 0}, {1, 1, 1}), BoxSoup({1, 1, 0}, {2, 2, 1}));
  EXPECT_NEAR(ArrangedVolume(touching), 2, 10 * kTouchingMoved);
  // Control: the reader rejects an edge of four polygons.
  EXPECT_THROW((void)Polyhedron::FromSoup(touching, "touching"), object::MeshError);
}

TEST(ArrangeSurface, AnOpenSurfaceHasNoInside) {
  PolygonSoup open = BoxSoup({0, 0, 0}, {1, 1, 1});
  open.facets.pop_back();
  EXPECT_THROW((void)ArrangeSurface(CleanSurface(open).soup), std::runtime_error);
}

}  // namespace arrange_test
}  // namespace regrasp::repair
