#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "render/frames/canvas.h"
#include "render/frames/facet_mesh.h"

namespace regrasp::render {

/// Points whose pictures bound the pictures of shapes.
class Extent {
 public:
  /// @param axes    of the camera.
  /// @param meshes  what MeshInstance names; outlives this object.
  Extent(const Eigen::Matrix3d& axes, const std::vector<FacetMesh>& meshes)
      : axes_(axes), meshes_(meshes) {}

  void operator()(const Ball& ball) {
    for (const double sign : {-1.0, 1.0}) {
      for (const int axis : {0, 1})
        points_.push_back(ball.centre + sign * ball.radius * axes_.col(axis));
    }
  }
  void operator()(const Rod& rod) { AddEnds(rod); }
  void operator()(const Line& line) { AddEnds(line); }
  void operator()(const MeshInstance& instance) {
    for (const auto& corners : meshes_[instance.mesh].triangles) {
      for (const Eigen::Vector3d& p : corners) points_.push_back(instance.pose * p);
    }
  }
  template <class Form>
  void AddEnds(const Form& form) {
    for (const Eigen::Vector3d& end : {form.from, form.to}) (*this)(Ball{end, form.radius});
  }
  void Add(const std::variant<Ball, Rod, Line, MeshInstance>& form) { std::visit(*this, form); }

  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  const Eigen::Matrix3d& axes_;
  const std::vector<FacetMesh>& meshes_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace regrasp::render
