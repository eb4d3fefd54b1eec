#include "planner/kinematics/derive_hand.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/fit_tip.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

using collision::ConvexShape;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kWorld = 0;
constexpr std::size_t kFewestDerived = 3;
/// Difference in reach, metres, within which geoms count as equally far. Among them a sphere or
/// capsule is preferred.
constexpr double kEndsAlike = 2e-3;
/// Gap between sphere and fingertip, metres, beyond which the sphere is doubtful.
constexpr double kDoubtfulGap = 1.5e-3;
/// Radius of the bounding sphere, metres, below which a geom is a marker and not a fingertip.
constexpr double kMarkerRadius = 1e-3;
/// The same, relative to the largest bounding sphere of the link's geoms.
constexpr double kMarkerShare = 0.125;
constexpr double kSnap = 10 * std::numbers::pi / 180;
constexpr double kSameWay = 45 * std::numbers::pi / 180;

struct TipBody {
  int body = 0;  ///< first body of the link until the geom is chosen, then the geom's body
  std::vector<int> joints;  ///< joints from the palm
};

class HandDeriver {
 public:
  HandDeriver(const CompiledModel& compiled, std::string file)
      : compiled_(compiled),
        model_(*compiled.model),
        file_(std::move(file)),
        rest_(AtRest(model_)) {}

