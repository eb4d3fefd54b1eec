#include "render/frames/fault_picture.h"

#include <algorithm>
#include <cmath>

#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp::render {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::Reason;

// In diameters of the object.
constexpr double kTooShort = 0.03;        ///< a distance that is hardly seen is drawn …
constexpr double kLeastSeen = 0.05;       ///< as long as this …
constexpr double kMostSeen = 0.35;        ///< and a longer one, to a place off the surface, so
constexpr double kFarFromCentroid = 1.5;  ///< from the centroid: not drawn

/// Lengths are not drawn longer than by this factor: what is left is as good as zero.
constexpr double kMostStretch = 2000;

/// A contact of the replay is this near to the surface, in diameters, where it has not lost it.
constexpr double kTouches = 0.02;

constexpr int kFactorDigits = 2;

/// Normals that differ by less look the same.
constexpr double kSameNormal = Radians(0.05);

/// By what a length is multiplied so that it can be seen.
double StretchOf(double length, double most) {
  if (!(length > kLeastSeen / kMostStretch)) return 1;
  if (length < kTooShort) return kLeastSeen / length;
  return length > most ? most / length : 1;
}

/// "", " (drawn × 40)", " (drawn shorter)".
std::string StretchText(double factor, const std::string& what = "") {
  if (factor == 1) return "";
  if (factor < 1) return " (" + what + "drawn shorter)";
  return " (" + what + "drawn × " + FormatPlain(factor, kFactorDigits) + ")";
}

/// Whether the finger, rather than the place where it should be, is drawn elsewhere: the surface
/// stays where it is.
bool IsOffSurface(Reason reason) {
  return reason == Reason::kOffSurface || reason == Reason::kContactLost;
}

class FaultSketch {
 public:
  FaultSketch(const object::Object& object, double scale, Reason reason, const plan::Fault& fault,
              const plan::Snapshot& snapshot, const std::string& heading)
      : object_(object), scale_(scale), reason_(reason), fault_(fault) {
    picture_.snapshot = snapshot;
    picture_.marks.heading = heading;
    picture_.marks.fingers = fault.fingers;
    picture_.marks.planar = object.dimension() == 2;
    picture_.marks.centroid = snapshot.X_WO * Centroid();
  }

  FaultPicture Make() {
    PutOnSurface();
    if (fault_.found && fault_.expected.size() == 1) {
      AddMisplaced(*fault_.found, fault_.expected.front());
    } else {
      for (const grasp::Contact& contact : fault_.expected) AddPlace(contact, PlaceText());
    }
    AddCones();
    AddTips();
    AddHand();
    AddMotion();
    picture_.marks.push = fault_.push;
    LeaveOutWhatIsFar();
    return picture_;
  }

 private:
  [[nodiscard]] Vector3d Centroid() const { return scale_ * object_.mass_properties().centroid; }
  [[nodiscard]] double diameter_m() const { return scale_ * object_.diameter(); }
  [[nodiscard]] Vector3d Place(const Vector3d& p_O) const {
    return picture_.snapshot.X_WO * (scale_ * p_O);
  }
  [[nodiscard]] Vector3d Direction(const Vector3d& n_O) const {
    return picture_.snapshot.X_WO.linear() * n_O.stableNormalized();
  }
  [[nodiscard]] bool IsNear(const Vector3d& p_W) const {
    return (p_W - picture_.marks.centroid).stableNorm() <= kFarFromCentroid * diameter_m();
  }

  [[nodiscard]] std::string PlaceText() const {
    if (reason_ == Reason::kStartDiffers) return "start";
    if (reason_ == Reason::kGoalNotReached) return "goal";
    if (reason_ == Reason::kObjectMoved && fault_.hand) return "planned here";
    return "was here";
  }

  /// Whether the finger is off the surface, or may be, as it is given.
  [[nodiscard]] bool IsOff(FingerIndex finger) const {
    if (reason_ == Reason::kOffSurface) return true;
    return reason_ == Reason::kContactLost && finger == fault_.fingers.front();
  }

  /// Contacts that slipped over an edge, or into the surface, are drawn on it: a ball inside would
  /// not be seen.
  void PutOnSurface() {
    const Isometry3d X_OW = picture_.snapshot.X_WO.inverse();
    for (plan::FingerState& state : picture_.snapshot.fingers) {
      if (!IsNear(state.contact_W) || IsOff(state.finger)) continue;
      const Vector3d p_O = X_OW * state.contact_W / scale_;
      const auto faces = object_.FacesNear(p_O, kTouches * object_.diameter());
      if (!faces.empty()) state.contact_W = Place(object_.ClosestPoint(faces.front(), p_O));
    }
  }

