#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/base/index.h"
#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::roadmap {

/// Result of k-means clustering.
struct KMeansClusters {
  Eigen::MatrixXd centers;      ///< k × d, means of the clusters
  std::vector<int> cluster_of;  ///< cluster of each point
  double cost = 0;              ///< sum of squared distances of points to their centres
};

/// Cluster points by k-means.
/// Lloyd's iteration (1982) starts from k-means++ centres (Arthur and Vassilvitskii 2007).
/// The result is the cheapest of `restarts` runs. No cluster is empty: an empty one gets the point
/// farthest from its centre.
///
/// Laws: the same stream gives the same clusters. Rigid motion of all points moves the result.
/// @param points  n × d.
/// @param count  k, in 1 … n.
/// @param restarts  number of runs, at least 1.
/// @throws std::invalid_argument  if a number is out of range.
[[nodiscard]] KMeansClusters KMeans(const Eigen::MatrixXd& points, int count, int restarts,
                                    RandomStream& random, const Tell& tell = {});

/// Number of sides of the pyramid that approximates a friction cone for comparisons.
inline constexpr int kPyramidSides = 8;

/// Unit wrenches of a contact's friction pyramid in the wrench frame.
/// Torques are divided by the frame's radius.
/// One per column, counter-clockwise about the inward normal.
using WrenchPyramid = Eigen::Matrix<double, 6, kPyramidSides>;

/// Return the pyramid of a contact.
/// @param friction_angle  friction angle, radians; the edges of the pyramid are on the cone.
/// @param towards     direction of the first edge along the surface; must not be parallel to the
///     normal.
[[nodiscard]] WrenchPyramid PyramidOf(const grasp::Contact& contact,
                                      const object::WrenchFrame& frame, double friction_angle,
                                      const Eigen::Vector3d& towards);

/// Return the pyramid of a contact, with the first edge inclined away from the frame's origin. It
/// rotates with the object.
/// @param others  contacts that define the direction instead if the contact is straight above the
///     origin: the first one that is not above it, too.
[[nodiscard]] WrenchPyramid PyramidOf(const grasp::Contact& contact,
                                      const object::WrenchFrame& frame, double friction_angle,
                                      std::span<const grasp::Contact> others);

/// Return the distance of the effects of two contacts on the object (Phoka 2010, 6.2.2.1), radians.
/// It is the mean angle between corresponding wrenches of the two pyramids, minimized over cyclic
/// shifts.
///
/// Laws: symmetric; 0 for equal pyramids (to 1e-7, because the cosine is rounded). Independent of
/// the unit of length and of the object's pose. Angles are accurate to 7e-5.
[[nodiscard]] double WrenchDistance(const WrenchPyramid& a, const WrenchPyramid& b);

/// Return the N × N matrix of distances between pyramids.
[[nodiscard]] Eigen::MatrixXd WrenchDistances(std::span<const WrenchPyramid> pyramids,
                                              const Tell& tell = {});

/// Spectral embedding of a graph of affinities (Ng, Jordan and Weiss 2001).
/// It places similar points close together.
struct SpectralEmbedding {
  Eigen::MatrixXd rows;         ///< n × k, points as unit rows
  Eigen::MatrixXd vectors;      ///< n × k, eigenvectors of D^(−1/2) A D^(−1/2)
  Eigen::VectorXd eigenvalues;  ///< k largest eigenvalues, descending
  Eigen::VectorXd degrees;      ///< row sums of A
};

/// Compute the spectral embedding of an affinity matrix.
/// @param affinity  n × n, symmetric, entries in (0, 1].
/// @param dimension  k, in 1 … n − 1.
/// @throws std::invalid_argument  if k is out of range.
[[nodiscard]] SpectralEmbedding EmbedAffinity(const Eigen::MatrixXd& affinity, int dimension);

/// Embed an additional point by Nyström's extension (Bengio et al. 2004).
///
/// Law: the affinities of one of the embedding's own points give its row.
/// @param affinity  n affinities to the embedding's points.
[[nodiscard]] Eigen::RowVectorXd EmbedAnother(const SpectralEmbedding& embedding,
                                              const Eigen::VectorXd& affinity);

using ClusterIndex = Index<struct ClusterTag>;

/// Clusters of contact points with similar effects on the object (Phoka 2010, 6.2.2).
/// The affinities are exp(−d / 2σ²) with d from WrenchDistance and σ the mean of all N² distances.
/// The rows of their spectral embedding are clustered by k-means. The representative of a cluster
/// is the contact nearest to its centre.
///
/// Distances are those of the embedding: E between a contact and a centre, F between two contacts.
/// Contacts that are added later are placed in the same embedding and do not change it.
///
/// Laws: equal arguments give equal clusters. The clusters do not depend on the unit of length or
/// on the object's pose.
class ContactClusters {
 public:
  /// @param contacts  contact points, more than `clusters`.
  /// @param friction_angle  friction angle, radians.
  /// @param clusters  number of clusters k, at least 1.
  /// @throws std::invalid_argument  if a number is out of range.
  /// @throws TimeUp  if the deadline passes. It is checked only between stages of one or two
  ///     seconds.
  ContactClusters(std::vector<grasp::Contact> contacts, const object::WrenchFrame& frame,
                  double friction_angle, int clusters, std::uint64_t seed,
                  const Deadline& deadline = {}, const Tell& tell = {});

  /// Return the clustered contacts, followed by the added ones.
  [[nodiscard]] const std::vector<grasp::Contact>& contacts() const { return contacts_; }
  /// Return the number of clustered contacts.
  [[nodiscard]] int clustered_count() const { return static_cast<int>(embedding_.degrees.size()); }
  [[nodiscard]] int cluster_count() const { return static_cast<int>(representatives_.size()); }

  /// Return the cluster of a contact; for an added one, that with the nearest centre.
  [[nodiscard]] ClusterIndex cluster_of(int contact) const { return cluster_of_[contact]; }
  /// Return the clustered contacts of a cluster in ascending order.
  [[nodiscard]] std::span<const int> members(ClusterIndex cluster) const {
    return members_[cluster];
  }
  [[nodiscard]] int representative(ClusterIndex cluster) const { return representatives_[cluster]; }
  [[nodiscard]] const std::vector<int>& representatives() const { return representatives_; }

  /// Return the distance E.
  [[nodiscard]] double DistanceToCenter(int contact, ClusterIndex cluster) const {
    return (places_.col(contact) - centers_.col(cluster)).norm();
  }
  /// Return the distance F.
  [[nodiscard]] double Distance(int a, int b) const {
    return (places_.col(a) - places_.col(b)).norm();
  }

  /// Add a contact.
  /// @returns its number.
  int Add(const grasp::Contact& contact);

 private:
  object::WrenchFrame frame_;
  double friction_angle_;
  std::vector<grasp::Contact> contacts_;
  std::vector<WrenchPyramid> pyramids_;  ///< pyramids of the clustered contacts
  double affinity_scale_ = 0;            ///< 2σ²
  SpectralEmbedding embedding_;
  Eigen::MatrixXd places_;   ///< k × all contacts: rows of the embedding as columns
  Eigen::MatrixXd centers_;  ///< k × clusters
  std::vector<ClusterIndex> cluster_of_;
  std::vector<std::vector<int>> members_;
  std::vector<int> representatives_;
};

}  // namespace regrasp::roadmap
