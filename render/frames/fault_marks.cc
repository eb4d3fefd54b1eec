#include "render/frames/fault_marks.h"

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/object/rotation.h"

namespace regrasp::render {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::Reason;

// Lengths in object diameters.
constexpr double kTooShort = 0.03;        ///< distances below this are stretched
constexpr double kLeastSeen = 0.05;       ///< length of stretched distances
constexpr double kMostSeen = 0.35;        ///< maximum length of distances off the surface
constexpr double kFarFromCentroid = 1.5;  ///< limit of the distance from the centroid for drawing

/// Largest stretch factor. Lengths that need a larger one are treated as zero.
constexpr double kMostStretch = 2000;

/// Distance from the surface within which a replayed contact is considered in contact, in
/// diameters.
constexpr double kTouches = 0.02;

constexpr int kFactorDigits = 2;

/// Angle below which two normals look the same.
constexpr double kSameNormal = Radians(0.05);

/// Return the factor that makes a length visible.
double StretchOf(double length, double most) {
  if (!(length > kLeastSeen / kMostStretch)) return 1;
  if (length < kTooShort) return kLeastSeen / length;
  return length > most ? most / length : 1;
}

/// Return "", " (drawn × 40)" or " (drawn shorter)".
std::string StretchText(double factor, const std::string& what = "") {
  if (factor == 1) return "";
  if (factor < 1) return " (" + what + "drawn shorter)";
  return " (" + what + "drawn × " + FormatPlain(factor, kFactorDigits) + ")";
}

/// Return whether the finger is drawn displaced instead of its expected position, because the
/// surface does not move.
bool IsOffSurface(Reason reason) {
  return reason == Reason::kOffSurface || reason == Reason::kContactLost;
}

class FaultSceneBuilder {
 public:
  FaultSceneBuilder(const object::Object& object, double scale, Reason reason,
                    const plan::Fault& fault, const plan::Snapshot& snapshot,
                    const std::string& heading)
      : object_(object), scale_(scale), reason_(reason), fault_(fault) {
    scene_.snapshot = snapshot;
    scene_.marks.heading = heading;
    scene_.marks.fingers = fault.fingers;
    scene_.marks.planar = object.dimension() == 2;
    scene_.marks.centroid = snapshot.X_WO * Centroid();
  }

  FaultScene Make() {
    PutOnSurface();
    if (fault_.found && fault_.expected.size() == 1) {
      AddMisplaced(*fault_.found, fault_.expected.front());
    } else {
      for (const grasp::Contact& contact : fault_.expected) AddPlace(contact, PlaceText());
    }
    AddCones();
    AddFingertips();
    AddHand();
    AddMotion();
    scene_.marks.disturbance = fault_.disturbance;
    LeaveOutWhatIsFar();
    return scene_;
  }

 private:
  [[nodiscard]] Vector3d Centroid() const { return scale_ * object_.mass_properties().centroid; }
  [[nodiscard]] double diameter_m() const { return scale_ * object_.diameter(); }
  [[nodiscard]] Vector3d Place(const Vector3d& p_O) const {
    return scene_.snapshot.X_WO * (scale_ * p_O);
  }
  [[nodiscard]] Vector3d Direction(const Vector3d& n_O) const {
    return scene_.snapshot.X_WO.linear() * n_O.stableNormalized();
  }
  [[nodiscard]] bool IsNear(const Vector3d& p_W) const {
    return (p_W - scene_.marks.centroid).stableNorm() <= kFarFromCentroid * diameter_m();
  }

  [[nodiscard]] std::string PlaceText() const {
    if (reason_ == Reason::kStartDiffers) return "start";
    if (reason_ == Reason::kGoalNotReached) return "goal";
    if (reason_ == Reason::kObjectMoved && fault_.hand) return "planned here";
    return "was here";
  }

  /// Return whether the finger is or can be off the surface as given.
  [[nodiscard]] bool IsOff(FingerIndex finger) const {
    if (reason_ == Reason::kOffSurface) return true;
    return reason_ == Reason::kContactLost && finger == fault_.fingers.front();
  }

