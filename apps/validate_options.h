#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/options.h"
#include "apps/repair_module.h"
#include "planner/base/file.h"
#include "planner/criteria/grasp_criteria.h"
#include "render/frames/frame.h"
#include "render/frames/overview_image.h"
#include "sim/actuation/conditions.h"
#include "sim/hand/check_hand.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"

namespace regrasp::apps {

/// Name of the program, printed before its messages.
inline constexpr char kValidateName[] = "validate";

/// Name of standard input (--plan) and standard output (--json).
inline constexpr char kStandardStream[] = "-";

/// Plans and grasps that get frames.
enum class Frames { kAll, kFailed, kNone };

/// HTML reports that contain the interactive 3-D replay.
enum class ViewerPages { kWithFrames, kAll, kNone };

/// Options of `validate`.
struct ValidateOptions {
  /// file of the object; for plans also a folder with the file that each names
  std::string object_path;
  std::vector<std::string> plans;  ///< files and folders of plans
  std::string plan_path;           ///< plan to validate
  std::string grasp_path;          ///< grasp to validate, instead of a plan
  std::string grasps_path;         ///< NPZ file of grasps, instead of a plan
  bool required_angle = false;     ///< whether to compute the required friction angle of each grasp
  bool quality = false;            ///< whether to compute the grasp quality of each grasp
  bool replay_grasps = false;      ///< whether to simulate the grasps that are force closure
  int states = 0;                  ///< number of reset states to make, instead of a plan
  /// Minimum grasp quality of reset states
  double min_quality = criteria::GraspCriteria().min_quality;
  std::string out;
  std::string junit;
  std::string json;
  std::string mjcf;
  std::string trajectory;
  std::string start;
  std::string goal;
  std::string hand;  ///< file of the hand; empty: the hand is not checked
  /// digest of `hand` with its model; empty: not computed yet (HandInput)
  std::string hand_sha256;
  double clearance_m = sim::HandCheckOptions().clearance_m;
  bool replay_by_hand = false;  ///< whether to replay on the hand's model, instead of ideal fingers
  sim::HandSensing sensing;     ///< sensors of the hand
  /// collision shape of the fingertips in a replay by the hand
  sim::TipShape tip = sim::TipShape::kBall;
  double tolerance_mm = 2;  ///< position tolerance of a replay by the hand
  double tolerance_deg = 5;
  sim::HandTolerance tolerance;  ///< tolerance of a replay by the hand; set by Finish
  std::string verify;            ///< report whose certificates are checked
  FrictionOptions friction;
  ContactOptions contact;
  RepairOptions repair;  ///< repair of the object of a grasp; a plan has its own
  std::optional<double> scale;
  sim::ReplayOptions replay;
  double joint_noise_deg = 0.5;
  std::optional<double> position_noise;  ///< of trials, over the object's diameter
  sim::TrialOptions trials;              ///< options of repeated replays; a count of 0: none
  std::string conditions;         ///< nominal, standard or a file of conditions; empty: not given
  std::string conditions_sha256;  ///< digest of that file; empty if there is none
  /// Return the file of conditions; empty if there is none.
  [[nodiscard]] std::string ConditionsFile() const {
    return conditions_sha256.empty() ? "" : conditions;
  }
  std::vector<sim::HandCondition> condition_list;  ///< conditions; set by Finish
  std::optional<double> required_conditions;       ///< required share of the conditions
  render::FrameOptions frame;
  int animation_width = 1280;  ///< width and height of animations, pixels
  int animation_height = 720;
  std::string video;
  int workers;  ///< number of threads that draw frames
  int sheet_width = render::kOverviewWidth;
  Frames frames = Frames::kAll;
  ViewerPages viewer = ViewerPages::kWithFrames;
  bool animate = false;
  bool show_clusters = false;
  bool certificates = false;
  bool allow_object_change = false;
  bool allow_undecided = false;
  bool quiet = false;
  bool silent = false;    ///< whether failures are not printed, because the caller prints them
  std::string index_key;  ///< key of the plan on the index page of its batch; empty: no batch
  int jobs;               ///< number of simultaneous plans, or of threads that make states
  std::optional<double> time_limit_s;
  bool fresh = false;  ///< whether to discard the results of an earlier run
  std::string shard;   ///< part of a JSON Lines file; empty: all
  /// Given settings of list options: `--replay tip`, "--tolerance mm".
  std::set<std::string> settings;
  /// Options of the command line that change results, with values, for a digest.
  std::vector<std::pair<std::string, std::vector<std::string>>> given;

  ValidateOptions();
  /// Add all options to the command line; parsing sets them.
  void AddTo(CLI::App& app);
  /// Complete the options after parsing, and check that they are consistent.
  /// @throws InputError  if they are inconsistent.
  void Finish(const CLI::App& app);

  /// Whether the input is several plans or a folder of plans.
  [[nodiscard]] bool for_batch() const;
  /// Whether the input is a JSON Lines file of plans.
  [[nodiscard]] bool for_lines() const;
  [[nodiscard]] bool trajectory_is_npz() const;
  [[nodiscard]] bool for_grasp() const { return !grasp_path.empty(); }
  [[nodiscard]] bool for_grasps() const { return !grasps_path.empty(); }
  [[nodiscard]] bool for_states() const { return states > 0; }
  /// Whether --video names a page with the interactive 3-D replay.
  [[nodiscard]] bool video_is_page() const { return LowerSuffix(video) == ".html"; }
  [[nodiscard]] bool animates() const { return animate || (!video.empty() && !video_is_page()); }
  [[nodiscard]] bool draws_frames(bool passed) const {
    return frames == Frames::kAll || (frames == Frames::kFailed && !passed);
  }
  /// Whether the HTML report contains the interactive 3-D replay.
  [[nodiscard]] bool has_viewer(bool passed) const {
    return viewer == ViewerPages::kAll ||
           (viewer == ViewerPages::kWithFrames && draws_frames(passed));
  }
  /// Path of the plan, the grasp or the grasps; for reset states, of the object.
  [[nodiscard]] const std::string& InputPath() const;
  /// Folder of the results.
  /// It is `out`, or out/<plan, grasp, object or folder name>, or out/batch.
  [[nodiscard]] std::filesystem::path Folder() const;
  /// Refuse options and settings.
  /// @param names  names of options ("--engine") and settings (`--replay tip`).
  /// @throws InputError  if one of them is given.
  void Refuse(const CLI::App& app, std::initializer_list<const char*> names,
              const std::string& why) const;

 private:
  void CheckPlans(const CLI::App& app);
};

}  // namespace regrasp::apps
