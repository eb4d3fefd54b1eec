#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/hand_bodies.h"
#include "bench/inhand/task.h"

namespace regrasp::bench {

/// Tasks of the benchmark BIH and the bodies that they are for.
struct BihTasks {
  std::vector<Task> tasks;
  std::vector<HandBody> bodies;
  std::vector<std::string> without_mesh;  ///< objects whose tasks are left out
};

/// Reads the displacements of BIH (Cruciani, Sundaralingam et al. 2020) from the user's copy: the
/// sheet of palm poses saved as CSV, with the columns "Object", "Initial palm pose" and "Desired
/// palm pose", each pose x, y, z in metres and roll, pitch, yaw in radians, of the palm in the
/// object's frame. That the palm goes from one to the other is that the object goes the opposite
/// way in the hand: with X and Y the two poses, X Y⁻¹ in the object's frame.
///
/// @param meshes  a folder with a solid for each object in metres, as in "tuna_fish_can.obj" or
///                "007_tuna_fish_can.stl".
/// @throws InputError  names the line of the sheet, or the mesh, and what is wrong.
[[nodiscard]] BihTasks ReadBih(const std::filesystem::path& sheet,
                               const std::filesystem::path& meshes);

}  // namespace regrasp::bench
