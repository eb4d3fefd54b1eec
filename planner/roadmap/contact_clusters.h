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

/// Points in clusters, each nearest the centre of its own.
struct KMeansClusters {
  Eigen::MatrixXd centers;      ///< k × d, the means of the clusters
  std::vector<int> cluster_of;  ///< by point
  double cost = 0;              ///< Σ squared distance of a point to its centre
};

/// Clusters points by Lloyd's iteration (1982) from centres drawn as in k-means++ (Arthur and
/// Vassilvitskii 2007), the cheapest of `restarts` runs. No cluster is empty: one that would be
/// takes the point farthest from its centre.
///
/// Laws: the same stream gives the same clusters; moving or turning all points turns the answer.
/// @param points  n × d. @param count  k, 1 … n. @param restarts  >= 1.
/// @throws std::invalid_argument  a number is out of range.
[[nodiscard]] KMeansClusters KMeans(const Eigen::MatrixXd& points, int count, int restarts,
                                    RandomStream& random, const Tell& tell = {});

/// Sides of the pyramid that stands for a friction cone where wrenches are compared.
inline constexpr int kPyramidSides = 8;

/// The unit wrenches of a contact's friction pyramid in the frame, torques over its radius: one a
/// column, counter-clockwise about the inward normal.
using WrenchPyramid = Eigen::Matrix<double, 6, kPyramidSides>;

/// @param half_angle  radians; edges of the pyramid lie on the cone.
/// @param towards     the first edge leans to where this vector points along the surface; must not
///                    be parallel to the normal.
[[nodiscard]] WrenchPyramid PyramidOf(const grasp::Contact& contact,
                                      const object::WrenchFrame& frame, double half_angle,
                                      const Eigen::Vector3d& towards);

/// The pyramid of a contact, its first edge leaning away from the frame's origin, so that it turns
/// with the object.
/// @param others  where the contact is straight above the origin, the first of these that is not
///                decides.
[[nodiscard]] WrenchPyramid PyramidOf(const grasp::Contact& contact,
                                      const object::WrenchFrame& frame, double half_angle,
                                      std::span<const grasp::Contact> others);

/// How differently two contacts act on the object (Phoka 2010, 6.2.2.1): the mean angle between
/// wrenches of the two pyramids matched in order, for the cyclic shift that makes it least;
/// radians.
///
/// Laws: symmetric; 0 for equal pyramids (to 1e-7, the root of a rounding of the cosine);
/// independent of the unit of length and of the object's pose. Angles are right to 7e-5.
[[nodiscard]] double WrenchDistance(const WrenchPyramid& a, const WrenchPyramid& b);

/// All distances between pyramids, N × N.
[[nodiscard]] Eigen::MatrixXd WrenchDistances(std::span<const WrenchPyramid> pyramids,
                                              const Tell& tell = {});

/// Points of a graph of affinities placed so that those that belong together lie close (Ng, Jordan
/// and Weiss 2001).
struct SpectralEmbedding {
  Eigen::MatrixXd rows;         ///< n × k, unit rows: the points
  Eigen::MatrixXd vectors;      ///< n × k, eigenvectors of D^(−1/2) A D^(−1/2)
  Eigen::VectorXd eigenvalues;  ///< the k largest, descending
  Eigen::VectorXd degrees;      ///< row sums of A
};

/// @param affinity  n × n, symmetric, entries in (0, 1]. @param dimension  k, 1 … n − 1.
/// @throws std::invalid_argument  k is out of range.
[[nodiscard]] SpectralEmbedding EmbedAffinity(const Eigen::MatrixXd& affinity, int dimension);

/// Where a point that the embedding does not know belongs (Nyström's extension, Bengio et al.
/// 2004).
///
/// Law: the affinities of one of the embedding's own points give its row.
/// @param affinity  n, to the embedding's points.
[[nodiscard]] Eigen::RowVectorXd EmbedAnother(const SpectralEmbedding& embedding,
                                              const Eigen::VectorXd& affinity);

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
