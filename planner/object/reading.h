#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/object/object.h"

namespace regrasp::object {

/// Contact patch by which a fingertip feels the surface normal (patch_normal.h).
struct FeltPatch {
  std::optional<double> radius;  ///< radius in object units; default kUsualPatch · D
  double most_angle = 0;  ///< largest angle between the contact's and the patch's normal, rad
};

/// Default radius of a contact patch divided by the diameter: about a finger's width on an object
/// held in one hand.
inline constexpr double kUsualPatch = 0.02;

/// Options, callbacks and deadline for reading an object.
struct Reading {
  /// Receives the name of each stage.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  Deadline deadline;
  /// If set, points with a rough patch take no fingers.
  std::optional<FeltPatch> patch = std::nullopt;
  bool allow_filled = false;   ///< whether filled surfaces of a repair take fingers
  bool counts_defects = true;  ///< whether a rejection counts all defects (mesh_survey.h)
  std::optional<Shells> shells = std::nullopt;  ///< no effect on a surface that is valid without it
  /// Receives a text on the treatment of several closed shells, if `shells` had an effect.
  std::function<void(const std::string&)> on_shells = [](const std::string&) {};

  /// Begin a stage. The deadline is checked only here: stages are not interrupted, except for
  /// assimp, whose process is killed.
  /// @throws TimeUp  if the deadline is reached.
  void Begin(const std::string& stage) const {
    deadline.Check();
    progress(stage);
  }
};

/// Read an object with options; see ReadObject(path).
/// @throws TimeUp  if the deadline is reached; names the file.
[[nodiscard]] ObjectFile ReadObject(const std::filesystem::path& path, const Reading& reading);

}  // namespace regrasp::object
