#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/counted_progress.h"
#include "planner/base/random.h"

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

}  // namespace regrasp::roadmap
