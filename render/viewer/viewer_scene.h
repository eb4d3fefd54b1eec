#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/plan/plan.h"
#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

// Data of the interactive 3-D replay. Lengths in metres, forces in newtons, angles in radians, all
// in the world frame, in which z is up.

/// A revolute joint of a hand: after its parent, at `offset` in the parent's frame, it rotates
/// about `axis` by its angle minus `rest`.
struct ViewerJoint {
  int parent = -1;  ///< index of the joint before it; -1: the palm
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double rest = 0;
};

/// A link of a hand with its mesh, in the frame of the last joint that moves it.
struct ViewerLink {
  int joint = -1;           ///< index of that joint; -1: the palm
  FingerIndex finger = {};  ///< finger of the link; not valid for the palm
  bool is_fingertip = false;
  ShadedMesh mesh;
};

enum class ViewerContactState { kHidden, kFree, kHolding };

/// A finger at one instant.
struct ViewerContact {
  ViewerContactState state = ViewerContactState::kHidden;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< its contact, or its front in the air
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();  ///< inward unit normal at the contact
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< force on the object
};

/// The state of object, hand and fingers at one instant.
struct ViewerSample {
  double time_s = 0;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  std::vector<double> joints = {};           ///< angles of ViewerScene::joints
  std::vector<ViewerContact> contacts = {};  ///< of ViewerScene::fingers, in their order
};

/// A finger by its number, and the name that is shown.
struct ViewerFinger {
  FingerIndex finger = {};
  std::string name;
};

/// An entry of the plan as it is shown: the initial grasp, or a step.
struct ViewerStep {
  int number = 0;  ///< 0: the initial grasp
  double start_s = 0;
  double end_s = 0;
  std::string title;                            ///< "Switch: place 4, release 0"
  std::string verdict;                          ///< "pass", "fail" or "skipped"
  std::string reason = {};                      ///< name of the reason and details of a failure
  std::optional<double> margin = std::nullopt;  ///< friction margin of all grasps of the step
};

/// A line that marks a fault, with its text.
struct ViewerMark {
  Eigen::Vector3d from, to;
  bool expected = false;  ///< whether it shows an expected value, instead of an actual one
  std::string text;
};

/// The fault at the last sample.
struct ViewerFailure {
  std::string heading;            ///< reason, one line
  std::vector<int> fingers = {};  ///< indices of ViewerScene::fingers
  std::vector<int> links = {};    ///< indices of ViewerScene::links
  std::vector<ViewerMark> marks = {};
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;  ///< former pose of the object
  std::string ghost_text = {};
};

/// A replay as the viewer shows it.
struct ViewerScene {
  std::string object_name;
  ShadedMesh object;                                       ///< its surface in the object's frame
  std::vector<std::array<Eigen::Vector3d, 2>> edges = {};  ///< its creases, in the same frame
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double diameter_m = 1;
  bool planar = false;
  double friction_angle = 0;
  bool hard_fingers = true;  ///< whether fingers have no torsional friction
  std::optional<double> finger_radius_m = std::nullopt;    ///< true radius; without one, a symbol
  Eigen::Isometry3d X_WP = Eigen::Isometry3d::Identity();  ///< pose of the palm
  std::vector<ViewerJoint> joints = {};
  std::vector<ViewerLink> links = {};  ///< empty without a hand
  std::vector<ViewerFinger> fingers = {};
  std::vector<ViewerStep> steps = {};
  std::vector<ViewerSample> samples = {};  ///< at least one, ascending in time
  /// Whether times are those of the simulation. Otherwise they only give the order.
  bool simulated_time = false;
  /// Angle of the rotation up to each sample, and that of the whole plan. Without a value the
  /// object does not rotate on purpose.
  std::vector<double> turned = {};
  std::optional<double> goal_turn = std::nullopt;
  Eigen::Vector3d to_eye = Eigen::Vector3d::UnitX();  ///< direction to the first camera
  std::optional<ViewerFailure> failure = std::nullopt;
};

/// Format a scene as JSON in ASCII, which can be the content of a script element.
///
/// Every mesh is written once. Positions, angles and forces are integers of 16 bits between the
/// least and the largest value of their column, as base64; columns that do not change have no data.
/// Names lose invisible characters. The characters < > & are escaped. Deterministic.
/// @throws std::invalid_argument  if there is no sample, or samples differ in their number of
///     joints or fingers.
[[nodiscard]] std::string FormatViewerScene(const ViewerScene& scene);

/// Return bytes as base64 text.
[[nodiscard]] std::string Base64(std::string_view bytes);

/// Return the digest of a script as a content security policy names it: "sha256-…".
[[nodiscard]] std::string ScriptHash(std::string_view script);

/// Largest number of triangles of the object and of a hand. Larger meshes are simplified.
inline constexpr int kMostViewerTriangles = 40000;
inline constexpr int kMostHandTriangles = 80000;

/// Simplify a mesh to at most `most` triangles: vertices in one cell of a grid become one.
[[nodiscard]] ShadedMesh SimplifyForViewer(const ShadedMesh& mesh, int most);

}  // namespace regrasp::render
