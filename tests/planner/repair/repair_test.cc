#include "planner/repair/repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "planner/base/error.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/read_object.h"
#include "planner/repair/comparison.h"
#include "planner/sampling/surface_sampler.h"
#include "tests/fixtures/soups.h"

namespace regrasp::repair {
namespace repair_test {

using Eigen::Vector3d;
using object::PolygonSoup;
using object::Polyhedron;
using object::RepairOptions;
using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

constexpr double kTight = 1e-9;

Polyhedron SolidOf(const Repaired& repaired) {
  return Polyhedron::FromSoup(repaired.solid, "repaired");
}

std::string LastStage(const Repaired& repaired) { return repaired.stages.back().stage; }

/// Return the error of a repair that finds no solid; nullopt if it finds one.
std::optional<NotRepaired> FindRefusal(const PolygonSoup& soup, const RepairOptions& options) {
  try {
    (void)Repair(soup, "soup", options);
  } catch (const NotRepaired& refusal) {
    return refusal;
  }
  return std::nullopt;
}

std::string Refusal(const PolygonSoup& soup, const RepairOptions& options = {}) {
  const auto refusal = FindRefusal(soup, options);
  return refusal ? refusal->what() : "not refused";
}

/// Return a cube whose sixth face was filled by an earlier repair.
PolygonSoup MarkedCube() {
  PolygonSoup cube = UnitCubeSoup();
  cube.facets.pop_back();
  return Repair(cube, "cube", {}).solid;
}

/// Return the part of a sphere of 20 rows whose faces are wholly above a height.
PolygonSoup SphereAbove(double height) {
  PolygonSoup soup = SphereSoup(20);
  std::erase_if(soup.facets, [&](const std::vector<int>& facet) {
    return std::ranges::any_of(facet, [&](int v) { return soup.vertices[v].z() < height; });
  });
  return soup;
}

/// Split each triangle into four similar ones with the same mark. Equal vertices are separate.
PolygonSoup Quartered(const PolygonSoup& soup) {
  PolygonSoup fine;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const auto& t = soup.facets[f];
    const Vector3d &a = soup.vertices[t[0]], &b = soup.vertices[t[1]], &c = soup.vertices[t[2]];
    const Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    for (const auto& corners : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      const int first = static_cast<int>(fine.vertices.size());
      fine.vertices.insert(fine.vertices.end(), corners.begin(), corners.end());
      fine.facets.push_back({first, first + 1, first + 2});
      fine.filled.push_back(soup.filled[f]);
    }
  }
  return fine;
}

/// Return the inner and outer surface of a tube of length 1, without its two rims.
constexpr double kTubeRadius = 0.06;
PolygonSoup RimlessTube(double wall) {
  constexpr int kAround = 24;
  PolygonSoup soup;
  for (const double radius : {kTubeRadius, kTubeRadius - wall}) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int i = 0; i < kAround; ++i) {
      const double turn = 2 * std::numbers::pi * i / kAround;
      for (const double z : {0.0, 1.0}) {
        soup.vertices.push_back({radius * std::cos(turn), radius * std::sin(turn), z});
      }
      const int a = first + 2 * i, b = first + 2 * ((i + 1) % kAround);
      soup.facets.push_back({a, b, b + 1, a + 1});
    }
  }
  return soup;
}

TEST(Repair, ASolidStaysAsItIs) {
  const Repaired repaired = Repair(UnitCubeSoup(), "cube", {});
  EXPECT_EQ(LastStage(repaired), "read");
  EXPECT_NEAR(repaired.volume, 1, kTight);
  EXPECT_EQ(repaired.comparison.to_solid.largest, 0);
  EXPECT_EQ(repaired.comparison.filled_share, 0);
}