  /// Project contacts that slipped over an edge or into the surface onto it. A fingertip inside the
  /// object would be invisible.
  void PutOnSurface() {
    const Isometry3d X_OW = scene_.snapshot.X_WO.inverse();
    for (plan::FingerState& state : scene_.snapshot.fingers) {
      if (!IsNear(state.contact_W) || IsOff(state.finger)) continue;
      const Vector3d p_O = X_OW * state.contact_W / scale_;
      const auto faces = object_.FacesNear(p_O, kTouches * object_.diameter());
      if (!faces.empty()) state.contact_W = Place(object_.ClosestPoint(faces.front(), p_O));
    }
  }

  void AddPlace(const grasp::Contact& contact, const std::string& text) {
    const Vector3d at = Place(contact.p);
    if (IsNear(at)) scene_.marks.places.push_back({at, Direction(contact.n), text});
  }

  void AddMisplaced(const grasp::Contact& found, const grasp::Contact& expected) {
    const Vector3d away = found.p - expected.p;
    const double distance = away.stableNorm();
    const bool off = IsOffSurface(reason_);
    const double most = reason_ == Reason::kOffSurface ? kMostSeen : kFarFromCentroid;
    const double stretch = StretchOf(distance / object_.diameter(), most);
    const Vector3d leg =
        away.stableNormalized() * std::min(distance * stretch, 2 * object_.diameter());
    const Vector3d found_O = off ? Vector3d(expected.p + leg) : found.p;
    const Vector3d expected_O = off ? expected.p : Vector3d(found.p - leg);
    const bool seen = stretch != 1 || distance / object_.diameter() >= kTooShort;
    if (seen) {
      scene_.marks.dimensions.push_back({Place(expected_O), Place(found_O),
                                         FormatLength(distance * scale_) + StretchText(stretch)});
    }
    if (off) MoveFinger(found_O);
    if (reason_ == Reason::kWrongNormal) StandFinger(expected);
    if (seen && !off && reason_ != Reason::kWrongNormal) {
      AddPlace({expected_O, expected.n},
               reason_ == Reason::kFingerNotFree ? "in contact" : "was here");
    }
    AddNormals({found_O, found.n}, {expected_O, expected.n});
  }

  /// Draw the faulty finger at a point.
  void MoveFinger(const Vector3d& p_O) {
    const grasp::Contact& found = *fault_.found;
    for (plan::FingerState& state : scene_.snapshot.fingers) {
      if (state.finger != fault_.fingers.front()) continue;
      // A plan can name a finger twice. The other contact stays.
      const bool same = reason_ == Reason::kContactLost ||
                        (state.contact_W - Place(found.p)).stableNorm() <=
                            object::kPointTolerance * diameter_m() ||
                        !IsNear(state.contact_W);
      if (!same) continue;
      state.contact_W = Place(p_O);
      state.tip_W = state.contact_W - scene_.snapshot.fingertip_radius_m * state.normal_W;
    }
  }

  /// Draw the faulty finger on the outside, even if its normal is wrong.
  void StandFinger(const grasp::Contact& expected) {
    for (plan::FingerState& state : scene_.snapshot.fingers) {
      if (state.finger != fault_.fingers.front()) continue;
      state.normal_W = Direction(expected.n);
      state.tip_W = state.contact_W - scene_.snapshot.fingertip_radius_m * state.normal_W;
    }
  }

  void AddNormals(const grasp::Contact& found, const grasp::Contact& expected) {
    const double angle = grasp::AngleBetween(found.n, expected.n);
    const bool wrong = reason_ == Reason::kWrongNormal;
    const bool turned = reason_ != Reason::kOffSurface && angle > kSameNormal;
    if (turned) {
      const std::string by = FormatDegrees(Degrees(angle));
      scene_.marks.normals.push_back({Place(found.p), Direction(found.n), false,
                                      wrong ? "given normal, " + by + " off" : "rotated by " + by});
    }
    if (turned || wrong) {
      scene_.marks.normals.push_back(
          {Place(expected.p), Direction(expected.n), true, wrong ? "true normal" : "before"});
    }
  }

