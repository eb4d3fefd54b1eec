// Treatment of several closed shells, with and without a choice.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace shells_test {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace regrasp::soups;  // NOLINT: the meshes of this folder

PolygonSoup Box(double from, double to) {
  return BoxSoup(Vector3d::Constant(from), Vector3d::Constant(to));
}

PolygonSoup InwardBox(double from, double to) {
  PolygonSoup box = Box(from, to);
  Turn(box);
  return box;
}

Polyhedron Read(const PolygonSoup& soup, std::optional<Shells> shells,
                std::string* text = nullptr) {
  Reading reading;
  reading.shells = shells;
  if (text != nullptr) reading.on_shells = [text](const std::string& told) { *text += told; };
  return Polyhedron::FromSoup(soup, "x.obj", reading);
}

/// Return the message of a rejection; empty if there is none.
std::string Refusal(const PolygonSoup& soup, std::optional<Shells> shells) {
  try {
    static_cast<void>(Read(soup, shells));
    return "";
  } catch (const MeshError& error) {
    return error.what();
  }
}

int CountEnclosed(const Polyhedron& body) {
  int enclosed = 0;
  for (FaceIndex f{0}; f < body.face_count(); ++f) enclosed += body.IsEnclosed(f) ? 1 : 0;
  return enclosed;
}

TEST(Shells, SolidsBesideEachOtherAreOneRigidBody) {
  const PolygonSoup both = Join(Box(0, 1), Box(3, 5));
  std::string text;
  const Polyhedron body = Read(both, Shells::kUnion, &text);
  const MassProperties one = Read(Box(0, 1), {}).mass_properties();
  const MassProperties other = Read(Box(3, 5), {}).mass_properties();
  const MassProperties& sum = body.mass_properties();
  EXPECT_NEAR(sum.volume, one.volume + other.volume, 1e-12);
  const Vector3d centroid =
      (one.volume * one.centroid + other.volume * other.centroid) / sum.volume;
  EXPECT_NEAR((sum.centroid - centroid).norm(), 0, 1e-12);
  EXPECT_EQ(body.face_count(), 12);
  EXPECT_EQ(CountEnclosed(body), 0);
  EXPECT_NEAR(body.diameter(), 5 * std::sqrt(3), 1e-12);
  EXPECT_EQ(text, "2 closed shells form one body of 2 solids");
}

TEST(Shells, WithoutAChoiceTheRefusalSaysHowManyThereAreAndHowLarge) {
  const PolygonSoup three = Join(Join(Box(0, 1), Box(3, 5)), Box(6, 7));
  EXPECT_THAT(Refusal(three, {}),
              AllOf(HasSubstr("several solids"),
                    HasSubstr("3 closed shells (with 80 %, 10 %, 10 % of the volume)"),
                    HasSubstr("--shells union"), HasSubstr("--shells largest")));
  EXPECT_EQ(Refusal(three, Shells::kUnion), "");
  EXPECT_EQ(Refusal(three, Shells::kLargest), "");
}

TEST(Shells, TheUnionOfSolidsInEachOtherIsTheOuterOne) {
  std::string text;
  const Polyhedron body = Read(Join(Box(0.2, 0.4), Box(0, 1)), Shells::kUnion, &text);
  EXPECT_NEAR(body.mass_properties().volume, 1, 1e-12);
  EXPECT_EQ(body.face_count(), 6);
  EXPECT_EQ(CountEnclosed(body), 0);
  EXPECT_THAT(text, HasSubstr("1 inside the material, omitted"));
  // The outer solid fills a cavity of the inner solid, but not a cavity around it.
  EXPECT_NEAR(Read(Join(Join(Box(0.2, 0.8), InwardBox(0.3, 0.7)), Box(0, 1)), Shells::kUnion)
                  .mass_properties()
                  .volume,
              1, 1e-12);
  const Polyhedron hollow =
      Read(Join(Join(Box(0.4, 0.6), InwardBox(0.2, 0.8)), Box(0, 1)), Shells::kUnion);
  EXPECT_NEAR(hollow.mass_properties().volume, 1 - 0.216 + 0.008, 1e-12);
  EXPECT_EQ(CountEnclosed(hollow), 12) << "the cavity and what is in it";
}

