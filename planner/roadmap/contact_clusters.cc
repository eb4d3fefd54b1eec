#include "planner/roadmap/contact_clusters.h"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace regrasp::roadmap {

namespace {

/// Largest number of Lloyd iterations. Rarely more than thirty are required, and later changes are
/// small.
constexpr int kMaxIterations = 100;

/// Return the n × k squared distances from points to centres.
Eigen::MatrixXd SquaredDistances(const Eigen::MatrixXd& points, const Eigen::MatrixXd& centers) {
  Eigen::MatrixXd distances = -2 * points * centers.transpose();
  distances.colwise() += points.rowwise().squaredNorm();
  distances.rowwise() += centers.rowwise().squaredNorm().transpose();
  return distances.cwiseMax(0);
}

/// Draw an index with probability proportional to its weight; uniformly if all weights are 0.
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

/// Assign points to the nearest centres and sum their squared distances.
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
    // Candidates are points in clusters of several points. There is one because there are at least
    // as many points as centres.
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
    throw std::invalid_argument("k-means requires 1 to n clusters and at least one run");
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

namespace {

/// Smallest length of a direction's component along the surface, relative to the radius.
constexpr double kParallel = 1e-6;

/// Return arccos x to 7e-5 for −1 ≤ x ≤ 1 (Abramowitz and Stegun 1964, 4.4.45).
/// It has no branches, so that the compiler vectorizes it. The accuracy suffices for affinities, of
/// which a thousand contacts require 32 million.
inline double FastArcCosine(double x) {
  const double a = std::min(std::abs(x), 1.0);
  const double positive =
      std::sqrt(1 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
  return x < 0 ? std::numbers::pi - positive : positive;
}

/// Return whether a vector has a component along the surface at a contact.
bool LeadsAlong(const Eigen::Vector3d& vector, const grasp::Contact& contact, double radius) {
  return contact.n.cross(vector).norm() > kParallel * radius;
}

}  // namespace

WrenchPyramid PyramidOf(const grasp::Contact& contact, const object::WrenchFrame& frame,
                        double friction_angle, const Eigen::Vector3d& towards) {
  const Eigen::Vector3d u = (towards - contact.n.dot(towards) * contact.n).normalized();
  const Eigen::Vector3d v = contact.n.cross(u);
  const Eigen::Vector3d arm = (contact.p - frame.origin) / frame.radius;
  WrenchPyramid pyramid;
  for (int side = 0; side < kPyramidSides; ++side) {
    const double turn = 2 * std::numbers::pi * side / kPyramidSides;
    const Eigen::Vector3d force =
        std::cos(friction_angle) * contact.n +
        std::sin(friction_angle) * (std::cos(turn) * u + std::sin(turn) * v);
    pyramid.col(side) << force, arm.cross(force);
    pyramid.col(side).normalize();
  }
  return pyramid;
}

WrenchPyramid PyramidOf(const grasp::Contact& contact, const object::WrenchFrame& frame,
                        double friction_angle, std::span<const grasp::Contact> others) {
  Eigen::Vector3d towards = contact.p - frame.origin;
  for (std::size_t i = 0; i < others.size() && !LeadsAlong(towards, contact, frame.radius); ++i) {
    towards = others[i].p - contact.p;
  }
  if (!LeadsAlong(towards, contact, frame.radius)) towards = contact.n.unitOrthogonal();
  return PyramidOf(contact, frame, friction_angle, towards);
}

double WrenchDistance(const WrenchPyramid& a, const WrenchPyramid& b) {
  constexpr int m = kPyramidSides;
  Eigen::Matrix<double, m, m> angle = a.transpose() * b;
  for (int i = 0; i < m * m; ++i) angle.data()[i] = FastArcCosine(angle.data()[i]);
  double least = std::numeric_limits<double>::infinity();
  for (int shift = 0; shift < m; ++shift) {
    double sum = 0;
    for (int k = 0; k < m; ++k) sum += angle(k, (k + shift) % m);
    least = std::min(least, sum);
  }
  return least / m;
}

Eigen::MatrixXd WrenchDistances(std::span<const WrenchPyramid> pyramids, const Tell& tell) {
  const auto count = static_cast<Eigen::Index>(pyramids.size());
  Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(count, count);
  CountedProgress progress(tell, "comparing pairs of contact points", count * (count - 1) / 2);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      distances(i, j) = distances(j, i) = WrenchDistance(pyramids[i], pyramids[j]);
    }
    progress.Reach(j * (j + 1) / 2);
  }
  return distances;
}

namespace {

/// Number of Lanczos vectors per eigenvalue; Spectra's manual recommends at least two.
constexpr int kVectorsPerEigenvalue = 2;
constexpr int kFewestVectors = 20;
constexpr int kMaxRestarts = 1000;
/// Tolerance of eigenvalues, of which the largest is 1.
constexpr double kEigenvalueTolerance = 1e-12;
/// Eigenvalue below which directions are noise that the inverse would amplify.
constexpr double kSmallestInverted = 1e-9;

struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Compute all eigenpairs at once, for few points or if the iteration does not converge.
EigenPairs LargestOfAll(const Eigen::MatrixXd& matrix, int count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues().reverse().head(count),
          solver.eigenvectors().rowwise().reverse().leftCols(count)};
}