TEST(Repair, ACubeWithoutAFaceGetsItBackAsFilled) {
  PolygonSoup cube = UnitCubeSoup();
  const std::vector<int> lost = cube.facets.back();
  cube.facets.pop_back();
  const Repaired repaired = Repair(cube, "cube", {});
  EXPECT_EQ(LastStage(repaired), "fill-holes");
  EXPECT_NEAR(repaired.volume, 1, kTight);
  EXPECT_NEAR(repaired.comparison.filled_share, 1.0 / 6, kTight);
  const Polyhedron solid = SolidOf(repaired);
  int filled = 0;
  for (FaceIndex face{0}; face < solid.face_count(); ++face) {
    if (!solid.IsFilled(face)) continue;
    ++filled;
    EXPECT_NEAR(solid.CentroidOf(face).x(), cube.vertices[lost[0]].x(), kTight);
  }
  EXPECT_EQ(filled, 1);
  EXPECT_EQ(repaired.stages.back().facts["holes"], 1);
  EXPECT_NEAR(repaired.stages.back().facts["widest"][0]["border_length"], 4, kTight);
  EXPECT_NEAR(repaired.stages.back().facts["widest"][0]["width"], std::sqrt(2), kTight);
}

TEST(Repair, WhatWasInventedStaysInventedWhenItIsRepairedAgain) {
  PolygonSoup cube = UnitCubeSoup();
  cube.facets.pop_back();
  const Repaired once = Repair(cube, "cube", {});
  const Repaired again = Repair(once.solid, "cube", {});
  EXPECT_EQ(LastStage(again), "read");
  EXPECT_EQ(again.solid.filled, once.solid.filled);
  EXPECT_EQ(FormatSolid(again.solid), FormatSolid(once.solid));
}

TEST(Repair, WhatWasInventedStaysInventedWhereTheMarkedFileIsNoSolidAnyMore) {
  PolygonSoup cube = MarkedCube();
  ASSERT_TRUE(cube.filled.back());
  cube.facets.pop_back();  // one of the lid's triangles
  cube.filled.pop_back();
  const Repaired again = Repair(cube, "cube", {});
  EXPECT_EQ(LastStage(again), "fill-holes");
  EXPECT_NEAR(FilledShare(again.solid), 1.0 / 6, kTight);
}

TEST(Repair, WhatWasInventedStaysInventedInACoarserSolid) {
  PolygonSoup cube = Quartered(Quartered(Quartered(MarkedCube())));
  RepairOptions options;
  options.facets = 100;
  const Repaired coarse = Repair(cube, "cube", options);
  EXPECT_EQ(LastStage(coarse), "simplify");
  EXPECT_NEAR(FilledShare(coarse.solid), 1.0 / 6, kTight);
  EXPECT_NEAR(SolidOf(coarse).mass_properties().volume, 1, kTight);
  // Control: without marks no surface is filled.
  cube.filled.clear();
  EXPECT_EQ(FilledShare(Repair(cube, "cube", options).solid), 0);
}

/// Collapsing edges without care makes triangles of this surface intersect.
TEST(Repair, WhereCollapsesMakeFacetsMeetOthersAreFound) {
  // Amplitude over the radius. The sign varies between vertices without a pattern.
  constexpr double kBump = 0.05;
  PolygonSoup bumpy = SphereSoup(30);
  for (std::size_t i = 0; i < bumpy.vertices.size(); ++i) {
    bumpy.vertices[i] *= 1 + kBump * std::sin(12.9898 * double(i * i));
  }
  RepairOptions options;
  options.facets = 800;
  options.max_deviation = 0.2;
  const Repaired coarse = Repair(bumpy, "bumpy", options);
  EXPECT_EQ(LastStage(coarse), "simplify");
  EXPECT_LE(std::ssize(coarse.solid.facets), 800);
  // Bumps nearly cancel out: this is a sixth of the volume that they would add if all were outward.
  constexpr double kVolumeOff = 0.1;
  EXPECT_NEAR(SolidOf(coarse).mass_properties().volume, 4 * std::numbers::pi / 3, kVolumeOff);
  // If a wall is too thin for any valid collapse, the solid is rejected.
  PolygonSoup hollow = SphereSoup(20);
  const PolygonSoup inside = hollow;
  const int first = static_cast<int>(hollow.vertices.size());
  for (const Vector3d& v : inside.vertices) hollow.vertices.emplace_back(0.98 * v);
  for (std::vector<int> facet : inside.facets) {
    std::ranges::reverse(facet);
    for (int& corner : facet) corner += first;
    hollow.facets.push_back(std::move(facet));
  }
  options.facets = 200;
  EXPECT_THAT(Refusal(hollow, options),
              AllOf(HasSubstr("self-intersecting"), HasSubstr("larger --repair max-triangles")));
}

