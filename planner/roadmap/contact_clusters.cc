#include "planner/roadmap/contact_clusters.h"

#include <cmath>
#include <stdexcept>

#include "planner/roadmap/k_means.h"

namespace regrasp::roadmap {

namespace {

/// Runs of k-means; the best of them is taken.
constexpr int kRestarts = 5;

}  // namespace

ContactClusters::ContactClusters(std::vector<grasp::Contact> contacts,
                                 const object::WrenchFrame& frame, double half_angle, int clusters,
                                 std::uint64_t seed, const Deadline& deadline, const Tell& tell)
    : frame_(frame), half_angle_(half_angle), contacts_(std::move(contacts)) {
  if (clusters < 1 || clusters >= static_cast<int>(contacts_.size())) {
    throw std::invalid_argument("clusters must be at least 1 and fewer than the contacts");
  }
  for (const grasp::Contact& contact : contacts_) {
    pyramids_.push_back(PyramidOf(contact, frame_, half_angle_, contacts_));
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
  const WrenchPyramid pyramid = PyramidOf(contact, frame_, half_angle_, clustered);
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
