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
#include "planner/plan/goal_set.h"

namespace regrasp::plan {

/// Largest deviation from 1 of the length of normals in files (docs/formats.md).
inline constexpr double kNormalLengthTolerance = 1e-4;

/// Largest angle between normals in files and the face's normal, radians: 0.1° (docs/formats.md).
inline constexpr double kNormalTolerance = Radians(0.1);

/// Contact with its finger; fingers are numbered from 0.
struct FingerContact {
  FingerIndex finger = {};
  grasp::Contact contact;
  /// Independent contact region of a contact that a finger switch between 2-finger grasps of a
  /// polygon places: a distance in the object's unit of length. If both contacts of the grasp
  /// before, or of the grasp after, move along the boundary by up to this distance in any
  /// direction, the grasp stays force closure.
  std::optional<double> region = std::nullopt;
};

/// Fingers in contact with the object, in file order.
using FingerGrasp = std::vector<FingerContact>;

/// State of a hand and its object at an instant.
struct HandState {
  /// Pose of the object's frame (axes and origin of its file, lengths in metres) in the palm's
  /// frame.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Joint angles [finger][joint] from the palm to the fingertip, in the order of the hand model,
  /// radians.
  std::vector<std::vector<double>> joints;
};

/// Sequence of states. Between consecutive states the joints and the object's origin move linearly,
/// and the object rotates about one axis at a constant rate, all in the same time.
using HandPath = std::vector<HandState>;

/// Finger switch as a motion of the hand: fingers reach their contacts, then other fingers leave
/// theirs. The first state of each path is the last state before it.
struct SwitchMotion {
  HandPath place;
  HandPath release;
};

/// Goal set that the object is in after a step of a plan.
struct GoalMark {
  std::string name;  ///< empty for the only goal of a plan
  int step = 0;      ///< number of the last step of this goal; 0: the initial grasp
  GoalSet set;
};

/// Permission for static grasps that hold the object by its weight (gravity_support.h), and what
/// such a grasp withstands. Both numbers are in weights of the object.
struct GravitySupport {
  double disturbance = 0.1;  ///< size of the disturbances that it resists, > 0
  double force = 9;          ///< largest sum of its normal forces, ≥ 1
};

/// Hand of a plan, and its state at the initial grasp.
struct HandUse {
  std::string name;
  std::string file;    ///< file name of the hand, without folders
  std::string sha256;  ///< kinematics::HandModel::sha256
  HandState initial;
  Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();  ///< final pose of the object
  /// Goals with tolerances, in the order of their steps. Empty if the only goal is `goal`.
  std::vector<GoalMark> goals = {};
  /// Unit vector against gravity in the palm's frame, if it is not that of the hand's file.
  std::optional<Eigen::Vector3d> up = {};
  /// Set if static grasps and in-hand motions need not be force closure; `up` is then set too.
  std::optional<GravitySupport> gravity_support = {};
  /// Mass of the object for which the plan was simulated, kg; nullopt: with the density of water.
  std::optional<double> mass_kg = {};
};

/// Finger switch: the `place` fingers, which are free, make contact; then the `release` fingers,
/// which are in contact, break contact. The grasps before and after are each force closure.
struct Switch {
  FingerGrasp place;
  std::vector<FingerIndex> release;
  std::optional<SwitchMotion> motion =
      std::nullopt;  ///< paths of the hand; only in a plan for a hand
};

/// Claim that a sliding step is force closure anywhere on the path, with its proof. For each pair
/// of consecutive waypoints there are pieces; their forces are in the order of the first waypoint.
using AlignCertificate = std::vector<motion::MotionSegments>;

/// Sliding step as a motion of the hand: for each pair of consecutive waypoints a path, whose
/// states are at equal shares of the distance. The first state of each path is the last state
/// before it.
using AlignMotion = std::vector<HandPath>;

/// Sliding step: the fingers in contact move together along the surface, straight from waypoint to
/// waypoint, all at the same rate. The first waypoint is the grasp before the step.
struct Align {
  std::vector<FingerGrasp> waypoints;
  std::optional<AlignCertificate> certificate = std::nullopt;
  std::optional<AlignMotion> motion =
      std::nullopt;  ///< paths of the hand; only in a plan for a hand
};

/// In-hand motion: the object moves in the hand, and all fingers stay in contact and move with it.
/// Contacts are fixed on the object, or fingertips roll along the surface without slipping.
struct Move {
  HandPath path;
  /// Contacts at each state of the path, if fingertips roll. Between two states the points move
  /// straight and the normals rotate on great circles (GraspBetween). The first element is the
  /// grasp before the step. A contact on an edge may have any normal between those of its faces.
  /// Empty: contacts are fixed on the object.
  std::vector<FingerGrasp> contacts = {};
};

using Step = std::variant<Switch, Align, Move>;

/// Parameters of a plan on a roadmap of clustered contact points.
struct RoadmapNote {
  int contacts = 0;  ///< requested number of contact points
  int clusters = 0;
  std::uint64_t seed = 0;
  /// Algorithm that connected the start to the representatives: "algorithm-1", ….
  std::string start;
  std::string goal;
  /// Largest angle between a contact's normal and that of its patch (Plan::patch_radius), radians.
  /// The contacts were clustered with a friction angle that is smaller by this angle.
  std::optional<double> roughness = std::nullopt;
  bool allow_filled = false;  ///< whether contact points may be on filled surface
};

/// Regrasp plan: the contents of a plan file (docs/formats.md), angles in radians.
struct Plan {
  std::string object_file;
  std::string object_sha256;
  /// Record of the repair, if the object is a solid that a repair made of the file's surface.
  std::optional<object::RepairRecord> repair = std::nullopt;
  /// Treatment of several closed shells, if one was requested.
  std::optional<object::Shells> shells = std::nullopt;
  double scale = 1;  ///< metres per unit of the object's file
  int dimension = 3;
  double friction_angle = 0;  ///< friction angle, radians
  int fingers = 0;            ///< number of fingers of the hand
  std::string planner;
  /// Radius of the fingers in planning, in the object's unit of length; without it fingers are
  /// points.
  std::optional<double> finger_radius = std::nullopt;
  /// Torsional friction length of all contacts (grasp::Contact::torsion), in the object's unit of
  /// length; 0: hard-finger contacts. ProjectPlan sets the torsion of the contacts themselves.
  double torsion = 0;
  /// Radius of the contact patches of fingertips (object/polyhedron.h), in the object's unit of
  /// length. If set, static grasps are force closure with the patches' normals too.
  std::optional<double> patch_radius = std::nullopt;
  /// Whether every contact is at a point of the object's file (object/read_object.h), and fingers
  /// move by switches only.
  bool at_given_points = false;
  std::optional<RoadmapNote> roadmap = std::nullopt;
  /// Hand of the plan; none: fingers without a hand model.
  std::optional<HandUse> hand = std::nullopt;
  FingerGrasp initial;
  std::vector<Step> steps;
  grasp::Grasp goal;
};

/// Entry of a check, a replay or a report. 0 is the initial grasp, k the k-th step, Plan::steps[k −
/// 1].
using EntryIndex = Index<struct EntryTag>;

/// Return the step of an entry > 0.
[[nodiscard]] inline const Step& StepOf(const Plan& plan, EntryIndex entry) {
  return plan.steps[entry - 1];
}

/// Set the torsional friction length of a plan and all its contacts.
void SetTorsion(double torsion, Plan& plan);

/// Return "hold" for entry 0 of a report, "switch", "align" or "move" for a step.
[[nodiscard]] const char* StepKind(const Step& step);

/// Return the contact of a finger; null if it is not in contact.
[[nodiscard]] const FingerContact* FindFinger(const FingerGrasp& grasp, FingerIndex finger);

/// Return whether two grasps, each with one contact per finger, are those of the same fingers.
[[nodiscard]] bool HaveSameFingers(const FingerGrasp& a, const FingerGrasp& b);

/// Return the grasp after `step` from the grasp `before`.
/// Fingers keep their order; a placed finger comes last. Fingers of `release` that are not in
/// contact are ignored, because the checker reports them.
[[nodiscard]] FingerGrasp GraspAfter(const FingerGrasp& before, const Step& step);

/// Return the fingers of `from` between two waypoints of a sliding step.
/// Fingers that `to` does not contain do not move.
/// @param share  fraction of the distance, 0 to 1.
[[nodiscard]] FingerGrasp GraspBetween(const FingerGrasp& from, const FingerGrasp& to,
                                       double share);

/// Return a grasp with finger 0 at the first contact, 1 at the next, and so on.
[[nodiscard]] FingerGrasp FingersInOrder(const grasp::Grasp& grasp);

/// Return the contacts without their fingers.
[[nodiscard]] grasp::Grasp ContactsOf(const FingerGrasp& grasp);

/// Return whether points are within `tolerance` and normals within kNormalTolerance.
[[nodiscard]] bool AreSameContact(const grasp::Contact& a, const grasp::Contact& b,
                                  double tolerance);

/// Return whether the contacts of two grasps can be paired, in any order, into equal contacts.
/// Computes a maximum matching, because one contact may match several within the tolerance.
[[nodiscard]] bool AreSameGrasp(const grasp::Grasp& a, const grasp::Grasp& b, double tolerance);

/// Return whether fingers, order, and the bits of point, normal and torsion are the same.
[[nodiscard]] bool AreIdentical(const FingerGrasp& a, const FingerGrasp& b);

/// Return the state between two consecutive states of a path (HandPath).
/// @param share  0: `from`, 1: `to`.
[[nodiscard]] HandState StateBetween(const HandState& from, const HandState& to, double share);

/// Return the state of the hand after a step; `before` if the plan has no path for it.
[[nodiscard]] HandState StateAfter(const HandState& before, const Step& step);

/// State of a hand and its contacts at the end of a plan.
struct HandEnd {
  HandState state;
  FingerGrasp grasp;
};

/// Return the state after the last step of a plan for a hand.
/// @throws std::invalid_argument  if the plan has no hand.
[[nodiscard]] HandEnd EndOfPlan(const Plan& plan);

/// Return whether fingertips roll in a step of a plan (Move::contacts).
[[nodiscard]] bool HasRolling(const Plan& plan);

/// Return all paths of a step's hand motion in order; empty if the plan has none.
[[nodiscard]] std::vector<const HandPath*> PathsOf(const Step& step);

}  // namespace regrasp::plan