TEST(Repair, ACoarserSolidIsNotInventedWhereItIsMerelyFarOff) {
  RepairOptions options;
  options.facets = 60;
  options.max_deviation = 0.1;
  const Repaired coarse = Repair(SphereSoup(20), "sphere", options);
  EXPECT_GT(coarse.comparison.seen_most, 2 * kFilledDistance * coarse.diameter);
  EXPECT_EQ(coarse.comparison.filled_share, 0);
  // Control: the filled surface of a gap keeps its mark.
  const double share = Repair(SphereAbove(-0.75), "most", {}).comparison.filled_share;
  const Repaired lid = Repair(SphereAbove(-0.75), "most", options);
  EXPECT_EQ(LastStage(lid), "simplify");
  EXPECT_NEAR(FilledShare(lid.solid), share, 0.5 * share);
  // The required deviation is respected.
  options.max_deviation = 0.005;
  EXPECT_THAT(Refusal(SphereSoup(20), options), HasSubstr("deviates too much"));
}

TEST(Repair, NoContactIsDrawnOnFilledSurface) {
  PolygonSoup cube = UnitCubeSoup();
  cube.facets.pop_back();
  const Polyhedron solid = SolidOf(Repair(cube, "cube", {}));
  const sampling::SurfaceSampler sampler(solid);
  EXPECT_NEAR(sampler.measure(), 5, kTight);
  // Control: without marks all six faces are sampled.
  PolygonSoup unmarked = Repair(cube, "cube", {}).solid;
  unmarked.filled.clear();
  const Polyhedron whole = Polyhedron::FromSoup(unmarked, "whole");
  EXPECT_NEAR(sampling::SurfaceSampler(whole).measure(), 6, kTight);
}

TEST(Repair, FilledSurfaceJoinsNoFaceOfTheOriginal) {
  // A filled gap in the middle of a planar face is coplanar with it, but a separate face.
  PolygonSoup block = HoleBlockSoup();
  std::erase_if(block.facets, [](const std::vector<int>& f) {
    return f[0] % 8 >= 4 && f[1] % 8 >= 4 && f[2] % 8 >= 4 && f[3] % 8 >= 4;
  });
  const Repaired repaired = Repair(block, "block", {});
  EXPECT_NEAR(repaired.volume, 9, kTight);
  EXPECT_EQ(SolidOf(repaired).face_count(), 8);  // six of the box, two of them with a lid
}

TEST(Repair, OverlappingShellsBecomeTheirUnion) {
  const PolygonSoup two =
      Join(BoxSoup({0, 0, 0}, {2, 1, 1}), BoxSoup({1, 0.25, 0.25}, {3, 0.75, 0.75}));
  const Repaired repaired = Repair(two, "two", {});
  EXPECT_EQ(LastStage(repaired), "unite-shells");
  EXPECT_NEAR(repaired.volume, 2.25, kTight);
  EXPECT_EQ(repaired.comparison.filled_share, 0);
  EXPECT_EQ(repaired.stages.back().facts["shells"], 2);
}

TEST(Repair, AShellThatTurnsInwardsBesideOthersIsTurned) {
  PolygonSoup inward = BoxSoup({1, 0.25, 0.25}, {3, 0.75, 0.75});
  Turn(inward);
  EXPECT_NEAR(Repair(Join(BoxSoup({0, 0, 0}, {2, 1, 1}), inward), "two", {}).volume, 2.25, kTight);
}

