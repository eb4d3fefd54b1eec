#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/hand_bodies.h"
#include "bench/inhand/task.h"

namespace regrasp::bench {

/// Tasks of the benchmark BIH and their objects.
struct BihTasks {
  std::vector<Task> tasks;
  std::vector<HandBody> bodies;
  std::vector<std::string> without_mesh;  ///< objects whose tasks are omitted
};

/// Read the displacements of BIH (Cruciani, Sundaralingam et al. 2020) from the user's copy.
/// The file is the sheet of palm poses saved as CSV, with the columns "Object", "Initial palm pose"
/// and "Desired palm pose". Each pose is x, y, z in metres and roll, pitch, yaw in radians, of the
/// palm in the object's frame. A motion of the palm is the opposite motion of the object in the
/// hand: with X and Y the two poses, X Y⁻¹ in the object's frame.
///
/// @param meshes  folder with a solid for each object in metres, named like "tuna_fish_can.obj" or
///     "007_tuna_fish_can.stl".
/// @throws InputError  if a line of the sheet or a mesh is invalid; the message names it.
[[nodiscard]] BihTasks ReadBih(const std::filesystem::path& sheet,
                               const std::filesystem::path& meshes);

}  // namespace regrasp::bench
