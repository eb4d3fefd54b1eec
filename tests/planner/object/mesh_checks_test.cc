// Each MeshDefect with a surface that has only this defect, and similar surfaces that are valid.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "planner/object/facet_triangulation.h"
#include "planner/object/polyhedron.h"
#include "planner/object/weld.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace mesh_checks_test {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using namespace regrasp::soups;  // NOLINT: the meshes of this folder

struct Spoilt {
  std::string what;
  MeshDefect defect;
  std::string words;
  std::function<void(PolygonSoup&)> spoil;
};

/// Faces of the unit cube: 0 is z = −½ (corners 0 2 3 1), 1 is z = ½, then −y, x, y, −x.
std::vector<Spoilt> SpoiltCubes() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  return {
      {"nothing", MeshDefect::kEmpty, "facets not found", [](PolygonSoup& s) { s = {}; }},
      {"no facets", MeshDefect::kEmpty, "facets not found",
       [](PolygonSoup& s) { s.facets.clear(); }},
      {"NaN", MeshDefect::kNotFinite, "vertex 5: the coordinate nan",
       [=](PolygonSoup& s) { s.vertices[5].y() = nan; }},
      {"infinite", MeshDefect::kNotFinite, "vertex 2: the coordinate -inf",
       [=](PolygonSoup& s) { s.vertices[2].z() = -inf; }},
      {"beyond range", MeshDefect::kNotFinite, "vertex 2: the coordinate 2e+15",
       [](PolygonSoup& s) { s.vertices[2].x() = 2e15; }},
      {"tiny", MeshDefect::kBadSize, "within 1e-15",
       [](PolygonSoup& s) { Transform(s, Eigen::Affine3d(Eigen::Scaling(1e-17))); }},
      {"far away", MeshDefect::kBadSize, "too far from the origin",
       [](PolygonSoup& s) { Transform(s, Eigen::Affine3d(Eigen::Translation3d(3e7, 0, 0))); }},
      {"index beyond", MeshDefect::kIndexOutOfRange, "facet 4: vertex index 8 must be",
       [](PolygonSoup& s) { s.facets[4][1] = 8; }},
      {"index negative", MeshDefect::kIndexOutOfRange, "facet 4: vertex index -1",
       [](PolygonSoup& s) { s.facets[4][1] = -1; }},
      {"two corners", MeshDefect::kNotClosed, "facet 0: not closed: no other facet",
       [](PolygonSoup& s) { s.facets[2].resize(2); }},
      {"no corners", MeshDefect::kNotClosed, "facet 0: not closed: no other facet",
       [](PolygonSoup& s) { s.facets[2].clear(); }},
      {"corner twice", MeshDefect::kNotClosed, "facet 0: not closed: no other facet",
       [](PolygonSoup& s) { s.facets[2][1] = s.facets[2][0]; }},
      {"corner twice by coordinates", MeshDefect::kNotPlanar,
       "facet 3: not planar: ", [](PolygonSoup& s) { s.vertices[3] = s.vertices[2]; }},
      {"bent", MeshDefect::kNotPlanar, "facet 1: not planar",
       [](PolygonSoup& s) { s.vertices[7].z() += 0.01; }},
      {"bow tie", MeshDefect::kSelfIntersecting, "facet 3: self-intersecting: its outline",
       [](PolygonSoup& s) { std::swap(s.facets[3][0], s.facets[3][1]); }},
      {"open", MeshDefect::kNotClosed, "not closed: no other facet",
       [](PolygonSoup& s) { s.facets.pop_back(); }},
      {"T-junction", MeshDefect::kNotClosed, "not closed",
       [](PolygonSoup& s) {
         s.vertices.push_back((s.vertices[0] + s.vertices[1]) / 2);
         s.facets[0] = {0, 2, 3, 1, 8};
       }},
      {"fin", MeshDefect::kNotManifold, "not manifold: 3 facets",
       [](PolygonSoup& s) {
         s.vertices.push_back({3, 3, 3});
         s.facets.push_back({0, 1, 8});
       }},
      {"vertex of two bodies", MeshDefect::kNotManifold, "vertex 7 (0.5, 0.5, 0.5): not manifold",
       [](PolygonSoup& s) {
         s = Join(s, BoxSoup(Vector3d::Constant(0.5), Vector3d::Constant(1)));
       }},
      {"edge of two bodies", MeshDefect::kNotManifold, "not manifold: 4 facets",
       [](PolygonSoup& s) {
         s = Join(s, BoxSoup({0.5, 0.5, -0.5}, {1, 1, 0.5}));
       }},
      {"facet turned", MeshDefect::kNotOriented, "not consistently oriented with facet",
       [](PolygonSoup& s) { std::ranges::reverse(s.facets[3]); }},
      {"bodies crossing", MeshDefect::kSelfIntersecting, "self-intersecting: meets facet",
       [](PolygonSoup& s) {
         s = Join(s, BoxSoup(Vector3d::Constant(0.3), Vector3d::Constant(1)));
       }},
      {"bodies flush", MeshDefect::kSelfIntersecting, "self-intersecting: meets facet",
       [](PolygonSoup& s) {
         s = Join(s, BoxSoup({0.5, -0.2, -0.2}, {1, 0.2, 0.2}));
       }},
      {"bodies next to each other", MeshDefect::kSeveralSolids,
       "facet 6: several solids: its shell is not inside",
       [](PolygonSoup& s) {
         s = Join(s, BoxSoup(Vector3d::Constant(2), Vector3d::Constant(2.5)));
       }},
      {"body inside", MeshDefect::kSeveralSolids, "facet 6: several solids: its shell is inside",
       [](PolygonSoup& s) {
         s = Join(s, BoxSoup(Vector3d::Constant(-0.2), Vector3d::Constant(0.2)));
       }},
      {"body in a cavity", MeshDefect::kSeveralSolids, "several solids: its shell is inside",
       [](PolygonSoup& s) {
         PolygonSoup cavity = BoxSoup(Vector3d::Constant(-0.4), Vector3d::Constant(0.4));
         Turn(cavity);
         s = Join(Join(s, cavity), BoxSoup(Vector3d::Constant(-0.2), Vector3d::Constant(0.2)));
       }},
      {"cavity in a cavity", MeshDefect::kSeveralSolids, "several solids: its shell is inside a",
       [](PolygonSoup& s) {
         PolygonSoup cavity = BoxSoup(Vector3d::Constant(-0.4), Vector3d::Constant(0.4));
         PolygonSoup inner = BoxSoup(Vector3d::Constant(-0.2), Vector3d::Constant(0.2));
         Turn(cavity);
         Turn(inner);
         s = Join(Join(s, cavity), inner);
       }},
      {"inward outside a cavity", MeshDefect::kSeveralSolids, "is not inside",
       [](PolygonSoup& s) {
         PolygonSoup other = BoxSoup(Vector3d::Constant(2), Vector3d::Constant(2.5));
         Turn(other);
         s = Join(s, other);
       }},
  };
}

