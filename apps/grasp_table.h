#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace regrasp::apps {

/// Grasps of equally many contacts, in the layout of grasp::GraspArrays.
struct GraspGroup {
  int contacts = 0;
  std::vector<std::size_t> places;  ///< of its grasps among all of the file
  std::vector<int> fingers;         ///< of each contact its index in the grasp of the file
  std::vector<double> points;       ///< in the plane with z = 0
  std::vector<double> normals;      ///< empty where the file has none
};

/// The grasps of a file.
struct GraspTable {
  std::size_t count = 0;
  int contacts = 0;  ///< per grasp, active or not
  std::vector<GraspGroup>
      groups;  ///< by number of active contacts; grasps without any are in no group
};

/// Read the arrays points, normals and active (docs/format_grasp.md) of an NPZ file. In files of
/// version 1 the array active is called holds.
/// @param dimension  of the object: 2 or 3.
/// @throws InputError  names the file, the array, the place in it and what is wrong.
[[nodiscard]] GraspTable ReadGrasps(const std::string& file, int dimension);

}  // namespace regrasp::apps
