#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polyhedron.h"

namespace regrasp::bench {

/// Object that hands rotate, as a file of its own: a model of models/, or a generated tube.
struct HandBody {
  std::string name;
  std::string what;   ///< description with its size: "cube, edge 50 mm"
  std::string bytes;  ///< content of its OBJ file
  object::ObjectFile file;
  double scale = 1;  ///< metres per unit of the file

  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*file.object);
  }
  /// Return the centroid of the solid in the file's frame, m.
  [[nodiscard]] Eigen::Vector3d centre() const {
    return scale * file.object->mass_properties().centroid;
  }
};

/// Create an object from the bytes of an OBJ file.
/// @param name  name of the object; its file has this name with ".obj".
/// @throws InputError  if the bytes are not a closed solid.
[[nodiscard]] HandBody BodyOf(const std::string& name, const std::string& what, std::string bytes,
                              double scale);

/// Return ten objects of several sizes and kinds.
/// These are cubes, a cylinder, a prism, an L-block, a duck, a mug, an ellipsoid and a bent tube.
/// @param models  path of the folder models.
[[nodiscard]] std::vector<HandBody> TenBodies(const std::filesystem::path& models);

/// Return the objects of the RGMC's in-hand manipulation track of 2025.
/// These are cubes of 50 and 90 mm, and cylinders with diameters of 60, 80 and 100 mm and a height
/// of 80 mm.
[[nodiscard]] std::vector<HandBody> CompetitionBodies(const std::filesystem::path& models);

/// Return generated objects that are long, thin or flat.
/// These are a box, a square rod, a rod with 20 sides, a cap, a pen and a screwdriver, the long
/// ones along z. The screwdriver has the dimensions of object 044 of the YCB set and is not its
/// scan.
[[nodiscard]] std::vector<HandBody> EverydayBodies();

}  // namespace regrasp::bench