TEST(MeshChecks, EachDefectIsNamedWithItsElement) {
  ASSERT_EQ(Polyhedron::FromSoup(UnitCubeSoup(), "cube").face_count(), 6) << "sound before";
  for (const Spoilt& spoilt : SpoiltCubes()) {
    SCOPED_TRACE(spoilt.what);
    PolygonSoup soup = UnitCubeSoup();
    spoilt.spoil(soup);
    try {
      static_cast<void>(Polyhedron::FromSoup(soup, "corrupt cube"));
      ADD_FAILURE() << "accepted";
    } catch (const MeshError& error) {
      EXPECT_EQ(error.defect(), spoilt.defect) << error.what();
      EXPECT_THAT(error.what(), HasSubstr("corrupt cube: "));
      EXPECT_THAT(error.what(), HasSubstr(spoilt.words));
    }
  }
}

TEST(MeshChecks, EachDefectIsFoundUnderAnyMotion) {
  int checked = 0;
  for (const Spoilt& spoilt : SpoiltCubes()) {
    // These defects depend on the position of the object, or are exact only along the axes.
    if (spoilt.what == "far away" || spoilt.what == "tiny" || spoilt.what == "bodies flush" ||
        spoilt.defect == MeshDefect::kNotFinite || spoilt.defect == MeshDefect::kEmpty) {
      continue;
    }
    PolygonSoup soup = UnitCubeSoup();
    spoilt.spoil(soup);
    Transform(soup, SomeMotion());
    try {
      static_cast<void>(Polyhedron::FromSoup(soup, "corrupt cube"));
      ADD_FAILURE() << spoilt.what << " accepted";
    } catch (const MeshError& error) {
      EXPECT_EQ(error.defect(), spoilt.defect) << error.what();
      ++checked;
    }
  }
  EXPECT_GT(checked, 15);
}