  DerivedHand Derive() {
    HandDescription& description = derived_.description;
    description.name = model_.names;  // the name of the model is the first of its names
    FindTips();
    description.palm = BodyName(model_, palm_);
    from_world_ = PoseAt(rest_->xpos, rest_->xmat, palm_).inverse();
    for (TipBody& tip : tips_) AddTip(tip);
    if (!not_round_.empty()) {
      Note("fingertips that are not spherical, with the depth of the sphere inside: " + not_round_);
    }
    NameFingers();
    description.up = Up();
    std::vector<std::vector<int>> joints;
    for (const TipBody& tip : tips_) joints.push_back(tip.joints);
    description.couplings = DeriveCouplings(compiled_, joints, derived_.notes);
    NoteUnchecked();
    return std::move(derived_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const { throw InputError(file_ + ": " + what); }
  void Note(const std::string& note) { derived_.notes.push_back(note); }

  void FindTips();
  std::vector<int> LeavesOfLargestTree() const;
  int LowestCommonAncestor(const std::vector<int>& bodies) const;
  void AddTip(TipBody& tip);
  FittedBall Fit(const std::string& name, const ConvexShape& shape,
                 const TipDirections& directions);
  int TipGeom(int link, const Vector3d& anchor) const;
  void NameFingers();
  std::string NameOfTip(int body) const;
  Vector3d Up();
  Vector3d Snapped(const Vector3d& direction) const;
  void NoteUnchecked();
  Isometry3d GeomPose(int geom) const {
    return from_world_ * PoseAt(rest_->geom_xpos, rest_->geom_xmat, geom);
  }

  const CompiledModel& compiled_;
  const mjModel& model_;
  std::string file_;
  DataPtr rest_;
  int palm_ = kWorld;
  Isometry3d from_world_ = Isometry3d::Identity();
  std::vector<TipBody> tips_;
  std::vector<Vector3d> pads_;    ///< pad direction by finger, in the palm's frame, or zero
  std::vector<Vector3d> points_;  ///< pointing direction by finger, in the palm's frame
  std::string not_round_;
  DerivedHand derived_;
};

/// Return the outermost colliding links of the kinematic tree that has most of them.
/// Each link is given by its first body; no colliding link is below it.
std::vector<int> HandDeriver::LeavesOfLargestTree() const {
  std::set<int> colliding;
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    if (Collides(model_, geom)) colliding.insert(LinkOf(model_, model_.geom_bodyid[geom]));
  }
  std::set<int> inner;
  for (int link : colliding) {
    while (link != kWorld) inner.insert(link = LinkOf(model_, model_.body_parentid[link]));
  }
  std::map<int, std::vector<int>> leaves;
  for (const int link : colliding) {
    if (link != kWorld && !inner.contains(link)) leaves[model_.body_rootid[link]].push_back(link);
  }
  std::vector<int> most;
  for (const auto& [root, bodies] : leaves) {
    if (bodies.size() > most.size()) most = bodies;
  }
  return most;
}

int HandDeriver::LowestCommonAncestor(const std::vector<int>& bodies) const {
  int ancestor = bodies.front();
  for (int body : bodies) {
    // The index of a body is larger than that of its parent.
    while (body != ancestor) {
      (body > ancestor ? body : ancestor) = model_.body_parentid[std::max(body, ancestor)];
    }
  }
  return ancestor;
}

void HandDeriver::FindTips() {
  std::vector<int> leaves = LeavesOfLargestTree();
  // A body that does not move relative to the palm is not a finger. Without it the palm can be
  // lower in the tree.
  for (bool changed = true; changed && !leaves.empty();) {
    palm_ = LowestCommonAncestor(leaves);
    changed = std::erase_if(
                  leaves, [&](int body) { return JointsBetween(model_, palm_, body).empty(); }) > 0;
  }
  for (const int body : leaves) tips_.push_back({body, JointsBetween(model_, palm_, body)});
  std::ranges::stable_sort(tips_, std::ranges::greater(),
                           [](const TipBody& tip) { return tip.joints.size(); });
  std::set<int> taken;
  std::erase_if(tips_, [&](const TipBody& tip) {
    for (const int joint : tip.joints) {
      if (!taken.contains(joint)) continue;
      Note("body " + BodyName(model_, tip.body) + " is not used as a fingertip: it shares joint " +
           JointName(model_, joint) + " with a finger");
      return true;
    }
    taken.insert(tip.joints.begin(), tip.joints.end());
    return false;
  });
  std::ranges::sort(tips_, {}, &TipBody::body);
  if (tips_.size() < kFewestDerived) {
    Fail("found " + std::to_string(tips_.size()) +
         " fingers below a common body, expected at least 3 chains of joints from one body, the "
         "palm, to links that collide");
  }
}

/// Return the geom of a link that reaches farthest from the last joint.
/// Among geoms with equal reach the largest sphere or capsule is used. Markers are used only if
/// there is no other geom.
int HandDeriver::TipGeom(int link, const Vector3d& anchor) const {
  struct End {
    int geom;
    double reach;   ///< distance of its farthest point from the joint
    double radius;  ///< radius of a sphere or capsule, otherwise 0
    double around;  ///< radius of the bounding sphere
  };
  std::vector<End> ends;
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    const bool of_link = LinkOf(model_, model_.geom_bodyid[geom]) == link;
    if (!of_link || !Collides(model_, geom)) continue;
    const ConvexShape shape = Moved(GeomPose(geom), ShapeOfGeom(model_, geom));
    if (shape.points.empty()) continue;
    double end = 0;
    for (const Vector3d& point : shape.points) end = std::max(end, (point - anchor).norm());
    ends.push_back(
        {geom, end + shape.radius, shape.radius, collision::BoundingSphereOf(shape).radius});
  }
  if (ends.empty()) Fail("body " + BodyName(model_, link) + ": convex collision geom not found");
  const double largest = std::ranges::max_element(ends, {}, &End::around)->around;
  if (largest >= kMarkerRadius) {
    const double least = std::max(kMarkerRadius, kMarkerShare * largest);
    std::erase_if(ends, [&](const End& end) { return end.around < least; });
  }
  const double farthest = std::ranges::max_element(ends, {}, &End::reach)->reach;
  std::erase_if(ends, [&](const End& end) { return end.reach < farthest - kEndsAlike; });
  const bool has_round = std::ranges::any_of(ends, [](const End& end) { return end.radius > 0; });
  return std::ranges::max_element(ends, {}, has_round ? &End::radius : &End::reach)->geom;
}

