#pragma once

#include <Eigen/Core>

namespace regrasp::roadmap {

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

}  // namespace regrasp::roadmap