TEST(Repair, FacetsThatAreTurnedTheWrongWayAreTurned) {
  PolygonSoup cube = UnitCubeSoup();
  std::ranges::reverse(cube.facets[2]);
  const Repaired repaired = Repair(cube, "cube", {});
  EXPECT_EQ(LastStage(repaired), "clean");
  EXPECT_NEAR(repaired.volume, 1, kTight);
}

TEST(Repair, SolidsBesideEachOtherAreRefusedUnlessOneIsChosen) {
  const PolygonSoup two = Join(BoxSoup({0, 0, 0}, {2, 1, 1}), BoxSoup({5, 0, 0}, {6, 1, 1}));
  EXPECT_THAT(Refusal(two), AllOf(HasSubstr("2 separate solids"), HasSubstr("66.7 %"),
                                  HasSubstr("33.3 %"), HasSubstr("--repair part=K")));
  RepairOptions options;
  options.part = 1;
  const Repaired first = Repair(two, "two", options);
  EXPECT_NEAR(first.volume, 2, kTight);
  // Solids that `part` excludes do not count as missing.
  EXPECT_NEAR(first.comparison.seen_most, 0, kTight);
  options.part = 2;
  EXPECT_NEAR(Repair(two, "two", options).volume, 1, kTight);
  options.part = 3;
  EXPECT_THAT(Refusal(two, options), HasSubstr("no part 3"));
}

TEST(Repair, ARefusalTellsEachStageAndNamesTheOneThatHelps) {
  // Two separate boxes, one with a hole. The wrap, which is the last stage, cannot help.
  PolygonSoup two = Join(BoxSoup({0, 0, 0}, {2, 1, 1}), BoxSoup({5, 0, 0}, {6, 1, 1}));
  two.facets.pop_back();
  const auto refusal = FindRefusal(two, {});
  ASSERT_TRUE(refusal);
  EXPECT_THAT(refusal->what(), AllOf(HasSubstr("take-part"), HasSubstr("--repair part=K")));
  const Attempt& attempt = refusal->attempt();
  EXPECT_EQ(attempt.facets_before, two.facets.size());
  EXPECT_GT(attempt.stages.size(), 3u);
  EXPECT_EQ(attempt.stages.front().stage, "read");
  EXPECT_THAT(attempt.stages.front().outcome, HasSubstr("not closed"));
  for (const StageReport& stage : attempt.stages) EXPECT_NE(stage.outcome, "solid");
  const Json report = RefusalReport(*refusal, {"two.obj", "digest", two}, {});
  EXPECT_EQ(report["verdict"], "refused");
  EXPECT_EQ(report["reason"], refusal->what());
  EXPECT_EQ(report["stages"].size(), attempt.stages.size());
}

TEST(Repair, AFoldIsCutOutAndWhatIsFarFromItStays) {
  // A vertex is moved through the sphere, so that its fan of triangles intersects the other side.
  PolygonSoup soup = SphereSoup(40);
  const auto top = std::ranges::max_element(
      soup.vertices, {}, [](const Vector3d& v) { return v.x() + v.y() + 0.5 * v.z(); });
  const Vector3d was = *top;
  *top = -1.2 * was;
  RepairOptions options;
  options.max_deviation = 0.02;
  const Repaired repaired = Repair(soup, "fold", options);
  EXPECT_EQ(LastStage(repaired), "remove-crossings");
  EXPECT_NEAR(repaired.volume, 4.0 / 3 * 3.14159265, 0.05);
  const Json& facts = repaired.stages.back().facts;
  EXPECT_GT(facts["crossing_facets"], 4);
  EXPECT_GE(facts["facets_cut_out"], facts["crossing_facets"]);
  EXPECT_LT(facts["facets_cut_out"], soup.facets.size() / 20);
}

TEST(Repair, ASpeckBesideASolidIsDropped) {
  const PolygonSoup two =
      Join(BoxSoup({0, 0, 0}, {2, 1, 1}), BoxSoup({2.1, 0, 0}, {2.15, 0.05, 0.05}));
  EXPECT_NEAR(Repair(two, "two", {}).volume, 2, kTight);
}

