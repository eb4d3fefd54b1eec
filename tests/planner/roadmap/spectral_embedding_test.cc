#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/base/random.h"
#include "planner/roadmap/contact_clusters.h"

namespace regrasp::roadmap {
namespace spectral_embedding_test {

/// Return exp(−|x − y|) for points in a cube: symmetric, in (0, 1].
Eigen::MatrixXd RandomAffinity(int count, std::uint64_t seed) {
  RandomStream random(seed, RandomUse::kContactPoints);
  const Eigen::MatrixXd points =
      Eigen::MatrixXd::NullaryExpr(count, 3, [&] { return random.Uniform(); });
  Eigen::MatrixXd affinity(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j)
      affinity(i, j) = std::exp(-(points.row(i) - points.row(j)).norm());
  }
  return affinity;
}

Eigen::MatrixXd Normalized(const Eigen::MatrixXd& affinity) {
  const Eigen::VectorXd scale = affinity.rowwise().sum().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * affinity * scale.asDiagonal();
}

/// For few points all eigenvalues are computed at once, for many points iteratively.
class EmbedAffinityOfSize : public testing::TestWithParam<int> {};

TEST_P(EmbedAffinityOfSize, HasTheLargestEigenpairsOfASolverForAll) {
  const int count = GetParam();
  constexpr int kDimension = 8;
  const Eigen::MatrixXd affinity = RandomAffinity(count, 1);
  const SpectralEmbedding embedding = EmbedAffinity(affinity, kDimension);
  const Eigen::MatrixXd matrix = Normalized(affinity);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(matrix);
  ASSERT_EQ(embedding.eigenvalues.size(), kDimension);
  EXPECT_NEAR(embedding.eigenvalues[0], 1, 1e-10);
  for (int i = 0; i < kDimension; ++i) {
    EXPECT_NEAR(embedding.eigenvalues[i], all.eigenvalues()[count - 1 - i], 1e-10);
    const double overlap = embedding.vectors.col(i).dot(all.eigenvectors().col(count - 1 - i));
    EXPECT_NEAR(std::abs(overlap), 1, 1e-8) << i;
  }
  EXPECT_TRUE((matrix * embedding.vectors)
                  .isApprox(embedding.vectors * embedding.eigenvalues.asDiagonal(), 1e-9));
  for (int i = 0; i < count; ++i) {
    EXPECT_NEAR(embedding.rows.row(i).norm(), 1, 1e-12);
    EXPECT_TRUE(embedding.rows.row(i).isApprox(embedding.vectors.row(i).normalized(), 1e-12));
  }
  EXPECT_TRUE(embedding.degrees.isApprox(affinity.rowwise().sum()));
}

TEST_P(EmbedAffinityOfSize, PlacesItsOwnPointsWhereTheyAre) {
  const int count = GetParam();
  const Eigen::MatrixXd affinity = RandomAffinity(count, 2);
  const SpectralEmbedding embedding = EmbedAffinity(affinity, 6);
  for (int i = 0; i < count; ++i) {
    const Eigen::RowVectorXd row = EmbedAnother(embedding, affinity.col(i));
    EXPECT_NEAR((row - embedding.rows.row(i)).norm(), 0, 1e-8);
    EXPECT_GT((row - embedding.rows.row((i + 1) % count)).norm(), 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, EmbedAffinityOfSize, testing::Values(12, 150));

TEST(EmbedAffinity, PutsBlocksApart) {
  // Points of three distant groups: the points of a group are embedded close together, and
  // different groups are embedded at right angles.
  constexpr int kCount = 90;
  const auto block = [](int i) { return i < 20 ? 0 : i < 50 ? 1 : 2; };
  Eigen::MatrixXd affinity = RandomAffinity(kCount, 4);
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      if (block(i) != block(j)) affinity(i, j) *= 1e-5;
    }
  }
  const SpectralEmbedding embedding = EmbedAffinity(affinity, 3);
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      const double overlap = embedding.rows.row(i).dot(embedding.rows.row(j));
      EXPECT_NEAR(overlap, block(i) == block(j) ? 1 : 0, 1e-3);
    }
  }
}

TEST(EmbedAffinity, FindsEigenvaluesAsOftenAsTheyAre) {
  // Points evenly spaced on a circle: all eigenvalues but the first come in pairs, as for objects
  // with a symmetry.
  constexpr int kCount = 150;
  constexpr int kDimension = 9;
  Eigen::MatrixXd affinity(kCount, kCount);
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      const double turn = 2 * std::numbers::pi * (i - j) / kCount;
      affinity(i, j) = std::exp(-2 * std::abs(std::sin(turn / 2)));
    }
  }
  const SpectralEmbedding embedding = EmbedAffinity(affinity, kDimension);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(Normalized(affinity));
  for (int i = 0; i < kDimension; ++i) {
    EXPECT_NEAR(embedding.eigenvalues[i], all.eigenvalues()[kCount - 1 - i], 1e-10) << i;
  }
  EXPECT_TRUE((embedding.vectors.transpose() * embedding.vectors).isIdentity(1e-8));
}

TEST(EmbedAffinity, RefusesDimensionsOutOfRange) {
  const Eigen::MatrixXd affinity = RandomAffinity(10, 3);
  EXPECT_THROW((void)EmbedAffinity(affinity, 0), std::invalid_argument);
  EXPECT_THROW((void)EmbedAffinity(affinity, 10), std::invalid_argument);
  EXPECT_EQ(EmbedAffinity(affinity, 9).rows.cols(), 9);
}

}  // namespace spectral_embedding_test
}  // namespace regrasp::roadmap
