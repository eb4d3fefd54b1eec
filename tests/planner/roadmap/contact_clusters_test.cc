#include "planner/roadmap/contact_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "planner/base/number.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace contact_clusters_test {

ContactClusters ClustersOf(const object::Polyhedron& solid, int clusters, std::uint64_t seed = 0) {
  return {Centroids(solid), solid.wrench_frame(), Radians(10), clusters, seed};
}

/// Name clusters by their first members, so that their numbers do not matter.
std::vector<int> Partition(const ContactClusters& clusters) {
  std::map<ClusterIndex, int> first;
  std::vector<int> names;
  for (int i = 0; i < clusters.clustered_count(); ++i) {
    names.push_back(first.try_emplace(clusters.cluster_of(i), i).first->second);
  }
  return names;
}

std::set<int> SetOf(const std::vector<int>& numbers) { return {numbers.begin(), numbers.end()}; }

TEST(ContactClusters, PartitionTheContacts) {
  const ContactClusters clusters = ClustersOf(ReadMesh("star500"), 30);
  ASSERT_EQ(clusters.clustered_count(), 500);
  ASSERT_EQ(clusters.cluster_count(), 30);
  std::vector<int> seen(500, 0);
  for (ClusterIndex j{0}; j < 30; ++j) {
    EXPECT_FALSE(clusters.members(j).empty());
    EXPECT_TRUE(std::is_sorted(clusters.members(j).begin(), clusters.members(j).end()));
    for (const int i : clusters.members(j)) {
      EXPECT_EQ(clusters.cluster_of(i), j);
      ++seen[i];
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 500);
}

TEST(ContactClusters, RepresentativesAreTheContactsNearestTheCenters) {
  const ContactClusters clusters = ClustersOf(ReadMesh("duck500"), 30);
  for (ClusterIndex j{0}; j < 30; ++j) {
    const int representative = clusters.representative(j);
    EXPECT_EQ(clusters.cluster_of(representative), j);
    EXPECT_EQ(clusters.representatives()[j], representative);
    for (int i = 0; i < clusters.clustered_count(); ++i) {
      EXPECT_GE(clusters.DistanceToCenter(i, j), clusters.DistanceToCenter(representative, j));
      EXPECT_GE(clusters.DistanceToCenter(i, j),
                clusters.DistanceToCenter(i, clusters.cluster_of(i)));
    }
  }
}

TEST(ContactClusters, DistancesAreThoseOfOneSpace) {
  const ContactClusters clusters = ClustersOf(MakeConvexBody(20, 1), 6);
  int apart = 0;
  for (int a = 0; a < 36; ++a) {
    EXPECT_EQ(clusters.Distance(a, a), 0);
    for (int b = 0; b < 36; ++b) {
      EXPECT_EQ(clusters.Distance(a, b), clusters.Distance(b, a));
      EXPECT_LE(clusters.Distance(a, b), 2 + 1e-12);  // distance of unit vectors
      if (clusters.Distance(a, b) > 0.1) ++apart;
      for (ClusterIndex j{0}; j < 6; ++j) {
        EXPECT_LE(clusters.DistanceToCenter(a, j),
                  clusters.Distance(a, b) + clusters.DistanceToCenter(b, j) + 1e-12);
      }
    }
  }
  EXPECT_GT(apart, 100);
}

TEST(ContactClusters, ContactsOfAClusterActMoreAlikeThanOthers) {
  const object::Polyhedron duck = ReadMesh("duck500");
  const std::vector<grasp::Contact> contacts = Centroids(duck);
  const ContactClusters clusters = ClustersOf(duck, 30);
  std::vector<WrenchPyramid> pyramids;
  for (const grasp::Contact& contact : contacts) {
    pyramids.push_back(PyramidOf(contact, duck.wrench_frame(), Radians(10), contacts));
  }
  const Eigen::MatrixXd distances = WrenchDistances(pyramids);
  double within = 0;
  int pairs = 0;
  for (ClusterIndex j{0}; j < 30; ++j) {
    for (const int a : clusters.members(j)) {
      for (const int b : clusters.members(j)) {
        within += distances(a, b);
        ++pairs;
      }
    }
  }
  ASSERT_GT(pairs, 1000);
  EXPECT_LT(within / pairs, 0.5 * distances.mean());
}

TEST(ContactClusters, PlaceAnAddedCopyWhereItsOriginalIs) {
  const object::Polyhedron duck = ReadMesh("duck500");
  ContactClusters clusters = ClustersOf(duck, 30);
  const std::vector<int> before = Partition(clusters);
  for (int i = 0; i < 500; i += 7) {
    const grasp::Contact original = clusters.contacts()[i];
    const int added = clusters.Add(original);
    EXPECT_EQ(added, static_cast<int>(clusters.contacts().size()) - 1);
    EXPECT_EQ(clusters.cluster_of(added), clusters.cluster_of(i));
    EXPECT_NEAR(clusters.Distance(added, i), 0, 1e-6);
    EXPECT_GT(clusters.Distance(added, (i + 250) % 500), 1e-3);
  }
  EXPECT_EQ(clusters.clustered_count(), 500);
  EXPECT_EQ(Partition(clusters), before);
  for (ClusterIndex j{0}; j < 30; ++j) {
    for (const int i : clusters.members(j)) EXPECT_LT(i, 500);
  }
}

TEST(ContactClusters, PlaceAnAddedNeighbourNearby) {
  const object::Polyhedron duck = ReadMesh("duck500");
  ContactClusters clusters = ClustersOf(duck, 30);
  const grasp::Contact original = clusters.contacts()[11];
  grasp::Contact neighbour = original;
  neighbour.p += 1e-3 * duck.diameter() * original.n.unitOrthogonal();
  const int added = clusters.Add(neighbour);
  EXPECT_LT(clusters.Distance(added, 11), 0.1);
  EXPECT_GT(clusters.Distance(added, 11), 1e-9);
}

TEST(ContactClusters, AreTheSameForTheSameSeedOnly) {
  const object::Polyhedron star = ReadMesh("star500");
  const ContactClusters a = ClustersOf(star, 30, 4);
  const ContactClusters b = ClustersOf(star, 30, 4);
  const ContactClusters c = ClustersOf(star, 30, 5);
  EXPECT_EQ(Partition(a), Partition(b));
  EXPECT_EQ(a.representatives(), b.representatives());
  EXPECT_EQ(a.Distance(3, 77), b.Distance(3, 77));
  EXPECT_NE(Partition(a), Partition(c));
}

TEST(ContactClusters, DependNeitherOnTheUnitOfLengthNorOnThePose) {
  int checked = 0;
  for (const char* name : {"duck500", "star500"}) {
    const object::Polyhedron solid = ReadMesh(name);
    const ContactClusters clusters = ClustersOf(solid, 30);
    for (const double unit : {1.0, 1000.0}) {
      const ContactClusters moved = ClustersOf(Moved(solid, MotionAndUnit(unit)), 30);
      EXPECT_EQ(Partition(moved), Partition(clusters)) << name << ", unit " << unit;
      EXPECT_EQ(SetOf(moved.representatives()), SetOf(clusters.representatives()));
      EXPECT_NEAR(moved.Distance(0, 250), clusters.Distance(0, 250), 1e-6);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 4);
}

TEST(ContactClusters, RefuseAsManyClustersAsContacts) {
  const object::Polyhedron body = MakeConvexBody(10, 1);
  EXPECT_THROW(ClustersOf(body, 0), std::invalid_argument);
  EXPECT_THROW(ClustersOf(body, 16), std::invalid_argument);
  EXPECT_EQ(ClustersOf(body, 15).cluster_count(), 15);
}

}  // namespace contact_clusters_test
}  // namespace regrasp::roadmap