TEST(Repair, AnOpenSheetIsRefusedAndGetsAWallWhereOneIsAsked) {
  PolygonSoup sheet = BoxSoup({0, 0, 0}, {2, 2, 1});
  sheet.facets.resize(1);
  EXPECT_THAT(Refusal(sheet), HasSubstr("--repair wall=T"));
  RepairOptions options;
  options.thickness = 0.1;
  const Repaired repaired = Repair(sheet, "sheet", options);
  EXPECT_NEAR(repaired.volume, 4 * 0.1, 0.1 * 4 * 0.1);
  EXPECT_EQ(LastStage(repaired), "solidify");
}

TEST(Repair, AThinSolidIsNoSheet) {
  // A closed plate with a thickness of 0.2 % of its diameter, and a box through it.
  const PolygonSoup plate =
      Join(BoxSoup({0, 0, 0}, {2, 2, 0.005}), BoxSoup({0.9, 0.9, -0.02}, {1.1, 1.1, 0.02}));
  EXPECT_EQ(LastStage(Repair(plate, "plate", {})), "unite-shells");
}

TEST(Repair, AScanOfOneSideIsRefusedWithTheShareThatIsMissing) {
  EXPECT_THAT(Refusal(SphereAbove(-0.01)),
              AllOf(HasSubstr("surface incomplete"), HasSubstr("filled in"), HasSubstr("25 %")));
  // Control: most of the sphere suffices.
  const Repaired most = Repair(SphereAbove(-0.75), "most", {});
  EXPECT_GT(most.comparison.filled_share, 0.05);
  EXPECT_LT(most.comparison.filled_share, 0.25);
}

TEST(Repair, AStrayFacetIsDropped) {
  PolygonSoup soup = UnitCubeSoup();
  soup.vertices.push_back({-0.2, 0.3, -0.8});
  soup.vertices.push_back({0.2, 0.1, 0.8});
  soup.vertices.push_back({0.3, 0.3, 0.8});
  soup.facets.push_back({8, 9, 10});
  RepairOptions options;
  options.max_deviation = 0.1;  // its ends protrude
  const Repaired repaired = Repair(soup, "soup", options);
  EXPECT_NEAR(repaired.volume, 1, kTight);
  EXPECT_EQ(SolidOf(repaired).face_count(), 6);
}

TEST(Repair, WhatFormsNoSurfaceIsWrapped) {
  // Six squares that intersect slightly. No two have a corner in common.
  PolygonSoup soup;
  for (const auto& facet : UnitCubeSoup().facets) {
    Vector3d centre = Vector3d::Zero();
    for (const int v : facet) centre += UnitCubeSoup().vertices[v] / 4;
    std::vector<int>& square = soup.facets.emplace_back();
    for (const int v : facet) {
      square.push_back(static_cast<int>(soup.vertices.size()));
      soup.vertices.push_back(centre + 1.01 * (UnitCubeSoup().vertices[v] - centre));
    }
  }
  const Repaired repaired = Repair(soup, "soup", {});
  EXPECT_EQ(LastStage(repaired), "wrap");
  EXPECT_NEAR(repaired.volume, 1, 0.03);
  EXPECT_LT(repaired.comparison.seen_most, 0.01 * repaired.diameter);
  const auto& volumes = repaired.stages.back().facts["volumes"];
  ASSERT_EQ(volumes.size(), 2u);
  // A smaller sphere enters more openings.
  EXPECT_GT(volumes[0]["radius"], volumes[1]["radius"]);
  EXPECT_GE(volumes[0]["volume"], volumes[1]["volume"]);
}