void HandDeriver::AddTip(TipBody& tip) {
  const int joint = tip.joints.back();
  const Vector3d anchor = from_world_ * VectorAt(rest_->xanchor, joint);
  const Vector3d revolute_axis =
      (from_world_.linear() * VectorAt(rest_->xaxis, joint)).normalized();
  const int geom = TipGeom(tip.body, anchor);
  tip.body = model_.geom_bodyid[geom];
  const ConvexShape shape = Moved(GeomPose(geom), ShapeOfGeom(model_, geom));
  // The mean direction of the farthest tenth of the geom, perpendicular to the joint's axis. The
  // component along the axis is meaningless because a joint's anchor can be anywhere on its axis.
  double farthest = 0;
  for (const Vector3d& point : shape.points) farthest = std::max(farthest, (point - anchor).norm());
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : shape.points) {
    if ((point - anchor).norm() >= 0.9 * farthest) middle += (point - anchor).normalized();
  }
  TipDirections directions;
  const Vector3d across = middle - middle.dot(revolute_axis) * revolute_axis;
  const bool bends = across.norm() > 0.3 * middle.norm();
  directions.far = (bends ? across : middle).normalized();
  const double flexion = model_.jnt_range[2 * joint] + model_.jnt_range[2 * joint + 1] < 0 ? -1 : 1;
  if (bends) directions.pad = flexion * revolute_axis.cross(directions.far).normalized();
  points_.push_back(directions.far);
  pads_.push_back(directions.pad);
  const std::string name = BodyName(model_, tip.body);
  const FittedBall fitted = Fit(name, shape, directions);
  const Isometry3d body = from_world_ * PoseAt(rest_->xpos, rest_->xmat, tip.body);
  // A resolution of 1 µm suffices for a fitted sphere.
  const auto rounded = [](double length) { return std::round(1e6 * length) / 1e6 + 0.0; };
  const Vector3d centre = (body.inverse() * fitted.ball.centre).unaryExpr(rounded);
  derived_.description.tips.push_back({name, name, centre, rounded(fitted.ball.radius)});
  if (fitted.ball.radius < kMarkerRadius) {
    Note("the fingertip sphere of body " + name + " has a radius of " +
         FormatShort(1e3 * fitted.ball.radius) + " mm: implausible");
  }
}

FittedBall HandDeriver::Fit(const std::string& name, const ConvexShape& shape,
                            const TipDirections& directions) {
  FittedBall fitted;
  try {
    fitted = FitTip(shape, directions);
  } catch (const std::runtime_error&) {
    Fail("body " + name + ": no sphere fits into its end, which is flat");
  }
  const double gap = std::max(fitted.short_of_far, fitted.short_of_pad);
  if (gap > kDoubtfulGap) {
    if (!not_round_.empty()) not_round_ += ", ";
    not_round_ += name + " (" + FormatFixed(1e3 * gap, 1) + " mm)";
  }
  return fitted;
}

/// Return the name of a fingertip: the name of its body, or of a link without geoms fixed to the
/// body, which only marks its end.
std::string HandDeriver::NameOfTip(int body) const {
  int last = body;
  for (int below = body + 1; below < model_.nbody; ++below) {
    if (model_.body_parentid[below] != last || model_.body_jntnum[below] > 0) continue;
    if (model_.body_geomnum[below] > 0) continue;
    last = below;
  }
  return BodyName(model_, last);
}

bool IsSeparator(char c) { return c == '_' || c == '/' || c == '-' || c == '.' || c == ' '; }

/// Return the length of the common prefix of all names, up to a separator.
std::size_t CommonStart(const std::vector<std::string>& names) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < names[0].size(); ++i) {
    const auto differs = [&](const std::string& name) {
      return i >= name.size() || name[i] != names[0][i];
    };
    if (std::ranges::any_of(names, differs)) break;
    if (IsSeparator(names[0][i])) length = i + 1;
  }
  return length;
}

