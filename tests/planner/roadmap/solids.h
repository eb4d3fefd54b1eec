#pragma once

#include <map>
#include <tuple>

#include "planner/object/polyhedron.h"

namespace regrasp {

/// A box about the origin, each of its six faces cut into `cells` × `cells` quadrilaterals.
inline Polyhedron MakeBox(const Eigen::Vector3d& size, int cells = 1) {
  PolygonSoup soup;
  std::map<std::tuple<int, int, int>, int> index_of;
  const auto vertex = [&](const Eigen::Vector3i& at) {
    const auto [place, is_new] =
        index_of.try_emplace({at.x(), at.y(), at.z()}, static_cast<int>(soup.vertices.size()));
    if (is_new) {
      soup.vertices.push_back(
          (at.cast<double>() / cells - Eigen::Vector3d::Constant(0.5)).cwiseProduct(size));
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3i u = Eigen::Vector3i::Unit((axis + 1) % 3);
    const Eigen::Vector3i v = Eigen::Vector3i::Unit((axis + 2) % 3);
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        const Eigen::Vector3i low = i * u + j * v;
        const Eigen::Vector3i high = low + cells * Eigen::Vector3i::Unit(axis);
        soup.facets.push_back({vertex(low), vertex(low + v), vertex(low + u + v), vertex(low + u)});
        soup.facets.push_back(
            {vertex(high), vertex(high + u), vertex(high + u + v), vertex(high + v)});
      }
    }
  }
  return Polyhedron::FromSoup(soup, "box");
}

/// A cube of 6 cm.
inline Polyhedron MakeCube() { return MakeBox({0.06, 0.06, 0.06}); }

}  // namespace regrasp
