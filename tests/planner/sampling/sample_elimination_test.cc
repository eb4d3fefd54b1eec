#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/random.h"
#include "planner/sampling/contact_points.h"

namespace regrasp::sampling {
namespace sample_elimination_test {

constexpr int kKept = 50;

/// Draw contacts in the unit square, with normals upwards.
std::vector<grasp::Contact> DrawInSquare(int count) {
  RandomStream random(3, RandomUse::kContactPoints);
  std::vector<grasp::Contact> contacts;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform();
    contacts.push_back({{x, random.Uniform(), 0}, {0, 0, 1}, FaceIndex(0)});
  }
  return contacts;
}

double SmallestDistance(const std::vector<grasp::Contact>& contacts) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      smallest = std::min(smallest, (contacts[i].p - contacts[j].p).norm());
    }
  }
  return smallest;
}

TEST(EliminateSamples, KeepsThatManyOfTheContactsInTheirOrder) {
  const std::vector<grasp::Contact> all = DrawInSquare(600);
  const std::vector<grasp::Contact> kept = EliminateSamples(all, kKept, 1);
  ASSERT_EQ(kept.size(), std::size_t{kKept});
  auto place = all.begin();
  for (const grasp::Contact& contact : kept) {
    place =
        std::find_if(place, all.end(), [&](const grasp::Contact& c) { return c.p == contact.p; });
    ASSERT_NE(place, all.end());
    ++place;
  }
}

TEST(EliminateSamples, SpreadsThemFarBetterThanChance) {
  const std::vector<grasp::Contact> all = DrawInSquare(600);
  const std::vector<grasp::Contact> by_chance(all.begin(), all.begin() + kKept);
  // Fifty equal discs in a unit square are at most 0.15 apart; blue noise reaches about two thirds.
  EXPECT_GT(SmallestDistance(EliminateSamples(all, kKept, 1)), 0.09);
  EXPECT_LT(SmallestDistance(by_chance), 0.05);
}

/// Apply the same rule by brute force over all pairs and all contacts.
std::vector<grasp::Contact> EliminatePlainly(const std::vector<grasp::Contact>& contacts, int count,
                                             double area) {
  const double reach = 2 * std::sqrt(area / (2 * std::sqrt(3.0) * count));
  const double share = double(count) / double(contacts.size());
  const double floor = reach * (1 - std::pow(share, 1.5)) * 0.65;
  std::vector<grasp::Contact> kept = contacts;
  while (kept.size() > static_cast<std::size_t>(count)) {
    std::vector<double> weight(kept.size(), 0);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      for (std::size_t j = 0; j < kept.size(); ++j) {
        const double distance = (kept[i].p - kept[j].p).norm();
        if (i == j || distance >= reach) continue;
        weight[i] += std::pow(1 - std::max(distance, floor) / reach, 8);
      }
    }
    kept.erase(kept.begin() + (std::max_element(weight.begin(), weight.end()) - weight.begin()));
  }
  return kept;
}

TEST(EliminateSamples, TakesTheMostCrowdedFirst) {
  const std::vector<grasp::Contact> all = DrawInSquare(150);
  const std::vector<grasp::Contact> kept = EliminateSamples(all, 20, 1);
  const std::vector<grasp::Contact> expected = EliminatePlainly(all, 20, 1);
  ASSERT_EQ(kept.size(), 20u);
  ASSERT_EQ(expected.size(), 20u);
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i].p, expected[i].p);
}

TEST(EliminateSamples, KeepsAllWhereThereAreNoMore) {
  EXPECT_EQ(EliminateSamples(DrawInSquare(5), 5, 1).size(), 5u);
  EXPECT_EQ(EliminateSamples(DrawInSquare(5), 6, 1).size(), 5u);
  EXPECT_TRUE(EliminateSamples({}, 6, 1).empty());
}

TEST(EliminateSamples, DoesNotLetTheTwoSidesOfAPlateCrowdEachOther) {
  // Five points, each on both sides of a plate of zero thickness. The fifth point is close to the
  // fourth.
  std::vector<grasp::Contact> plate;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 3.1}) {
    plate.push_back({{x, 0, 0}, {0, 0, 1}, FaceIndex(0)});
    plate.push_back({{x, 0, 0}, {0, 0, -1}, FaceIndex(1)});
  }
  const std::vector<grasp::Contact> kept = EliminateSamples(plate, 8, 8);
  ASSERT_EQ(kept.size(), 8u);
  const auto up = std::count_if(kept.begin(), kept.end(), [](auto& c) { return c.n.z() > 0; });
  EXPECT_EQ(up, 4);
}

}  // namespace sample_elimination_test
}  // namespace regrasp::sampling