/// Remove words that mean "fingertip" from the end of a name. The result can be empty.
std::string WithoutEnding(std::string name) {
  constexpr std::array kEndings = {"fingertip", "distal", "tip", "head", "link", "dist", "ds"};
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::string ending : kEndings) {
      if (!name.ends_with(ending)) continue;
      name.resize(name.size() - ending.size());
      changed = true;
    }
    while (!name.empty() && IsSeparator(name.back())) name.pop_back();
  }
  return name;
}

/// Name the fingers by their bodies, without the common prefix and without words for fingertips.
void HandDeriver::NameFingers() {
  std::vector<std::string> names;
  for (const TipBody& tip : tips_) names.push_back(NameOfTip(tip.body));
  const auto are_good = [](const std::vector<std::string>& shortened) {
    return std::set(shortened.begin(), shortened.end()).size() == shortened.size() &&
           std::ranges::all_of(shortened, [](const std::string& name) {
             return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
           });
  };
  for (const std::size_t start : {CommonStart(names), std::size_t{0}}) {
    std::vector<std::string> shortened;
    for (const std::string& name : names) shortened.push_back(WithoutEnding(name.substr(start)));
    if (!are_good(shortened)) continue;
    names = shortened;
    break;
  }
  for (std::size_t i = 0; i < names.size(); ++i) derived_.description.tips[i].name = names[i];
}

/// Return the nearest axis of the palm's frame if it is within kSnap, otherwise the direction
/// itself.
Vector3d HandDeriver::Snapped(const Vector3d& direction) const {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const Vector3d snapped = std::copysign(1.0, direction[axis]) * Vector3d::Unit(axis);
  return snapped.dot(direction) >= std::cos(kSnap) ? snapped : direction;
}

Vector3d HandDeriver::Up() {
  // The largest group of pads with similar directions determines the direction.
  Vector3d sum = Vector3d::Zero();
  int most = 0;
  for (const Vector3d& pad : pads_) {
    Vector3d together = Vector3d::Zero();
    int count = 0;
    for (const Vector3d& other : pads_) {
      if (pad.dot(other) < std::cos(kSameWay)) continue;
      together += other;
      ++count;
    }
    if (count <= most) continue;
    most = count;
    sum = together;
  }
  const int fingers = static_cast<int>(pads_.size());
  if (3 * most <= 2 * fingers) {
    sum.setZero();
    for (const Vector3d& point : points_) sum += point;
    if (sum.norm() < 0.5 * fingers) {
      Note("up is uncertain: the fingers neither flex nor point in one direction");
    }
  }
  if (!(sum.norm() > 1e-6)) return Vector3d::UnitZ();
  const Vector3d up = Snapped(sum.normalized());
  if ((up.array() != 0).count() > 1) Note("up is uncertain: it is not an axis of the palm frame");
  return up;
}

/// Note links whose geoms all do not collide.
void HandDeriver::NoteUnchecked() {
  std::set<int> links;
  for (const TipBody& tip : tips_) {
    for (const int joint : tip.joints) links.insert(model_.jnt_bodyid[joint]);
  }
  std::map<int, bool> collides;
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    const int link = LinkOf(model_, model_.geom_bodyid[geom]);
    if (links.contains(link)) collides[link] = collides[link] || Collides(model_, geom);
  }
  std::string names;
  for (const auto& [link, any] : collides) {
    if (!any) names += (names.empty() ? "" : ", ") + BodyName(model_, link);
  }
  if (!names.empty())
    Note("links without a colliding geom, excluded from collision checks: " + names);
}

}  // namespace

DerivedHand DeriveHand(const CompiledModel& compiled, const std::string& file) {
  return HandDeriver(compiled, file).Derive();
}

}  // namespace regrasp::kinematics
