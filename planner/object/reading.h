#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/object/object.h"

namespace regrasp::object {

/// What a fingertip feels of a surface: not a facet, but what lies under it (patch_normal.h).
struct FeltPatch {
  std::optional<double> radius;  ///< the object's unit of length; kUsualPatch · D where left out
  double most_angle = 0;         ///< between a contact's normal and the patch's, radians
};

/// Over the diameter: a finger's breadth on what one hand holds.
inline constexpr double kUsualPatch = 0.02;

/// What is told while an object is read, and when that makes an end.
struct Reading {
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  Deadline deadline;
  std::optional<FeltPatch> patch = std::nullopt;  ///< places that are rough by it take no fingers
  bool allow_invented = false;                    ///< faces that a repair invented take fingers
  bool counts_defects = true;  ///< a refusal counts all that is wrong (mesh_survey.h)
  std::optional<Shells> shells = std::nullopt;  ///< a surface that is accepted without: no matter
  /// Told in words what became of several closed shells, where it is not what it is without a
  /// choice.
  std::function<void(const std::string&)> on_shells = [](const std::string&) {};

  /// Between two stages; they are not interrupted, but for assimp, whose process is ended.
  /// @throws TimeUp  the deadline came.
  void Begin(const std::string& stage) const {
    deadline.Check();
    progress(stage);
  }
};

/// ReadObject, stage by stage.
/// @throws TimeUp  the deadline came; names the file.
[[nodiscard]] ObjectFile ReadObject(const std::filesystem::path& path, const Reading& reading);

}  // namespace regrasp::object
