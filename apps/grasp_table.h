#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace regrasp::apps {

/// Grasps with equal numbers of contacts, in the layout of grasp::GraspArrays.
struct GraspGroup {
  int contacts = 0;
  std::vector<std::size_t> places;  ///< index of each grasp in the file
  std::vector<int> fingers;         ///< index of each contact in its grasp in the file
  std::vector<double> points;       ///< contact points, with z = 0 for planar objects
  std::vector<double> normals;      ///< contact normals; empty if the file has none
};

/// Grasps of a file.
struct GraspTable {
  std::size_t count = 0;
  int contacts = 0;  ///< number of contacts per grasp, active or not
  std::vector<GraspGroup>
      groups;  ///< groups by number of active contacts, without grasps that have none
};

/// Read the arrays points, normals and active of an NPZ file.
/// The format is in docs/format_grasp.md. In files of version 1 the array active is called holds.
/// @param dimension  dimension of the object: 2 or 3.
/// @throws InputError  if an array is invalid; the message names the file, the array, the element
///     and the problem.
[[nodiscard]] GraspTable ReadGrasps(const std::string& file, int dimension);

}  // namespace regrasp::apps
