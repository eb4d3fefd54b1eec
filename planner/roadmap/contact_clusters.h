#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/counted_progress.h"
#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"
#include "planner/roadmap/spectral_embedding.h"
#include "planner/roadmap/wrench_affinity.h"

namespace regrasp::roadmap {

using ClusterIndex = Index<struct ClusterTag>;

/// Contact points in clusters of those that act on the object alike (Phoka 2010, 6.2.2): affinities
/// exp(−d / 2σ²) from WrenchDistance, σ the mean of all N² distances; the rows of their spectral
/// embedding by k-means; for each cluster the contact nearest its centre as its representative.
///
/// Distances are those of the embedding: E between a contact and a centre, F between two contacts.
/// Contacts that come later are placed in the same embedding and change nothing of the rest.
///
/// Laws: the same arguments give the same clusters; they do not depend on the unit of length nor on
/// the object's pose.
class ContactClusters {
 public:
  /// @param contacts  more than `clusters`. @param clusters  k >= 1.
  /// @param half_angle  radians.
  /// @throws std::invalid_argument  a number is out of range.
  /// @throws TimeUp  the deadline came; looks between its stages only, of a second or two each.
  ContactClusters(std::vector<grasp::Contact> contacts, const object::WrenchFrame& frame,
                  double half_angle, int clusters, std::uint64_t seed,
                  const Deadline& deadline = {}, const Tell& tell = {});

  /// The clustered contacts, then those that were added.
  [[nodiscard]] const std::vector<grasp::Contact>& contacts() const { return contacts_; }
  /// How many of them were clustered.
  [[nodiscard]] int clustered_count() const { return static_cast<int>(embedding_.degrees.size()); }
  [[nodiscard]] int cluster_count() const { return static_cast<int>(representatives_.size()); }

  /// The cluster of a contact; of an added one, that with the nearest centre.
  [[nodiscard]] ClusterIndex cluster_of(int contact) const { return cluster_of_[contact]; }
  /// The clustered contacts of a cluster, ascending.
  [[nodiscard]] std::span<const int> members(ClusterIndex cluster) const {
    return members_[cluster];
  }
  [[nodiscard]] int representative(ClusterIndex cluster) const { return representatives_[cluster]; }
  [[nodiscard]] const std::vector<int>& representatives() const { return representatives_; }

  /// E.
  [[nodiscard]] double DistanceToCenter(int contact, ClusterIndex cluster) const {
    return (places_.col(contact) - centers_.col(cluster)).norm();
  }
  /// F.
  [[nodiscard]] double Distance(int a, int b) const {
    return (places_.col(a) - places_.col(b)).norm();
  }

  /// Adds a contact. @returns its number.
  int Add(const grasp::Contact& contact);

 private:
  object::WrenchFrame frame_;
  double half_angle_;
  std::vector<grasp::Contact> contacts_;
  std::vector<WrenchPyramid> pyramids_;  ///< of the clustered contacts
  double affinity_scale_ = 0;            ///< 2σ²
  SpectralEmbedding embedding_;
  Eigen::MatrixXd places_;   ///< k × all contacts: rows of the embedding, turned to columns
  Eigen::MatrixXd centers_;  ///< k × clusters
  std::vector<ClusterIndex> cluster_of_;
  std::vector<std::vector<int>> members_;
  std::vector<int> representatives_;
};

}  // namespace regrasp::roadmap
