#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/object/object.h"

namespace regrasp::object {

/// What is told while an object is read, and when that makes an end.
struct Reading {
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  Deadline deadline;

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