TEST(MeshChecks, EqualVerticesAreOneAndUnusedOnesAreIgnored) {
  const PolygonSoup cube = UnitCubeSoup();
  PolygonSoup split;
  split.vertices.push_back({50, 0, 0});  // unused, so not part of the diameter
  for (const auto& facet : cube.facets) {
    auto& corners = split.facets.emplace_back();
    for (const int v : facet) {
      corners.push_back(static_cast<int>(split.vertices.size()));
      split.vertices.push_back(cube.vertices[v]);
    }
  }
  const Polyhedron body = Polyhedron::FromSoup(split, "split");
  EXPECT_EQ(body.vertices().size(), 8u);
  EXPECT_NEAR(body.diameter(), std::sqrt(3), 1e-12);
  EXPECT_EQ(body.face_count(), 6);
}

TEST(MeshChecks, NegativeZeroIsZero) {
  PolygonSoup soup = BoxSoup(Vector3d::Zero(), Vector3d::Ones());
  soup.vertices.push_back({-0.0, 0, -0.0});
  soup.facets[0][0] = 8;
  const Polyhedron body = Polyhedron::FromSoup(soup, "box");
  EXPECT_EQ(body.vertices().size(), 8u);
  for (FaceIndex f{0}; f < 6; ++f) {
    for (const double x : body.inward_normal(f)) EXPECT_FALSE(x == 0 && std::signbit(x));
  }
}

TEST(MeshChecks, APolygonThatIsBentIsTwoFacesAndAFlatOneIsOne) {
  const auto lifted = [](double off_plane) {
    PolygonSoup soup = UnitCubeSoup();
    // Lifting a corner of a square by d moves it d/4 off the mean plane.
    soup.vertices[7].z() += 4 * off_plane * std::sqrt(3);
    return Polyhedron::FromSoup(soup, "cube").face_count();
  };
  EXPECT_EQ(lifted(0.9 * kPlanarTolerance), 6);
  EXPECT_EQ(lifted(1.1 * kPlanarTolerance), 7);
  EXPECT_EQ(lifted(0.9 * kBentTolerance), 7);
  try {
    static_cast<void>(lifted(1.1 * kBentTolerance));
    ADD_FAILURE() << "accepted";
  } catch (const MeshError& error) {
    EXPECT_EQ(error.defect(), MeshDefect::kNotPlanar);
    EXPECT_THAT(error.what(), HasSubstr("a corner is 0.001905 off its plane, 0.001097 of the"));
  }
}

/// A tolerated defect, and the same defect slightly beyond the tolerance.
struct Harmless {
  std::string what;
  std::function<void(PolygonSoup&)> spoil;
  std::function<void(PolygonSoup&)> too_far;
  MeshDefect defect;  ///< defect of `too_far`
};

/// Give the face −y of the cube its own corner near vertex 5.
void TakeApart(PolygonSoup& s, double by) {
  s.vertices.push_back(s.vertices[5] + by * Vector3d(0, 1, 0));
  s.facets[2][2] = 8;
}