TEST(Repair, WhatFillsAWideHoleMayHideTheSurfaceAndIsThenLeftOut) {
  constexpr double kWall = 0.015;
  const Repaired tube = Repair(RimlessTube(kWall), "tube", {});
  EXPECT_EQ(LastStage(tube), "wrap-unfilled");
  EXPECT_NEAR(tube.volume, 2 * std::numbers::pi * (kTubeRadius - kWall / 2) * kWall, 5e-4);
  EXPECT_LT(tube.comparison.seen_most, 0.002 * tube.diameter);
}

TEST(Repair, AWrapThatEntersAHollowBodyIsRefused) {
  // As above, but the sphere passes between the rims, so that only the two surfaces remain.
  const auto refusal = FindRefusal(RimlessTube(0.03), {});
  ASSERT_TRUE(refusal);
  const StageReport& last = refusal->attempt().stages.back();
  EXPECT_EQ(last.stage, "wrap-unfilled");
  const auto& volumes = last.facts["volumes"];
  EXPECT_LT(volumes[1]["volume"].get<double>(), 0.2 * volumes[0]["volume"].get<double>());
  EXPECT_THAT(refusal->what(), AllOf(HasSubstr("open sheet"), HasSubstr("--repair wall=T")));
}

TEST(Repair, ACloudOfPointsOfAllSidesBecomesABodyAndOneOfOneSideIsRefused) {
  PolygonSoup cloud{SphereSoup(40).vertices, {}};
  const Repaired repaired = Repair(cloud, "cloud", {});
  EXPECT_NEAR(repaired.volume, 4.0 / 3 * 3.14159265, 0.05);
  EXPECT_LT(repaired.comparison.filled_share, 0.01);
  std::erase_if(cloud.vertices, [](const Vector3d& v) { return v.z() < 0; });
  EXPECT_THAT(Refusal(cloud), HasSubstr("surface incomplete"));
}

TEST(Repair, ACloudWhosePointsScatterIsRefusedForThat) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> share(-1, 1);
  PolygonSoup sharp, scattered;
  while (std::ssize(sharp.vertices) < 1000) {
    const Vector3d v(share(generator), share(generator), share(generator));
    if (v.norm() < 0.1 || v.norm() > 1) continue;
    sharp.vertices.emplace_back(v.normalized());
    scattered.vertices.emplace_back(v.normalized() * (1 + 0.2 * share(generator)));
  }
  EXPECT_NEAR(Repair(sharp, "cloud", {}).volume, 4.0 / 3 * std::numbers::pi, 0.1);
  EXPECT_THAT(Refusal(scattered), AllOf(HasSubstr("points too noisy"), HasSubstr("smooth")));
}

TEST(Repair, ASolidTurnsOutwardsWhicheverWayItsFileDoes) {
  PolygonSoup open = UnitCubeSoup();
  open.facets.pop_back();
  for (PolygonSoup cube : {UnitCubeSoup(), open}) {
    Turn(cube);
    const PolygonSoup solid = Repair(cube, "cube", {}).solid;
    for (const auto& facet : solid.facets) {
      const Vector3d& a = solid.vertices[facet[0]];
      const Vector3d normal = (solid.vertices[facet[1]] - a).cross(solid.vertices[facet[2]] - a);
      EXPECT_GT(normal.dot(a), 0);  // the centre of the cube is the origin
    }
  }
}