  void AddCones() {
    if (!fault_.required) return;
    for (const plan::FingerContact& held : fault_.grasp) {
      const Vector3d apex = Place(held.contact.p);
      if (!IsNear(apex) || scene_.marks.cones.size() > scene_.snapshot.fingers.size()) continue;
      const std::string text = "requires " + FormatRequiredDegrees(Degrees(*fault_.required)) + "°";
      scene_.marks.cones.push_back({apex, Direction(held.contact.n), *fault_.required,
                                    scene_.marks.cones.empty() ? text : ""});
    }
  }

  void AddFingertips() {
    if (fault_.finger_radius <= 0) return;
    for (const plan::FingerContact& held : fault_.grasp) {
      if (std::ranges::find(fault_.fingers, held.finger) == fault_.fingers.end()) continue;
      const Vector3d centre = held.contact.p - fault_.finger_radius * held.contact.n;
      scene_.marks.fingertips.push_back({Place(centre), fault_.finger_radius * scale_});
    }
  }

  /// Add the marks of a hand's failure.
  void AddHand() {
    if (!fault_.hand || !scene_.snapshot.X_WP) return;
    const plan::HandFaultPlace& place = *fault_.hand;
    const Isometry3d& X_WP = *scene_.snapshot.X_WP;
    scene_.marks.links = place.links;
    if (place.tip) {
      // The stretched distance only affects the mark, because the hand is drawn in its true pose.
      const Vector3d expected = X_WP * place.tip->expected;
      const Vector3d away = X_WP * place.tip->found - expected;
      const double stretch = StretchOf(away.norm() / diameter_m(), kFarFromCentroid);
      scene_.marks.dimensions.push_back(
          {expected, expected + stretch * away, place.number + StretchText(stretch)});
      scene_.marks.fingertips.push_back({expected, place.tip->radius});
    } else if (place.at) {
      scene_.marks.spots.push_back({X_WP * *place.at, place.number});
    }
  }

  /// Add the ghost of a moved object, farther away than its former pose if that were invisible.
  void AddMotion() {
    if (!fault_.X_WO_before) return;
    const Isometry3d& now = scene_.snapshot.X_WO;
    const Vector3d back = *fault_.X_WO_before * Centroid() - scene_.marks.centroid;
    const Eigen::AngleAxisd turn =
        object::RotationInWorld(now.linear(), fault_.X_WO_before->linear());
    const double motion = back.norm() / diameter_m() + std::abs(turn.angle()) / 2;
    if (!std::isfinite(motion) || motion > kFarFromCentroid) return;
    const bool of_hand = fault_.hand && fault_.hand->pose;
    if (reason_ != Reason::kObjectMoved && !of_hand && motion < kTooShort) return;
    const double stretch = StretchOf(motion, kFarFromCentroid);
    Isometry3d ghost = Isometry3d::Identity();
    ghost.linear() = Eigen::AngleAxisd(stretch * turn.angle(), turn.axis()).matrix() * now.linear();
    ghost.translation() = scene_.marks.centroid + stretch * back - ghost.linear() * Centroid();
    scene_.marks.X_WO_before = ghost;
    scene_.marks.ghost_text =
        PlaceText() + (of_hand ? ", " + fault_.hand->number : "") + StretchText(stretch, "motion ");
  }

  void LeaveOutWhatIsFar() {
    std::erase_if(scene_.snapshot.fingers, [&](const plan::FingerState& state) {
      return !IsNear(state.contact_W) || !(state.normal_W.norm() > 0);
    });
    for (plan::FingerState& state : scene_.snapshot.fingers) {
      const auto near = [&](const Vector3d& p) { return IsNear(p); };
      if (!std::ranges::all_of(state.path_W, near)) state.path_W.clear();
    }
  }

  const object::Object& object_;
  double scale_;
  Reason reason_;
  const plan::Fault& fault_;
  FaultScene scene_;
};

}  // namespace

FaultScene MakeFaultScene(const object::Object& object, double scale, Reason reason,
                          const plan::Fault& fault, const plan::Snapshot& snapshot,
                          const std::string& heading) {
  return FaultSceneBuilder(object, scale, reason, fault, snapshot, heading).Make();
}

}  // namespace regrasp::render
