#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"
#include "planner/object/object.h"

namespace regrasp::plan {

/// Normals in files must be of unit length within this (docs/formats.md).
inline constexpr double kNormalLengthTolerance = 1e-4;

/// Normals in files must be within this of a face's own normal, radians: 0.1° (docs/formats.md).
inline constexpr double kNormalTolerance = Radians(0.1);

/// A contact and the finger that makes it; fingers are numbered from 0.
struct FingerContact {
  FingerIndex finger = {};
  grasp::Contact contact;
  /// Of a contact that a switch between 2-finger grasps of a polygon places: how far both contacts
  /// of the grasp before it, and of the grasp after it, may be off along the boundary, whichever
  /// way each, and the grasp is still force closure. In the object's unit of length.
  std::optional<double> region = std::nullopt;
};

/// The fingers that hold the object, in the order of the file.
using FingerGrasp = std::vector<FingerContact>;

/// How a hand and the object in it stand at an instant.
struct HandState {
  /// Of the object's frame (its file's axes and origin, lengths in metres) in the palm's frame.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Angles by finger, from the palm to the tip, as the hand's model has them, radians.
  std::vector<std::vector<double>> joints;
};

/// States that follow each other. Between two of them joints go straight, the object's origin goes
/// straight and its orientation turns about one axis at an even rate, all in the same time.
using HandPath = std::vector<HandState>;

/// A finger switch as a hand does it: fingers come to their contacts, then others leave theirs. The
/// first state of each is the last one before it.
struct SwitchMotion {
  HandPath place;
  HandPath release;
};

/// The hand that a plan is for, and how it stands with the initial grasp.
struct HandUse {
  std::string name;
  std::string file;    ///< of the hand, without folders
  std::string sha256;  ///< kinematics::HandModel::sha256
  HandState initial;
  Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();  ///< where the object is to be at last
};

/// The `place` fingers, all free before, touch; then the `release` fingers, all holding before,
/// leave. The grasp before and the grasp after are each force closure.
struct Switch {
  FingerGrasp place;
  std::vector<FingerIndex> release;
  std::optional<SwitchMotion> motion = std::nullopt;  ///< of a plan for a hand
};

/// A claim that an align is force closure everywhere on the path, with its proof: for each pair of
/// waypoints that follow each other, pieces whose forces are in the order of the first of the two.
using AlignCertificate = std::vector<motion::MotionSegments>;

/// An align as a hand does it: a path for each pair of waypoints that follow each other, its states
/// at equal shares of the way. The first state of each is the last one before it.
using AlignMotion = std::vector<HandPath>;

/// The holding fingers move together along the surface, straight from waypoint to waypoint, all at
/// the same rate. The first waypoint is the grasp before the step.
struct Align {
  std::vector<FingerGrasp> waypoints;
  std::optional<AlignCertificate> certificate = std::nullopt;
  std::optional<AlignMotion> motion = std::nullopt;  ///< of a plan for a hand
};

/// The object moves in the hand: all fingers keep their contacts and go with it. To fingers without
/// a hand nothing happens.
struct Move {
  HandPath path;
};

using Step = std::variant<Switch, Align, Move>;

/// How a plan over a roadmap of clustered contact points came about.
struct RoadmapNote {
  int contacts = 0;  ///< contact points asked for
  int clusters = 0;
  std::uint64_t seed = 0;
  std::string start;  ///< what linked the start to the representatives: "algorithm-1", …
  std::string goal;
  /// Radians by which a contact's normal may differ from that of its patch (Plan::patch_radius),
  /// and by which the contacts were clustered with less than the friction's half-angle.
  std::optional<double> roughness = std::nullopt;
  bool allow_invented = false;  ///< contact points are on invented surface, too
};

/// A regrasp plan: the contents of a plan file (docs/formats.md), angles in radians.
struct Plan {
  std::string object_file;
  std::string object_sha256;
  /// Where the object is a solid that a repair made of the file's surface.
  std::optional<object::RepairRecord> repair = std::nullopt;
  /// What was made of several closed shells, where that was asked.
  std::optional<object::Shells> shells = std::nullopt;
  double scale = 1;  ///< metres per unit of the object's file
  int dimension = 3;
  double half_angle = 0;  ///< friction half-angle, radians
  int fingers = 0;        ///< that the hand has
  std::string planner;
  /// Radius that the fingers were planned with, the object's unit of length; points where none.
  std::optional<double> finger_radius = std::nullopt;
  /// Of all contacts (grasp::Contact::torsion), the object's unit of length; 0: hard points. What
  /// contacts have themselves is set by LocatePlan.
  double torsion = 0;
  /// Radius of the patches that fingertips touch (object/patch_normal.h), the object's unit of
  /// length: grasps at rest are force closure with the patches' normals too. None where they need
  /// not be.
  std::optional<double> patch_radius = std::nullopt;
  /// Whether every contact is at a point that the object's file gives (object/given_points.h), and
  /// fingers move by switches only.
  bool at_given_points = false;
  std::optional<RoadmapNote> roadmap = std::nullopt;
  std::optional<HandUse> hand = std::nullopt;  ///< that it is for; none: fingers without one
  FingerGrasp initial;
  std::vector<Step> steps;
  grasp::Grasp goal;
};

/// An entry of a check, a replay or a report: 0 is the hold of the initial grasp, k the k-th step,
/// which is Plan::steps[k − 1].
using EntryIndex = Index<struct EntryTag>;

/// The step of an entry that is not the hold.
[[nodiscard]] inline const Step& StepOf(const Plan& plan, EntryIndex entry) {
  return plan.steps[entry - 1];
}

/// Gives all contacts of a plan, and the plan itself, this torsion.
void SetTorsion(double torsion, Plan& plan);

/// "hold" for entry 0 of a report, "switch", "align" or "move" for a step.
[[nodiscard]] const char* StepKind(const Step& step);

/// The contact of a finger; null where it does not hold.
[[nodiscard]] const FingerContact* FindFinger(const FingerGrasp& grasp, FingerIndex finger);

/// The grasp after `step` when `before` holds. Fingers keep their order; a placed finger comes
/// last. Fingers of `release` that do not hold are ignored: the checker reports them.
[[nodiscard]] FingerGrasp GraspAfter(const FingerGrasp& before, const Step& step);

/// The fingers of `from` on their way to a next waypoint of an align; those that it lacks stay.
/// @param share  of the way, 0 to 1.
[[nodiscard]] FingerGrasp GraspBetween(const FingerGrasp& from, const FingerGrasp& to,
                                       double share);

/// Finger 0 at the first contact, 1 at the next.
[[nodiscard]] FingerGrasp FingersInOrder(const grasp::Grasp& grasp);

/// The contacts without their fingers.
[[nodiscard]] grasp::Grasp ContactsOf(const FingerGrasp& grasp);

/// True iff points are within `tolerance` of each other and normals within kNormalTolerance.
[[nodiscard]] bool AreSameContact(const grasp::Contact& a, const grasp::Contact& b,
                                  double tolerance);

/// True iff the contacts of two grasps can be paired so that each pair is the same contact, in any
/// order. A maximum matching: within tolerance one contact may fit several.
[[nodiscard]] bool AreSameGrasp(const grasp::Grasp& a, const grasp::Grasp& b, double tolerance);

/// True iff the same fingers, in the same order, have the same bits of point, normal and torsion.
[[nodiscard]] bool AreIdentical(const FingerGrasp& a, const FingerGrasp& b);

/// The state between two that follow each other on a path (HandPath).
/// @param share  0: `from`, 1: `to`.
[[nodiscard]] HandState StateBetween(const HandState& from, const HandState& to, double share);

/// All paths of a step as a hand does it, in their order; none where the plan does not say.
[[nodiscard]] std::vector<const HandPath*> PathsOf(const Step& step);

}  // namespace regrasp::plan