EigenPairs LargestEigenPairs(const Eigen::MatrixXd& matrix, int count) {
  const int lanczos = std::max(kFewestVectors, kVectorsPerEigenvalue * count + 1);
  if (lanczos >= matrix.rows()) return LargestOfAll(matrix, count);
  Spectra::DenseSymMatProd<double> product(matrix);
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(product, count, lanczos);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, kEigenvalueTolerance);
  if (solver.info() != Spectra::CompInfo::Successful) return LargestOfAll(matrix, count);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

SpectralEmbedding EmbedAffinity(const Eigen::MatrixXd& affinity, int dimension) {
  if (dimension < 1 || dimension >= affinity.rows()) {
    throw std::invalid_argument("a spectral embedding requires 1 to n - 1 dimensions");
  }
  SpectralEmbedding embedding;
  embedding.degrees = affinity.rowwise().sum();
  const Eigen::VectorXd scale = embedding.degrees.cwiseSqrt().cwiseInverse();
  EigenPairs pairs =
      LargestEigenPairs(scale.asDiagonal() * affinity * scale.asDiagonal(), dimension);
  embedding.eigenvalues = std::move(pairs.values);
  embedding.vectors = std::move(pairs.vectors);
  embedding.rows = embedding.vectors.rowwise().normalized();
  return embedding;
}

Eigen::RowVectorXd EmbedAnother(const SpectralEmbedding& embedding,
                                const Eigen::VectorXd& affinity) {
  const Eigen::VectorXd row =
      affinity.cwiseQuotient((affinity.sum() * embedding.degrees).cwiseSqrt());
  Eigen::RowVectorXd placed = row.transpose() * embedding.vectors;
  for (Eigen::Index i = 0; i < placed.size(); ++i) {
    const double eigenvalue = embedding.eigenvalues[i];
    placed[i] = std::abs(eigenvalue) < kSmallestInverted ? 0 : placed[i] / eigenvalue;
  }
  return placed.normalized();
}

namespace {

/// Number of k-means runs, of which the best is used.
constexpr int kRestarts = 5;

}  // namespace

ContactClusters::ContactClusters(std::vector<grasp::Contact> contacts,
                                 const object::WrenchFrame& frame, double friction_angle,
                                 int clusters, std::uint64_t seed, const Deadline& deadline,
                                 const Tell& tell)
    : frame_(frame), friction_angle_(friction_angle), contacts_(std::move(contacts)) {
  if (clusters < 1 || clusters >= static_cast<int>(contacts_.size())) {
    throw std::invalid_argument("clusters must be at least 1 and fewer than the contacts");
  }
  for (const grasp::Contact& contact : contacts_) {
    pyramids_.push_back(PyramidOf(contact, frame_, friction_angle_, contacts_));
  }
  const Eigen::MatrixXd distances = WrenchDistances(pyramids_, tell);
  deadline.Check();
  const double sigma = distances.mean();
  affinity_scale_ = 2 * sigma * sigma;
  if (tell) tell("embedding " + std::to_string(contacts_.size()) + " contact points");
  embedding_ = EmbedAffinity((-distances / affinity_scale_).array().exp(), clusters);
  deadline.Check();
  RandomStream random(seed, RandomUse::kClusters);
  const KMeansClusters found = KMeans(embedding_.rows, clusters, kRestarts, random, tell);
  places_ = embedding_.rows.transpose();
  centers_ = found.centers.transpose();
  for (const int cluster : found.cluster_of) cluster_of_.emplace_back(cluster);
  members_.resize(clusters);
  for (int i = 0; i < clustered_count(); ++i) members_[cluster_of_[i]].push_back(i);
  for (ClusterIndex cluster{0}; cluster < clusters; ++cluster) {
    int nearest = members(cluster).front();
    for (const int i : members(cluster)) {
      if (DistanceToCenter(i, cluster) < DistanceToCenter(nearest, cluster)) nearest = i;
    }
    representatives_.push_back(nearest);
  }
}

int ContactClusters::Add(const grasp::Contact& contact) {
  const auto clustered = std::span(contacts_).first(clustered_count());
  const WrenchPyramid pyramid = PyramidOf(contact, frame_, friction_angle_, clustered);
  Eigen::VectorXd affinity(clustered_count());
  for (int i = 0; i < clustered_count(); ++i) {
    affinity[i] = std::exp(-WrenchDistance(pyramid, pyramids_[i]) / affinity_scale_);
  }
  const int added = static_cast<int>(contacts_.size());
  contacts_.push_back(contact);
  places_.conservativeResize(Eigen::NoChange, added + 1);
  places_.col(added) = EmbedAnother(embedding_, affinity).transpose();
  ClusterIndex nearest{0};
  for (ClusterIndex j{1}; j < cluster_count(); ++j) {
    if (DistanceToCenter(added, j) < DistanceToCenter(added, nearest)) nearest = j;
  }
  cluster_of_.push_back(nearest);
  return added;
}

}  // namespace regrasp::roadmap
