#include "planner/roadmap/k_means.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace regrasp::roadmap {

namespace {

/// Lloyd's iteration hardly ever takes more than thirty; what is left after so many is small.
constexpr int kMaxIterations = 100;

/// n × k squared distances from points to centres.
Eigen::MatrixXd SquaredDistances(const Eigen::MatrixXd& points, const Eigen::MatrixXd& centers) {
  Eigen::MatrixXd distances = -2 * points * centers.transpose();
  distances.colwise() += points.rowwise().squaredNorm();
  distances.rowwise() += centers.rowwise().squaredNorm().transpose();
  return distances.cwiseMax(0);
}

/// An index with the probability of its weight; any where all weights are 0.
Eigen::Index DrawByWeight(const Eigen::VectorXd& weights, RandomStream& random) {
  const double sum = weights.sum();
  if (!(sum > 0)) return static_cast<Eigen::Index>(random.Index(weights.size()));
  double left = random.Uniform() * sum;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    left -= weights[i];
    if (left < 0) return i;
  }
  return weights.size() - 1;
}

Eigen::MatrixXd DrawCenters(const Eigen::MatrixXd& points, int count, RandomStream& random) {
  Eigen::MatrixXd centers(count, points.cols());
  Eigen::VectorXd nearest =
      Eigen::VectorXd::Constant(points.rows(), std::numeric_limits<double>::infinity());
  for (int j = 0; j < count; ++j) {
    const Eigen::Index drawn = j == 0 ? static_cast<Eigen::Index>(random.Index(points.rows()))
                                      : DrawByWeight(nearest, random);
    centers.row(j) = points.row(drawn);
    const Eigen::VectorXd distance = (points.rowwise() - centers.row(j)).rowwise().squaredNorm();
    nearest = nearest.cwiseMin(distance);
  }
  return centers;
}

/// Points and the sum of distances to the nearest centres.
KMeansClusters AssignTo(const Eigen::MatrixXd& centers, const Eigen::MatrixXd& points) {
  KMeansClusters clusters{centers, std::vector<int>(points.rows()), 0};
  const Eigen::MatrixXd distances = SquaredDistances(points, centers);
  Eigen::VectorXd own(points.rows());
  std::vector<int> sizes(centers.rows(), 0);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::Index nearest = 0;
    own[i] = distances.row(i).minCoeff(&nearest);
    clusters.cluster_of[i] = static_cast<int>(nearest);
    ++sizes[nearest];
  }
  for (int j = 0; j < centers.rows(); ++j) {
    if (sizes[j] > 0) continue;
    // Among points that are not alone; there is one, as there are no more centres than points.
    Eigen::Index farthest = -1;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      if (sizes[clusters.cluster_of[i]] < 2) continue;
      if (farthest < 0 || own[i] > own[farthest]) farthest = i;
    }
    --sizes[clusters.cluster_of[farthest]];
    clusters.cluster_of[farthest] = j;
    own[farthest] = 0;
    sizes[j] = 1;
  }
  clusters.cost = own.sum();
  return clusters;
}

void MoveCentersToMeans(const Eigen::MatrixXd& points, KMeansClusters& clusters) {
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(clusters.centers.rows());
  clusters.centers.setZero();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    clusters.centers.row(clusters.cluster_of[i]) += points.row(i);
    sizes[clusters.cluster_of[i]] += 1;
  }
  clusters.centers.array().colwise() /= sizes.array();
}

KMeansClusters RunOnce(const Eigen::MatrixXd& points, int count, RandomStream& random) {
  KMeansClusters clusters = AssignTo(DrawCenters(points, count, random), points);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    MoveCentersToMeans(points, clusters);
    KMeansClusters next = AssignTo(clusters.centers, points);
    const bool settled = next.cluster_of == clusters.cluster_of;
    clusters = std::move(next);
    if (settled) break;
  }
  MoveCentersToMeans(points, clusters);
  return clusters;
}

}  // namespace

KMeansClusters KMeans(const Eigen::MatrixXd& points, int count, int restarts, RandomStream& random,
                      const Tell& tell) {
  if (count < 1 || count > points.rows() || restarts < 1) {
    throw std::invalid_argument("k-means needs 1 to n clusters and a run");
  }
  CountedProgress progress(tell, "sorting contact points into clusters, runs", restarts);
  KMeansClusters best = RunOnce(points, count, random);
  progress.Add();
  for (int run = 1; run < restarts; ++run) {
    KMeansClusters clusters = RunOnce(points, count, random);
    progress.Add();
    if (clusters.cost < best.cost) best = std::move(clusters);
  }
  return best;
}

}  // namespace regrasp::roadmap