  void AddPlace(const grasp::Contact& contact, const std::string& text) {
    const Vector3d at = Place(contact.p);
    if (IsNear(at)) picture_.marks.places.push_back({at, Direction(contact.n), text});
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
      picture_.marks.dimensions.push_back({Place(expected_O), Place(found_O),
                                           FormatLength(distance * scale_) + StretchText(stretch)});
    }
    if (off) MoveFinger(found_O);
    if (reason_ == Reason::kWrongNormal) StandFinger(expected);
    if (seen && !off && reason_ != Reason::kWrongNormal) {
      AddPlace({expected_O, expected.n}, reason_ == Reason::kFingerNotFree ? "holds" : "was here");
    }
    AddNormals({found_O, found.n}, {expected_O, expected.n});
  }

  /// The finger at fault is drawn there.
  void MoveFinger(const Vector3d& p_O) {
    const grasp::Contact& found = *fault_.found;
    for (plan::FingerState& state : picture_.snapshot.fingers) {
      if (state.finger != fault_.fingers.front()) continue;
      // A finger may be named twice: the other one is where it is.
      const bool same = reason_ == Reason::kContactLost ||
                        (state.contact_W - Place(found.p)).stableNorm() <=
                            object::kPointTolerance * diameter_m() ||
                        !IsNear(state.contact_W);
      if (!same) continue;
      state.contact_W = Place(p_O);
      state.tip_W = state.contact_W - picture_.snapshot.fingertip_radius_m * state.normal_W;
    }
  }

  /// The finger at fault stands on the outside, whatever its normal says.
  void StandFinger(const grasp::Contact& expected) {
    for (plan::FingerState& state : picture_.snapshot.fingers) {
      if (state.finger != fault_.fingers.front()) continue;
      state.normal_W = Direction(expected.n);
      state.tip_W = state.contact_W - picture_.snapshot.fingertip_radius_m * state.normal_W;
    }
  }

  void AddNormals(const grasp::Contact& found, const grasp::Contact& expected) {
    const double angle = grasp::AngleBetween(found.n, expected.n);
    const bool wrong = reason_ == Reason::kWrongNormal;
    const bool turned = reason_ != Reason::kOffSurface && angle > kSameNormal;
    if (turned) {
      const std::string by = FormatDegrees(Degrees(angle));
      picture_.marks.normals.push_back({Place(found.p), Direction(found.n), false,
                                        wrong ? "given, " + by + " off" : "turned by " + by});
    }
    if (turned || wrong) {
      picture_.marks.normals.push_back(
          {Place(expected.p), Direction(expected.n), true, wrong ? "true normal" : "before"});
    }
  }

  void AddCones() {
    if (!fault_.required) return;
    for (const plan::FingerContact& held : fault_.grasp) {
      const Vector3d apex = Place(held.contact.p);
      if (!IsNear(apex) || picture_.marks.cones.size() > picture_.snapshot.fingers.size()) continue;
      const std::string text = "needs " + FormatRequiredDegrees(Degrees(*fault_.required)) + "°";
      picture_.marks.cones.push_back({apex, Direction(held.contact.n), *fault_.required,
                                      picture_.marks.cones.empty() ? text : ""});
    }
  }

  void AddTips() {
    if (fault_.finger_radius <= 0) return;
    for (const plan::FingerContact& held : fault_.grasp) {
      if (std::ranges::find(fault_.fingers, held.finger) == fault_.fingers.end()) continue;
      const Vector3d centre = held.contact.p - fault_.finger_radius * held.contact.n;
      picture_.marks.tips.push_back({Place(centre), fault_.finger_radius * scale_});
    }
  }

  /// A plan's hand, where it fails.
  void AddHand() {
    if (!fault_.hand || !picture_.snapshot.X_WP) return;
    const plan::HandFaultPlace& place = *fault_.hand;
    const Isometry3d& X_WP = *picture_.snapshot.X_WP;
    picture_.marks.links = place.links;
    if (place.tip) {
      // As far off as it can be seen: the hand is drawn as it stands.
      const Vector3d expected = X_WP * place.tip->expected;
      const Vector3d away = X_WP * place.tip->found - expected;
      const double stretch = StretchOf(away.norm() / diameter_m(), kFarFromCentroid);
      picture_.marks.dimensions.push_back(
          {expected, expected + stretch * away, place.number + StretchText(stretch)});
      picture_.marks.tips.push_back({expected, place.tip->radius});
    } else if (place.at) {
      picture_.marks.spots.push_back({X_WP * *place.at, place.number});
    }
  }

  /// The ghost is farther back than the object was, where that would not be seen.
  void AddMotion() {
    if (!fault_.X_WO_before) return;
    const Isometry3d& now = picture_.snapshot.X_WO;
    const Vector3d back = *fault_.X_WO_before * Centroid() - picture_.marks.centroid;
    const Eigen::AngleAxisd turn(fault_.X_WO_before->linear() * now.linear().transpose());
    const double motion = back.norm() / diameter_m() + std::abs(turn.angle()) / 2;
    if (!std::isfinite(motion) || motion > kFarFromCentroid) return;
    const bool of_hand = fault_.hand && fault_.hand->pose;
    if (reason_ != Reason::kObjectMoved && !of_hand && motion < kTooShort) return;
    const double stretch = StretchOf(motion, kFarFromCentroid);
    Isometry3d ghost = Isometry3d::Identity();
    ghost.linear() = Eigen::AngleAxisd(stretch * turn.angle(), turn.axis()).matrix() * now.linear();
    ghost.translation() = picture_.marks.centroid + stretch * back - ghost.linear() * Centroid();
    picture_.marks.X_WO_before = ghost;
    picture_.marks.ghost_text =
        PlaceText() + (of_hand ? ", " + fault_.hand->number : "") + StretchText(stretch, "motion ");
  }

  void LeaveOutWhatIsFar() {
    std::erase_if(picture_.snapshot.fingers, [&](const plan::FingerState& state) {
      return !IsNear(state.contact_W) || !(state.normal_W.norm() > 0);
    });
    for (plan::FingerState& state : picture_.snapshot.fingers) {
      const auto near = [&](const Vector3d& p) { return IsNear(p); };
      if (!std::ranges::all_of(state.path_W, near)) state.path_W.clear();
    }
  }

  const object::Object& object_;
  double scale_;
  Reason reason_;
  const plan::Fault& fault_;
  FaultPicture picture_;
};

}  // namespace

FaultPicture MakeFaultPicture(const object::Object& object, double scale, Reason reason,
                              const plan::Fault& fault, const plan::Snapshot& snapshot,
                              const std::string& heading) {
  return FaultSketch(object, scale, reason, fault, snapshot, heading).Make();
}

}  // namespace regrasp::render
