#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polyhedron.h"

namespace regrasp::bench {

/// A body that hands turn, as a file of its own: a model of models/, or a tube that is made here.
struct HandBody {
  std::string name;
  std::string what;   ///< for people, with its size: "cube, edge 50 mm"
  std::string bytes;  ///< of its file, an OBJ
  object::ObjectFile file;
  double scale = 1;  ///< metres per unit of the file

  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*file.object);
  }
  /// Of the solid, in the file's frame, metres.
  [[nodiscard]] Eigen::Vector3d centre() const {
    return scale * file.object->mass_properties().centroid;
  }
};

/// A body of an OBJ's bytes.
/// @param name  also of the file, with ".obj".
/// @throws InputError  the bytes are no solid.
[[nodiscard]] HandBody BodyOf(const std::string& name, const std::string& what, std::string bytes,
                              double scale);

/// Ten bodies of several sizes and kinds: cubes, a cylinder, a prism, an L-block, a duck, a mug, an
/// ellipsoid and a bent tube.
/// @param models  the folder of that name.
[[nodiscard]] std::vector<HandBody> TenBodies(const std::filesystem::path& models);

/// The objects of the RGMC's in-hand manipulation track of 2025: cubes of 50 and 90 mm, and
/// cylinders of 60, 80 and 100 mm that are 80 mm tall.
[[nodiscard]] std::vector<HandBody> CompetitionBodies(const std::filesystem::path& models);

}  // namespace regrasp::bench
