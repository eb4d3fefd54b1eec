#pragma once

#include <Eigen/Geometry>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/plan/reason.h"
#include "sim/actuation/hand_world.h"
#include "sim/actuation/penetration.h"
#include "sim/scene/measured.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// What a step breaks first.
struct HandBreach {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;
  plan::Fault fault;
};

/// Judges a replay by a hand while it runs.
class HandJudge {
 public:
  HandJudge(const HandWorld& world, const object::Polyhedron& solid, double scale,
            const HandTolerance& tolerance);

  /// What another judge of the same world has seen.
  void CopyState(const HandJudge& other);
  /// A step begins.
  void Start();
  void SetPhase(std::string phase) { phase_ = std::move(phase); }
  /// What fails from now on fails under this push.
  void SetPush(plan::FaultPush push) { push_ = std::move(push); }
  /// Fingers are to be at these contacts.
  /// @param known_off  how far off they may be besides, metres.
  void WatchContacts(const plan::FingerGrasp& grasp, double scale, double known_off = 0);
  /// A finger holds from now on, or no more; its slide counts from here.
  void SetHolding(FingerIndex finger, bool holds);
  /// A finger slides from now on, and its tip should be there, a place in the object's frame; how
  /// far off the surface does not count.
  void SetSliding(FingerIndex finger, const Eigen::Vector3d& centre_O);
  /// After every step of the world. @param planned  where the object should be.
  void Watch(const Eigen::Isometry3d& planned);
  /// The object is at rest and should be there.
  void WatchRest(const Eigen::Isometry3d& planned);
  /// A finger that is placed is to be near the object now.
  void WatchPlaced(FingerIndex finger);
  /// While on, from the start to the first rest, the model's own tips may be in the object: they
  /// are pushed out of it.
  void SetSettling(bool on) { settling_ = on; }
  /// The object is at rest: no tip may be too deep in it, and how deep collision geometry is that
  /// spheres stand for is measured.
  void WatchTipsAtRest();

  [[nodiscard]] const std::optional<HandBreach>& breach() const { return breach_; }
  [[nodiscard]] const HandMeasures& measures() const { return measures_; }

 private:
  struct Finger {
    bool holds = false;
    std::optional<Eigen::Vector3d> slides_to_O = std::nullopt;  ///< its tip's centre
    double without_force = 0;
    Eigen::Vector3d slip = Eigen::Vector3d::Zero();
    Eigen::Vector3d first_O = Eigen::Vector3d::Zero();
    std::vector<double> at_limit;       ///< seconds without a break, by drive
    std::vector<double> control_limit;  ///< seconds in this step, of its control
  };
  void WatchObject(const Eigen::Isometry3d& planned, double share, double& off_m, double& off_rad);
  void WatchFinger(FingerIndex finger);
  void WatchContact(FingerIndex finger);
  void WatchActuators(FingerIndex finger);
  void WatchLinks();
  void WatchJoints(FingerIndex finger);
  void WatchCouplings();
  void WatchTips(const std::vector<HandLinks::Placed>& placed);
  /// What of a finger must not be deeper in the object than `allowed`, in the palm's frame.
  void WatchDepth(FingerIndex finger, const collision::ConvexShape& shape, double allowed,
                  const std::string& what);
  /// What is drawn of a breach.
  struct Marks {
    std::string number;
    std::vector<FingerIndex> fingers = {};
    std::vector<plan::HandLink> links = {};
    std::optional<Eigen::Vector3d> at = std::nullopt;
    std::optional<Eigen::Isometry3d> pose = std::nullopt;  ///< where the object should be
  };
  void Fail(plan::Reason reason, const std::string& what, Marks marks);
  [[nodiscard]] std::vector<HandLinks::Placed> PlaceLinks() const;
  [[nodiscard]] std::string LinkText(const HandLinks::Placed& placed) const;
  [[nodiscard]] static Marks MarksOf(std::initializer_list<const HandLinks::Placed*> links);
  [[nodiscard]] Marks MarksOfJoint(FingerIndex finger, int joint, std::string number) const;

  const HandWorld& world_;
  std::shared_ptr<const Penetration> object_;  ///< which copies share
  HandTolerance tolerance_;
  std::string phase_;
  std::optional<plan::FaultPush> push_;
  std::vector<Finger> fingers_;
  HandMeasures measures_;
  std::optional<HandBreach> breach_;
  int steps_ = 0;
  bool settling_ = false;
};

}  // namespace regrasp::sim
