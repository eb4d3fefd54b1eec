#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <set>
#include <stdexcept>

#include "planner/roadmap/contact_clusters.h"

namespace regrasp::roadmap {
namespace k_means_test {

KMeansClusters Cluster(const Eigen::MatrixXd& points, int count, int restarts = 5,
                       std::uint64_t seed = 1) {
  RandomStream random(seed, RandomUse::kClusters);
  return KMeans(points, count, restarts, random);
}

Eigen::MatrixXd RandomPoints(int count, int dimension, std::uint64_t seed) {
  RandomStream random(seed, RandomUse::kContactPoints);
  return Eigen::MatrixXd::NullaryExpr(count, dimension, [&] { return random.Uniform(); });
}

/// Return groups of ten points each, within 0.5 of positions ten apart.
Eigen::MatrixXd Blobs(int blobs, std::uint64_t seed) {
  Eigen::MatrixXd points = RandomPoints(10 * blobs, 3, seed);
  for (int i = 0; i < points.rows(); ++i) {
    const int blob = i % blobs;
    points.row(i) += 10 * Eigen::RowVector3d(blob & 1, blob >> 1 & 1, blob >> 2);
  }
  return points;
}

double CostOf(const Eigen::MatrixXd& points, const KMeansClusters& clusters) {
  double cost = 0;
  for (int i = 0; i < points.rows(); ++i) {
    cost += (points.row(i) - clusters.centers.row(clusters.cluster_of[i])).squaredNorm();
  }
  return cost;
}

TEST(KMeans, FindsBlobsThatAreFarApart) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const KMeansClusters clusters = Cluster(Blobs(7, seed), 7, 5, seed);
    std::set<int> used;
    for (int blob = 0; blob < 7; ++blob) used.insert(clusters.cluster_of[blob]);
    EXPECT_EQ(used.size(), 7u) << "seed " << seed;
    for (int i = 0; i < 70; ++i) EXPECT_EQ(clusters.cluster_of[i], clusters.cluster_of[i % 7]);
  }
}

TEST(KMeans, CentersAreMeansAndPointsAreNearestTheirOwn) {
  const Eigen::MatrixXd points = RandomPoints(200, 5, 3);
  const KMeansClusters clusters = Cluster(points, 12);
  for (int j = 0; j < 12; ++j) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(5);
    int size = 0;
    for (int i = 0; i < 200; ++i) {
      if (clusters.cluster_of[i] != j) continue;
      sum += points.row(i);
      ++size;
    }
    ASSERT_GT(size, 0);
    EXPECT_TRUE(clusters.centers.row(j).isApprox(sum / size, 1e-12));
  }
  for (int i = 0; i < 200; ++i) {
    Eigen::Index nearest = 0;
    (clusters.centers.rowwise() - points.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    EXPECT_EQ(clusters.cluster_of[i], nearest);
  }
  EXPECT_NEAR(clusters.cost, CostOf(points, clusters), 1e-12 * clusters.cost);
}

TEST(KMeans, LeavesNoClusterEmpty) {
  // The points have only three different positions.
  Eigen::MatrixXd points(30, 2);
  for (int i = 0; i < 30; ++i) points.row(i) << i % 3, 0;
  for (int count = 1; count <= 30; ++count) {
    const KMeansClusters clusters = Cluster(points, count);
    const std::set<int> used(clusters.cluster_of.begin(), clusters.cluster_of.end());
    EXPECT_EQ(std::ssize(used), count);
    if (count >= 3) {
      EXPECT_NEAR(clusters.cost, 0, 1e-12);
    } else {
      EXPECT_GT(clusters.cost, 1);
    }
    EXPECT_TRUE(clusters.centers.allFinite());
  }
}

TEST(KMeans, GivesEveryPointACenterWhereThereAreAsMany) {
  const Eigen::MatrixXd points = RandomPoints(25, 3, 4);
  const KMeansClusters clusters = Cluster(points, 25);
  const std::set<int> used(clusters.cluster_of.begin(), clusters.cluster_of.end());
  EXPECT_EQ(used.size(), 25u);
  EXPECT_NEAR(clusters.cost, 0, 1e-12);
}

TEST(KMeans, MoreRunsAreNeverWorse) {
  int better = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Eigen::MatrixXd points = RandomPoints(100, 3, seed);
    const double one = Cluster(points, 10, 1, seed).cost;
    const double five = Cluster(points, 10, 5, seed).cost;
    EXPECT_LE(five, one);
    if (five < one) ++better;
  }
  EXPECT_GT(better, 5);
}

TEST(KMeans, GivesTheSameForTheSameStream) {
  const Eigen::MatrixXd points = RandomPoints(150, 4, 5);
  const KMeansClusters a = Cluster(points, 15, 3, 8);
  const KMeansClusters b = Cluster(points, 15, 3, 8);
  const KMeansClusters c = Cluster(points, 15, 3, 9);
  EXPECT_EQ(a.cluster_of, b.cluster_of);
  EXPECT_EQ(a.centers, b.centers);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_NE(a.cluster_of, c.cluster_of);
}

TEST(KMeans, TurnsAndMovesWithThePoints) {
  const Eigen::MatrixXd points = RandomPoints(120, 4, 6);
  const Eigen::MatrixXd turn =
      Eigen::HouseholderQR<Eigen::MatrixXd>(RandomPoints(4, 4, 7)).householderQ();
  const Eigen::RowVectorXd shift = Eigen::RowVector4d(3, -2, 0.5, 1);
  const KMeansClusters here = Cluster(points, 9);
  const KMeansClusters there = Cluster((points * turn).rowwise() + shift, 9);
  EXPECT_EQ(here.cluster_of, there.cluster_of);
  EXPECT_TRUE(there.centers.isApprox((here.centers * turn).rowwise() + shift, 1e-12));
  EXPECT_NEAR(there.cost, here.cost, 1e-12 * here.cost);
}

TEST(KMeans, RefusesNumbersOutOfRange) {
  const Eigen::MatrixXd points = RandomPoints(10, 2, 1);
  EXPECT_THROW((void)Cluster(points, 0), std::invalid_argument);
  EXPECT_THROW((void)Cluster(points, 11), std::invalid_argument);
  EXPECT_THROW((void)Cluster(points, 2, 0), std::invalid_argument);
  EXPECT_NO_THROW((void)Cluster(points, 10));
}

}  // namespace k_means_test
}  // namespace regrasp::roadmap