TEST(Repair, ACloudOnAGridIsJoinedTheSameWayWhateverTheMemoryIsLike) {
  // Many triangles have equal size. Their order must not depend on addresses.
  PolygonSoup cloud;
  for (int i = 0; i < 11 * 11 * 11; ++i) {
    const Vector3d p(i % 11, i / 11 % 11, i / 121);
    if (p.minCoeff() == 0 || p.maxCoeff() == 10) cloud.vertices.push_back(p);
  }
  const std::string text = FormatSolid(Repair(cloud, "cloud", {}).solid);
  std::vector<std::string> blocks;
  for (int i = 0; i < 20'000; ++i) blocks.emplace_back(std::size_t(20 + i * 7919 % 3001), 'x');
  for (int i = 0; i < 20'000; i += 1 + i * 31 % 5) std::string().swap(blocks[std::size_t(i)]);
  EXPECT_EQ(FormatSolid(Repair(cloud, "cloud", {}).solid), text);
}

TEST(Repair, TheSameSurfaceGivesTheSameBytesAndTheFileHoldsTheSameSolid) {
  const PolygonSoup soup = SphereAbove(-0.75);
  const Repaired repaired = Repair(soup, "sphere", {});
  const std::string text = FormatSolid(repaired.solid);
  EXPECT_EQ(FormatSolid(Repair(soup, "sphere", {}).solid), text);
  const PolygonSoup read = object::ReadObj(text, "file");
  EXPECT_EQ(read.vertices, repaired.solid.vertices);
  EXPECT_EQ(read.facets, repaired.solid.facets);
  EXPECT_EQ(read.filled, repaired.solid.filled);
}

TEST(Repair, ACoarserSolidHasNoMoreFacetsThanAskedAndKeepsToTheDeviation) {
  RepairOptions options;
  options.facets = 500;
  const Repaired repaired = Repair(SphereSoup(30), "sphere", options);
  EXPECT_LE(repaired.solid.facets.size(), 500u);
  EXPECT_LT(repaired.comparison.seen_most, 0.01 * repaired.diameter);
  options.facets = 20;
  EXPECT_THAT(Refusal(SphereSoup(30), options), HasSubstr("--repair max-deviation"));
}

/// STL lists each vertex once per triangle.
TEST(Repair, ACoarserSolidOfAFileWithRepeatedVerticesIsCoarserToo) {
  const PolygonSoup sphere = SphereSoup(30);
  PolygonSoup split;
  for (const std::vector<int>& facet : sphere.facets) {
    std::vector<int>& copy = split.facets.emplace_back();
    for (const int vertex : facet) {
      copy.push_back(static_cast<int>(split.vertices.size()));
      split.vertices.push_back(sphere.vertices[vertex]);
    }
  }
  RepairOptions options;
  options.facets = 500;
  const Repaired coarse = Repair(split, "split", options);
  EXPECT_LE(coarse.solid.facets.size(), 500u);
  // 500 triangles inscribed in a sphere have 1.5 % less volume.
  constexpr double kVolumeOff = 0.1;
  EXPECT_NEAR(SolidOf(coarse).mass_properties().volume, 4 * std::numbers::pi / 3, kVolumeOff);
  // Without a limit the solid is that of the file with each vertex once.
  const Repaired same = Repair(split, "split", {});
  EXPECT_EQ(same.solid.facets.size(), sphere.facets.size());
  EXPECT_EQ(same.solid.vertices.size(), sphere.vertices.size());
  // Vertices that differ by rounding belong together, too.
  constexpr double kRounding = 1e-15;
  for (std::size_t i = 0; i < split.vertices.size(); ++i) {
    split.vertices[i].x() += i % 2 == 0 ? kRounding : -kRounding;
  }
  EXPECT_LE(Repair(split, "split", options).solid.facets.size(), 500u);
}

TEST(Repair, LengthsScaleWithTheObjectAndSharesStay) {
  PolygonSoup cube = UnitCubeSoup();
  cube.facets.pop_back();
  const Repaired one = Repair(cube, "cube", {});
  Transform(cube, Eigen::Affine3d(Eigen::Scaling(1e-3)));
  const Repaired small = Repair(cube, "cube", {});
  EXPECT_NEAR(small.volume, 1e-9, 1e-9 * kTight);
  EXPECT_NEAR(small.diameter, 1e-3 * one.diameter, kTight);
  EXPECT_NEAR(small.comparison.filled_share, one.comparison.filled_share, kTight);
}

TEST(Repair, TheTimeLimitEndsIt) {
  object::Reading reading;
  reading.deadline = Deadline(Deadline::Clock::now());
  PolygonSoup cube = UnitCubeSoup();
  cube.facets.pop_back();
  EXPECT_THROW((void)Repair(cube, "cube", {}, reading), TimeUp);
}

}  // namespace repair_test
}  // namespace regrasp::repair