std::vector<Harmless> HarmlessCubes() {
  const double within = kPointTolerance * std::sqrt(3);
  const auto with_middle = [](PolygonSoup& s) {
    s.vertices.push_back((s.vertices[0] + s.vertices[1]) / 2);
  };
  return {
      {"a corner repeated", [](PolygonSoup& s) { s.facets[2].push_back(s.facets[2][0]); },
       [](PolygonSoup& s) { s.facets[2].push_back(s.facets[2][1]); },
       MeshDefect::kSelfIntersecting},
      {"a facet of two corners",
       [](PolygonSoup& s) {
         s.facets.push_back({0, 7});
       },
       [](PolygonSoup& s) { s.facets[3].resize(2); }, MeshDefect::kNotClosed},
      {"a triangle without area that fills a T-junction",
       [=](PolygonSoup& s) {
         with_middle(s);
         s.facets[0] = {0, 2, 3, 1, 8};
         s.facets.push_back({0, 8, 1});
       },
       [=](PolygonSoup& s) {
         with_middle(s);
         s.facets[0] = {0, 2, 3, 1, 8};
       },
       MeshDefect::kNotClosed},
      {"a triangle without area next to two edges",
       [=](PolygonSoup& s) {
         with_middle(s);
         s.facets.push_back({0, 8, 1});
       },
       [=](PolygonSoup& s) {
         with_middle(s);
         s.vertices.back().y() -= 0.25;
         s.facets.push_back({0, 8, 1});
       },
       MeshDefect::kNotManifold},
      {"triangles without area in a row",
       [](PolygonSoup& s) {
         // Corners at 1/4 and 3/4 of the edge from 0 to 1, in one polygon.
         s.vertices.push_back(0.75 * s.vertices[0] + 0.25 * s.vertices[1]);
         s.vertices.push_back(0.25 * s.vertices[0] + 0.75 * s.vertices[1]);
         s.facets[0] = {0, 2, 3, 1, 9, 8};
         s.facets.push_back({0, 8, 9});
         s.facets.push_back({0, 9, 1});
       },
       [](PolygonSoup& s) {
         s.vertices.push_back(0.75 * s.vertices[0] + 0.25 * s.vertices[1]);
         s.vertices.push_back(0.25 * s.vertices[0] + 0.75 * s.vertices[1]);
         s.facets[0] = {0, 2, 3, 1, 9, 8};
         s.facets.push_back({0, 9, 1});
       },
       MeshDefect::kNotClosed},
      {"a facet twice",
       [](PolygonSoup& s) {
         s.facets.push_back({2, 3, 1, 0});
       },
       [](PolygonSoup& s) {
         s.facets.push_back({0, 2, 3});
       },
       MeshDefect::kNotManifold},
      {"a wall inside of two facets back to back",
       [](PolygonSoup& s) {
         s.facets.push_back({0, 1, 7, 6});
         s.facets.push_back({7, 1, 0, 6});
       },
       [](PolygonSoup& s) {
         s.facets.push_back({0, 1, 7, 6});
       },
       MeshDefect::kNotManifold},
      {"a fin outside of two facets back to back",
       [](PolygonSoup& s) {
         s.vertices.push_back({0, -3, 0});
         s.facets.push_back({0, 1, 8});
         s.facets.push_back({1, 0, 8});
       },
       [](PolygonSoup& s) {
         s.vertices.push_back({0, -3, 0});
         s.facets.push_back({0, 1, 8});
       },
       MeshDefect::kNotManifold},
      {"a facet, once more and turned",
       [](PolygonSoup& s) {
         s.facets.push_back({2, 3, 1, 0});
         s.facets.push_back({1, 3, 2, 0});
       },
       [](PolygonSoup& s) {
         s.facets.push_back({1, 3, 2, 0});
       },
       MeshDefect::kNotClosed},
      {"corners apart in the last bits", [=](PolygonSoup& s) { TakeApart(s, 0.9 * within); },
       [=](PolygonSoup& s) { TakeApart(s, 1.1 * within); }, MeshDefect::kNotClosed},
  };
}

TEST(MeshChecks, WhatIsHarmlessIsMendedAndWhatIsALittleWorseIsNot) {
  for (const Harmless& harmless : HarmlessCubes()) {
    SCOPED_TRACE(harmless.what);
    PolygonSoup soup = UnitCubeSoup();
    harmless.spoil(soup);
    const Polyhedron cube = Polyhedron::FromSoup(soup, "cube");
    EXPECT_EQ(cube.face_count(), 6);
    EXPECT_NEAR(cube.mass_properties().volume, 1, 1e-12);
    EXPECT_NEAR(cube.diameter(), std::sqrt(3), 1e-12);
    soup = UnitCubeSoup();
    harmless.too_far(soup);
    try {
      static_cast<void>(Polyhedron::FromSoup(soup, "cube"));
      ADD_FAILURE() << "accepted";
    } catch (const MeshError& error) {
      EXPECT_EQ(error.defect(), harmless.defect) << error.what();
    }
  }
}