TEST(Shells, EachOfSeveralSolidsIsTurnedByItself) {
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      PolygonSoup one = Join(Box(0, 1), InwardBox(0.4, 0.6)), other = Box(3, 5);
      if (first) Turn(one);
      if (second) Turn(other);
      const Polyhedron body = Read(Join(one, other), Shells::kUnion);
      EXPECT_NEAR(body.mass_properties().volume, 1 - 0.008 + 8, 1e-12);
      EXPECT_EQ(CountEnclosed(body), 6);
    }
  }
}

/// Law: the choice does not change an object that is accepted without it.
TEST(Shells, OneSolidIsTheSameWithAnyChoice) {
  const PolygonSoup hollow = Join(InwardBox(0.4, 0.6), Box(0, 1));
  PolygonSoup inside_out = hollow;
  Turn(inside_out);
  for (const PolygonSoup& soup : {UnitCubeSoup(), hollow, inside_out, SphereSoup(9)}) {
    const Polyhedron plain = Read(soup, {});
    for (const Shells choice : {Shells::kUnion, Shells::kLargest}) {
      std::string text;
      const Polyhedron chosen = Read(soup, choice, &text);
      EXPECT_EQ(chosen.vertices(), plain.vertices());
      EXPECT_EQ(chosen.triangles(), plain.triangles());
      EXPECT_EQ(CountEnclosed(chosen), CountEnclosed(plain));
      EXPECT_EQ(text, "");
    }
  }
}

TEST(Shells, TheOrderOfShellsDoesNotMatter) {
  std::vector<PolygonSoup> shells = {Box(0, 1),     InwardBox(0.2, 0.8), Box(0.4, 0.6),
                                     Box(3, 5),     Box(3.5, 4),         InwardBox(6, 7),
                                     Box(6.1, 6.2), InwardBox(8, 8.5)};
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    std::ranges::shuffle(shells, random);
    PolygonSoup all;
    for (const PolygonSoup& shell : shells) all = Join(all, shell);
    const Polyhedron body = Read(all, Shells::kUnion);
    // A shell with the orientation of the solid around it, or without a solid around it, is
    // material.
    EXPECT_NEAR(body.mass_properties().volume, 1 - 0.216 + 0.008 + 8 + 1 - 0.001 + 0.125, 1e-12);
    EXPECT_NEAR(Read(all, Shells::kLargest).mass_properties().volume, 8, 1e-12);
  }
}

TEST(Shells, TheLargestIsTakenWhateverTheOthersMeet) {
  const PolygonSoup cube = UnitCubeSoup();
  const std::vector<PolygonSoup> others = {Box(2, 2.5), Box(0.3, 1), Box(0.5, 1),
                                           BoxSoup({0.5, 0.5, -0.5}, {1, 1, 0.5}), Box(-0.2, 0.2)};
  for (const PolygonSoup& other : others) {
    EXPECT_NE(Refusal(Join(other, cube), {}), "");
    std::string text;
    const Polyhedron body = Read(Join(other, cube), Shells::kLargest, &text);
    EXPECT_EQ(body.vertices().size(), 8U);
    EXPECT_NEAR(body.mass_properties().volume, 1, 1e-12);
    EXPECT_NEAR(body.diameter(), std::sqrt(3), 1e-12);
    EXPECT_THAT(text, AllOf(HasSubstr("the largest of 2 closed shells"), HasSubstr("1 with ")));
  }
}

TEST(Shells, TheLargestKeepsItsCavitiesOnly) {
  const PolygonSoup soup =
      Join(Join(Join(Box(0, 1), InwardBox(0.4, 0.6)), Box(2, 2.9)), InwardBox(2.4, 2.5));
  std::string text;
  const Polyhedron body = Read(soup, Shells::kLargest, &text);
  EXPECT_NEAR(body.mass_properties().volume, 1 - 0.008, 1e-12);
  EXPECT_EQ(CountEnclosed(body), 6);
  EXPECT_EQ(text,
            "the largest of 3 closed shells is the object; 2 with 42.2 % of their volume are left "
            "out");
}

TEST(Shells, WhatNoChoiceHelpsIsRefused) {
  const PolygonSoup crossing = Join(UnitCubeSoup(), Box(0.3, 1));
  EXPECT_THAT(Refusal(crossing, Shells::kUnion),
              AllOf(HasSubstr("self-intersecting"), HasSubstr("--repair")));
  PolygonSoup open = Join(UnitCubeSoup(), Box(2, 2.5));
  open.facets.pop_back();
  for (const Shells choice : {Shells::kUnion, Shells::kLargest}) {
    EXPECT_THAT(Refusal(open, choice), HasSubstr("not closed"));
  }
}

}  // namespace shells_test
}  // namespace regrasp::object
