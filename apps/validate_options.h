#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/options.h"
#include "apps/repair_options.h"
#include "planner/criteria/grasp_criteria.h"
#include "render/frames/frame.h"
#include "render/frames/overview_image.h"
#include "sim/hand/check_hand.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"

namespace regrasp::apps {

/// The program's name, before its messages.
inline constexpr char kValidateName[] = "validate";

/// Of --plan and --json: standard input and output.
inline constexpr char kStandardStream[] = "-";

/// Of which plans and grasps frames are drawn.
enum class Frames { kAll, kFailed, kNone };

/// What the command line of `validate` asks for.
struct ValidateOptions {
  std::string object_path;         ///< for plans also a folder, where each finds the file it names
  std::vector<std::string> plans;  ///< files and folders
  std::string plan_path;           ///< the one to validate now
  std::string grasp_path;          ///< instead of a plan
  std::string grasps_path;         ///< many of them, as arrays
  bool required_angle = false;     ///< of each of those, too
  bool quality = false;            ///< likewise
  bool replay_grasps = false;      ///< holds and shakes those that are force closure
  int states = 0;                  ///< reset states that are made, instead of a plan
  double min_quality = criteria::GraspCriteria().min_quality;  ///< of their grasps
  std::string out;
  std::string junit;
  std::string json;
  std::string mjcf;
  std::string trajectory;
  std::string start;
  std::string goal;
  std::string hand;         ///< of a plan for a hand: its file; empty: the hand is not checked
  std::string hand_sha256;  ///< of `hand` with its model; empty: not known yet (HandInput)
  double clearance_m = sim::HandCheckOptions().clearance_m;
  bool replay_by_hand = false;  ///< on the hand's own model, not by ideal fingers
  bool feedback = true;         ///< of that replay: joint targets follow the object's pose
  sim::TipShape tip = sim::TipShape::kBall;  ///< of the same: what touches the object
  double tolerance_mm = 2;                   ///< of the same
  double tolerance_deg = 5;
  sim::HandTolerance tolerance;  ///< after Finish
  std::string verify;            ///< a report whose proofs are checked; nothing else is done
  FrictionOptions friction;
  ContactOptions contact;
  RepairOptions repair;  ///< of a grasp's object; a plan holds its own
  std::optional<double> scale;
  sim::ReplayOptions replay;
  double joint_noise_deg = 0.5;
  sim::TrialOptions trials;  ///< a count of 0: none
  render::FrameOptions frame;
  int animation_width = 0;  ///< pixels; after Finish those of --animate-size, or half of --size
  int animation_height = 0;
  bool animation_crop = false;
  std::string video;
  int workers;  ///< threads that draw pictures
  int sheet_width = render::kOverviewWidth;
  Frames frames = Frames::kAll;
  bool animate = false;
  bool show_clusters = false;
  bool certificates = false;
  bool allow_object_change = false;
  bool allow_undecided = false;
  bool quiet = false;
  bool silent = false;  ///< says not even why something failed: the caller does
  int jobs;             ///< plans at a time, or threads that make states
  std::optional<double> time_limit_s;
  bool fresh = false;  ///< validates again what an earlier run did
  std::string shard;   ///< of a file of lines; empty: all
  /// Given options that change results, each with its values: what a run's digest is over.
  std::vector<std::pair<std::string, std::vector<std::string>>> given;

  ValidateOptions();
  /// Adds all options to the command line; they are set when it is parsed.
  void AddTo(CLI::App& app);
  /// After parsing: finds out what is given and whether it goes together.
  /// @throws InputError  it does not.
  void Finish(const CLI::App& app);

  /// Several plans, or a folder of them.
  [[nodiscard]] bool for_batch() const;
  /// A file of lines with a plan in each.
  [[nodiscard]] bool for_lines() const;
  [[nodiscard]] bool trajectory_is_npz() const;
  [[nodiscard]] bool for_grasp() const { return !grasp_path.empty(); }
  [[nodiscard]] bool for_grasps() const { return !grasps_path.empty(); }
  [[nodiscard]] bool for_states() const { return states > 0; }
  [[nodiscard]] bool animates() const { return animate || !video.empty(); }
  [[nodiscard]] bool draws_frames(bool passed) const {
    return frames == Frames::kAll || (frames == Frames::kFailed && !passed);
  }
  /// The plan, the grasp or the grasps; of states the object.
  [[nodiscard]] const std::string& InputPath() const;
  /// Where results go: `out`, or out/<plan, grasp, object or folder name>, or out/batch.
  [[nodiscard]] std::filesystem::path Folder() const;
};

}  // namespace regrasp::apps