TEST(MeshChecks, ARoundBodyTakenApartInTheLastBitsIsWhole) {
  const PolygonSoup sphere = SphereSoup(20);
  PolygonSoup apart;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> bits(-4e-7, 4e-7);
  for (const auto& facet : sphere.facets) {
    auto& corners = apart.facets.emplace_back();
    for (const int v : facet) {
      corners.push_back(static_cast<int>(apart.vertices.size()));
      apart.vertices.push_back(sphere.vertices[v] +
                               Vector3d(bits(random), bits(random), bits(random)));
    }
  }
  const Polyhedron body = Polyhedron::FromSoup(apart, "sphere");
  EXPECT_EQ(body.vertices().size(), sphere.vertices.size());
  EXPECT_EQ(body.triangles().size(), sphere.facets.size());
}

TEST(MeshChecks, ASoundBodyWithVerticesNearEachOtherStaysAsItIs) {
  // The two long edges of a needle are closer than the welding distance of borders.
  PolygonSoup soup = UnitCubeSoup();
  soup.vertices.push_back(soup.vertices[5] - Vector3d(1e-7, 0, 0));
  soup.facets[1] = {4, 8, 5, 7, 6};
  soup.facets[2] = {0, 1, 5, 8, 4};
  EXPECT_EQ(Polyhedron::FromSoup(soup, "cube").vertices().size(), 9U);
}

TEST(MeshChecks, ABodyAndItsCavityThatAreBothInsideOutAreTurned) {
  PolygonSoup cavity = BoxSoup(Vector3d::Constant(-0.1), Vector3d::Constant(0.2));
  Turn(cavity);
  PolygonSoup hollow = Join(cavity, UnitCubeSoup());
  Turn(hollow);
  const Polyhedron body = Polyhedron::FromSoup(hollow, "hollow");
  EXPECT_NEAR(body.mass_properties().volume, 1 - 0.027, 1e-12);
  int enclosed = 0;
  for (FaceIndex f{0}; f < body.face_count(); ++f) enclosed += body.IsEnclosed(f) ? 1 : 0;
  EXPECT_EQ(enclosed, 6);
}

TEST(MeshChecks, ARefusalNamesTheFirstDefectAndCountsAll) {
  const auto refusal = [](const PolygonSoup& soup) {
    try {
      return std::to_string(Polyhedron::FromSoup(soup, "x.off").face_count());
    } catch (const MeshError& error) {
      return std::string(error.what());
    }
  };
  PolygonSoup open = UnitCubeSoup();
  open.facets.pop_back();
  std::ranges::reverse(open.facets[1]);
  EXPECT_EQ(refusal(open),
            "x.off: facet 0: not closed: no other facet at the edge from vertex 0 (-0.5, -0.5, "
            "-0.5) to vertex 2 (-0.5, 0.5, -0.5); in total 4 open edges in 1 border (the longest 4 "
            "long), 3 edges between facets of opposite orientation");
  PolygonSoup boxes;
  for (int i = 0; i < 3; ++i) {
    boxes = Join(boxes, BoxSoup(Vector3d(0.75 * i, 0.01 * i, 0.01 * i), Vector3d::Constant(1 + i)));
  }
  EXPECT_THAT(refusal(boxes), HasSubstr("crossing pairs, 3 closed shells (all of them overlap, "
                                        "with "));
  // A defect that is not counted has no counts in its message.
  EXPECT_EQ(refusal({}), "x.off: empty: facets not found");
}

TEST(MeshChecks, FacetsJoinWithinTheCoplanarAngleOnly) {
  // The upper face of the cube is replaced by two triangles that form a roof.
  const auto roof = [](double angle) {
    PolygonSoup soup = UnitCubeSoup();
    soup.facets[1] = {4, 5, 7};
    soup.facets.push_back({4, 7, 6});
    // Lifting corner 7 by d rotates each triangle by about d.
    soup.vertices[7].z() += angle / std::sqrt(2);
    return Polyhedron::FromSoup(soup, "roof").face_count();
  };
  EXPECT_EQ(roof(0), 6);
  EXPECT_EQ(roof(0.5 * kCoplanarAngle), 6);
  EXPECT_EQ(roof(3 * kCoplanarAngle), 7);
}

