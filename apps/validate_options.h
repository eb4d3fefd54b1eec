#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/options.h"
#include "render/frame.h"
#include "render/replay_animation.h"
#include "sim/settings.h"

namespace regrasp {

/// The program's name, before its messages.
inline constexpr char kValidateName[] = "validate";

/// What the command line of `validate` asks for.
struct ValidateOptions {
  std::string object_path;
  std::string plan_path;
  std::string grasp_path;  ///< instead of a plan
  std::string out;
  std::string junit;
  std::string mjcf;
  std::string trajectory;
  std::string start;
  std::string goal;
  std::string verify;  ///< a report whose proofs are checked; nothing else is done
  FrictionOptions friction;
  std::optional<double> scale;
  ReplayOptions replay;
  FrameOptions frame;
  AnimationOptions animation;
  bool no_frames = false;
  bool animate = false;
  bool show_clusters = false;
  bool certificates = false;
  bool allow_object_change = false;
  bool quiet = false;

  /// Adds all options to the command line; they are set when it is parsed.
  void AddTo(CLI::App& app);
  /// @throws InputError  options that do not go together.
  void CheckUsage() const;

  [[nodiscard]] bool for_grasp() const { return !grasp_path.empty(); }
  /// The plan or the grasp.
  [[nodiscard]] const std::string& InputPath() const;
  /// Where report and frames go: `out`, or out/<plan or grasp name>.
  [[nodiscard]] std::filesystem::path Folder() const;
};

}  // namespace regrasp
