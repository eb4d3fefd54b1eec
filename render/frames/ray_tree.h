#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "render/frames/facet_mesh.h"

namespace regrasp::render {

/// Where rays meet the triangles of a mesh: a tree of boxes, so that a ray looks at a few of them
/// only. It keeps its own copy; an empty one is met nowhere.
///
/// Rays are given by their origin and a unit direction. What is not beyond `skip` along them does
/// not count: the surface that a ray starts on. A ray through an edge meets both its triangles.
class RayTree {
 public:
  RayTree() = default;
  explicit RayTree(const FacetMesh& mesh);

  /// To the first triangle; infinite where there is none.
  [[nodiscard]] double Distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double skip) const;
  /// How many triangles a ray meets, `most` where they are more.
  [[nodiscard]] int CountHits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double skip, int most) const;

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  /// Its left child is the next node; a leaf has no right one.
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0, end = 0;  ///< triangles
    int right = -1;
  };

  void Split(int begin, int end);
  template <class Ray, class Take>
  void Visit(const Ray& ray, const Take& take) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

/// A surface somewhere.
struct PlacedRays {
  const RayTree* rays;
  Eigen::Isometry3d to_rays;  ///< into its own frame
};

/// Whether a ray meets one of them.
[[nodiscard]] bool IsMet(const std::vector<PlacedRays>& surfaces, const Eigen::Vector3d& origin,
                         const Eigen::Vector3d& direction, double skip);

}  // namespace regrasp::render