TEST(MeshChecks, AFinelyCurvedSurfaceDoesNotBecomeOneFace) {
  // A prism with an arc as one side, in steps below the coplanar angle.
  constexpr int kSteps = 1000;
  constexpr double kStep = 0.9 * kCoplanarAngle;
  const int corners = kSteps + 3;
  PolygonSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (int i = 0; i <= kSteps; ++i) {
      soup.vertices.push_back({std::cos(i * kStep), std::sin(i * kStep), z});
    }
    soup.vertices.push_back({0, std::sin(kSteps * kStep), z});
    soup.vertices.push_back({0, 0, z});
  }
  soup.facets.resize(2);
  for (int i = 0; i < corners; ++i) {
    const int j = (i + 1) % corners;
    soup.facets[0].push_back(corners - 1 - i);
    soup.facets[1].push_back(corners + i);
    soup.facets.push_back({i, j, j + corners, i + corners});
  }
  const Polyhedron body = Polyhedron::FromSoup(soup, "bulge");
  // A face contains its first polygon and one on each side; the next one is beyond the angle.
  const int flat = 5;
  EXPECT_GE(body.face_count() - flat, kSteps / 3);
  EXPECT_LT(body.face_count() - flat, kSteps) << "nothing was joined";
}

TEST(MeshChecks, SliversJoinTheirNeighbour) {
  // A vertex slightly off an edge of the cube's upper face makes a needle with a different normal.
  PolygonSoup soup = UnitCubeSoup();
  soup.vertices.push_back({0, -0.5, 0.5 - 1e-9});
  soup.facets[2] = {0, 1, 5, 8, 4};
  soup.facets.push_back({4, 8, 5});
  EXPECT_EQ(Polyhedron::FromSoup(soup, "needle").face_count(), 6);
  soup.vertices.back().z() = 0.5 - 1e-3;  // the face −y now has a notch
  soup.vertices.back().y() = -0.5 + 1e-3;
  soup.facets[2] = {0, 1, 5, 4};
  soup.facets.back() = {4, 5, 8};
  soup.facets[1] = {4, 5, 7, 6};
  EXPECT_THROW(static_cast<void>(Polyhedron::FromSoup(soup, "fin")), MeshError);
}

TEST(MeshChecks, FacesDoNotDependOnHowFacetsAreCut) {
  for (const auto& soup : {UnitCubeSoup(), LBlockSoup(), HoleBlockSoup()}) {
    const Polyhedron whole = Polyhedron::FromSoup(soup, "whole");
    PolygonSoup cut{whole.vertices(), {}};
    for (const auto& t : whole.triangles()) cut.facets.push_back({t[1], t[2], t[0]});
    std::mt19937 random(3);
    std::ranges::shuffle(cut.facets, random);
    const Polyhedron triangles = Polyhedron::FromSoup(cut, "cut");
    ASSERT_EQ(triangles.face_count(), whole.face_count());
    EXPECT_NEAR(triangles.mass_properties().volume, whole.mass_properties().volume, 1e-12);
    for (FaceIndex f{0}; f < whole.face_count(); ++f) {
      const auto near = triangles.FacesNear(
          whole.vertices()[whole.triangles()[whole.TrianglesOf(f)[0]][0]], 1e-9);
      const bool same = std::ranges::any_of(near, [&](FaceIndex g) {
        return (triangles.inward_normal(g) - whole.inward_normal(f)).norm() < 1e-12 &&
               std::abs(triangles.face_measure(g) - whole.face_measure(f)) < 1e-12;
      });
      EXPECT_TRUE(same) << "face " << f;
    }
  }
}

TEST(MeshChecks, ALargeMeshIsReadAndAHugeOneRefused) {
  const PolygonSoup sphere = SphereSoup(110);
  const Polyhedron ball = Polyhedron::FromSoup(sphere, "ball");
  EXPECT_EQ(ball.triangles().size(), sphere.facets.size());
  EXPECT_GT(ball.triangles().size(), 45000u);
  EXPECT_NEAR(ball.diameter(), 2, 1e-12);
  EXPECT_NEAR(ball.mass_properties().volume, 4 * std::numbers::pi / 3, 0.01);
  PolygonSoup huge{sphere.vertices, {}};
  huge.facets.resize(kMaxFacets + 1, {0, 1, 2});
  try {
    static_cast<void>(Polyhedron::FromSoup(huge, "huge"));
    ADD_FAILURE() << "accepted";
  } catch (const MeshError& error) {
    EXPECT_EQ(error.defect(), MeshDefect::kTooLarge);
  }
}

}  // namespace mesh_checks_test
}  // namespace regrasp::object
