#include "planner/kinematics/hand_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/fit_tip.h"
#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;
using collision::ConvexShape;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kWorldBody = 0;
/// Distance in the reference configuration, metres, below which shapes are near by construction.
constexpr double kNearAtRest = 1e-3;
/// Number of points above which shapes are replaced by enclosing ones with fewer points. Largest
/// growth, metres: of the shape itself, and beyond that for planning.
/// Hulls of meshes have thousands of points. They make replays and searches several times slower.
constexpr std::size_t kFewPoints = 32;
constexpr double kShapeTolerance = 5e-5;
constexpr double kEnclosingTolerance = 3e-4;

ConvexShape WithFewerPoints(const ConvexShape& shape, double tolerance) {
  return shape.points.size() <= kFewPoints ? shape : collision::Enclosing(shape, tolerance);
}

/// Builder of a HandModel from a description and a compiled model.
/// All positions are those of the reference configuration, in the palm's frame.
class HandBuilder {
 public:
  HandBuilder(const HandDescription& description, std::string file, const mjModel& model)
      : description_(description),
        file_(std::move(file)),
        model_(model),
        rest_(AtRest(model)),
        palm_(FindBody(description.palm, "/palm")),
        from_world_(PoseAt(rest_->xpos, rest_->xmat, palm_).inverse()) {}

  HandModel Build() {
    hand_.name = description_.name;
    hand_.up = description_.up;
    for (int i = 0; i < static_cast<int>(description_.tips.size()); ++i) AddFinger(i);
    ExpectCoupledJoints();
    for (int geom = 0; geom < model_.ngeom; ++geom) AddGeom(geom);
    for (int i = 0; i < static_cast<int>(hand_.fingers.size()); ++i) AddTipShape(i);
    FindIgnored();
    return std::move(hand_);
  }

 private:
  /// Finger and number of joints that move a body.
  struct Place {
    int finger = -1;
    int after = 0;
  };

  [[noreturn]] void Fail(const std::string& where, const std::string& what) const {
    throw InputError(file_ + ": " + where + ": " + what);
  }

  int FindBody(const std::string& name, const std::string& where) const {
    const int body = mj_name2id(&model_, mjOBJ_BODY, name.c_str());
    if (body > kWorldBody) return body;
    std::string bodies;
    for (int i = 1; i < std::min(model_.nbody, 40); ++i) {
      bodies += (bodies.empty() ? "" : ", ") + BodyName(model_, i);
    }
    Fail(where, "body \"" + name + "\" not found, expected one of " + bodies);
  }
  void AddFinger(int index);
  static void SetTipAxis(Finger& finger);
  void AddJoints(int body, const std::string& where, Vector3d& last, Finger& finger);
  void Couple(const std::string& where, Finger& finger) const;
  void ExpectCoupledJoints() const;
  void SetLimits(const std::string& where, Finger& finger) const;
  bool IsPartOfTip(int geom) const;
  bool IsTipBody(int body) const;
  void AddGeom(int geom);
  void AddTipShape(int index);
  void FindIgnored();
  /// Return the place of the nearest ancestor of a body, itself included, that belongs to a finger;
  /// the palm's if there is none.
  Place PlaceOf(int body) const;
  /// Return the origin of a joint's frame in the reference configuration; that of the palm if
  /// `after` is 0.
  Vector3d OriginAtRest(const Place& place) const {
    return place.after == 0 ? Vector3d(Vector3d::Zero()) : anchors_[place.finger][place.after - 1];
  }

  const HandDescription& description_;
  std::string file_;
  const mjModel& model_;
  DataPtr rest_;
  int palm_;
  Isometry3d from_world_;
  HandModel hand_;
  std::map<int, Place> places_;  ///< places of bodies between the palm and the fingertips
  std::vector<std::vector<Vector3d>> anchors_;  ///< joint positions by finger, at qpos0
};

void HandBuilder::AddFinger(int index) {
  const HandDescription::Tip& tip = description_.tips[index];
  const std::string where = "/fingers/" + std::to_string(index);
  const int tip_body = FindBody(tip.body, where + "/tip/body");
  std::vector<int> bodies;
  for (int body = tip_body; body != palm_; body = model_.body_parentid[body]) {
    if (body == kWorldBody) {
      Fail(where, "body " + tip.body + " must be a descendant of the palm " + description_.palm);
    }
    bodies.push_back(body);
  }
  std::ranges::reverse(bodies);
  Finger finger;
  finger.name = tip.name;
  anchors_.emplace_back();
  Vector3d last = Vector3d::Zero();
  for (const int body : bodies) {
    if (model_.body_jntnum[body] > 0 && places_.contains(body)) {
      Fail(where, "shares joint " + JointName(model_, model_.body_jntadr[body]) + " with finger " +
                      hand_.fingers[places_[body].finger].name + ", expected joints of its own");
    }
    AddJoints(body, where, last, finger);
    places_.try_emplace(body, Place{index, static_cast<int>(finger.joints.size())});
  }
  if (finger.joints.empty())
    Fail(where,
         "expected at least one joint between the palm and body " + tip.body + ", found none");
  if (finger.joints.size() > kMostJoints) {
    Fail(where, "too many joints, expected at most " + std::to_string(kMostJoints) + ", found " +
                    std::to_string(finger.joints.size()));
  }
  Couple(where, finger);
  SetLimits(where, finger);
  const Isometry3d pose = from_world_ * PoseAt(rest_->xpos, rest_->xmat, tip_body);
  finger.tip = {tip.body, pose * tip.centre - last, tip.radius, Vector3d::UnitZ()};
  SetTipAxis(finger);
  hand_.fingers.push_back(std::move(finger));
}

/// Set the pointing direction of a fingertip.
/// The component along the last joint's axis is removed, because the origin of the joint's frame
/// can be anywhere on its axis.
void HandBuilder::SetTipAxis(Finger& finger) {
  const Vector3d& centre = finger.tip.centre;
  const Vector3d& revolute_axis = finger.joints.back().axis;
  const Vector3d across = centre - centre.dot(revolute_axis) * revolute_axis;
  const bool bends = across.norm() > 0.3 * centre.norm();
  if (centre.norm() > 0) finger.tip.axis = (bends ? across : centre).normalized();
}

void HandBuilder::AddJoints(int body, const std::string& where, Vector3d& last, Finger& finger) {
  for (int i = 0; i < model_.body_jntnum[body]; ++i) {
    const int id = model_.body_jntadr[body] + i;
    if (model_.jnt_type[id] != mjJNT_HINGE) {
      Fail(where, "joint " + JointName(model_, id) + " must be a revolute joint");
    }
    if (model_.jnt_limited[id] == 0)
      Fail(where, "joint " + JointName(model_, id) + ": limits not found");
    const Vector3d anchor = from_world_ * VectorAt(rest_->xanchor, id);
    Joint joint;
    joint.name = JointName(model_, id);
    joint.offset = anchor - last;
    joint.axis = (from_world_.linear() * VectorAt(rest_->xaxis, id)).normalized();
    joint.rest = model_.qpos0[model_.jnt_qposadr[id]];
    joint.lower = model_.jnt_range[2 * id];
    joint.upper = model_.jnt_range[2 * id + 1];
    finger.joints.push_back(joint);
    anchors_.back().push_back(anchor);
    last = anchor;
  }
}

void HandBuilder::Couple(const std::string& where, Finger& finger) const {
  const auto find = [&](const std::string& name) {
    return std::ranges::find(finger.joints, name, &Joint::name);
  };
  const auto coupling_of = [&](const Joint& joint) {
    return std::ranges::find(description_.couplings, joint.name, &HandDescription::Coupling::joint);
  };
  for (Joint& joint : finger.joints) {
    if (coupling_of(joint) == description_.couplings.end()) joint.drive = finger.drives++;
  }
  for (Joint& joint : finger.joints) {
    const auto coupling = coupling_of(joint);
    if (coupling == description_.couplings.end()) continue;
    const auto leader = find(coupling->follows);
    if (leader == finger.joints.end() || coupling_of(*leader) != description_.couplings.end()) {
      Fail(where, "joint " + joint.name + " follows \"" + coupling->follows +
                      "\", expected an independent joint of the same finger");
    }
    joint.drive = leader->drive;
    joint.ratio = coupling->ratio;
    joint.coupling_offset = coupling->offset;
    joint.follows = true;
  }
}

/// Check that every coupling has an effect, because a misspelt name would leave a joint uncoupled.
void HandBuilder::ExpectCoupledJoints() const {
  for (std::size_t i = 0; i < description_.couplings.size(); ++i) {
    const std::string& name = description_.couplings[i].joint;
    const std::string where = "/couplings/" + std::to_string(i) + "/joint";
    const bool of_finger = std::ranges::any_of(hand_.fingers, [&](const Finger& finger) {
      return std::ranges::find(finger.joints, name, &Joint::name) != finger.joints.end();
    });
    if (!of_finger) Fail(where, "expected a joint of a finger, found \"" + name + "\"");
    for (std::size_t j = 0; j < i; ++j) {
      if (description_.couplings[j].joint == name)
        Fail(where, "joint " + name + " must be coupled once, found twice");
    }
  }
}

void HandBuilder::SetLimits(const std::string& where, Finger& finger) const {
  constexpr double kTurn = 2 * std::numbers::pi;
  finger.lower = Eigen::VectorXd::Constant(finger.drives, -kTurn);
  finger.upper = Eigen::VectorXd::Constant(finger.drives, kTurn);
  for (const Joint& joint : finger.joints) {
    const double a = DriveAngle(joint, joint.lower);
    const double b = DriveAngle(joint, joint.upper);
    double& lower = finger.lower[joint.drive];
    double& upper = finger.upper[joint.drive];
    lower = std::max(lower, std::min(a, b));
    upper = std::min(upper, std::max(a, b));
    if (!(lower < upper))
      Fail(where, "joint " + joint.name + ": the lower limit must be less than the upper limit");
  }
}

HandBuilder::Place HandBuilder::PlaceOf(int body) const {
  for (; body != kWorldBody; body = model_.body_parentid[body]) {
    const auto found = places_.find(body);
    if (found != places_.end()) return found->second;
  }
  return {};
}

bool HandBuilder::IsPartOfTip(int geom) const {
  return std::ranges::any_of(description_.tips, [&](const HandDescription::Tip& tip) {
    const int body = mj_name2id(&model_, mjOBJ_BODY, tip.body.c_str());
    return IsPartOfFingertip(model_, *rest_, geom, body, {tip.centre, tip.radius});
  });
}

bool HandBuilder::IsTipBody(int body) const {
  return std::ranges::any_of(description_.tips, [&](const HandDescription::Tip& tip) {
    return mj_name2id(&model_, mjOBJ_BODY, tip.body.c_str()) == body;
  });
}

void HandBuilder::AddGeom(int geom) {
  const int body = model_.geom_bodyid[geom];
  if (!Collides(model_, geom)) return;
  // The geom belongs to another kinematic tree, such as a table.
  if (model_.body_rootid[body] != model_.body_rootid[palm_]) return;
  const bool is_covered = IsPartOfTip(geom);
  // A marker inside a fingertip sphere adds nothing to it.
  if (is_covered && !IsTipBody(body)) return;
  ConvexShape shape = ShapeOfGeom(model_, geom);
  if (shape.points.empty()) return;
  const Place place = PlaceOf(body);
  Isometry3d pose = from_world_ * PoseAt(rest_->geom_xpos, rest_->geom_xmat, geom);
  pose.translation() -= OriginAtRest(place);
  LinkShape link;
  link.link = BodyName(model_, body);
  link.after = place.after;
  link.shape = WithFewerPoints(Moved(pose, shape), kShapeTolerance);
  link.enclosing = WithFewerPoints(link.shape, kEnclosingTolerance);
  if (is_covered) link.role = LinkShape::Role::kCovered;
  (place.after == 0 ? hand_.palm : hand_.fingers[place.finger].shapes).push_back(std::move(link));
}

void HandBuilder::AddTipShape(int index) {
  Finger& finger = hand_.fingers[index];
  const int after = static_cast<int>(finger.joints.size());
  const int body = FindBody(finger.tip.body, "/fingers");
  const Vector3d origin = from_world_ * VectorAt(rest_->xpos, body) - OriginAtRest({index, after});
  ConvexShape capsule{{finger.tip.centre}, finger.tip.radius};
  if (!origin.isApprox(finger.tip.centre)) capsule.points.push_back(origin);
  finger.shapes.push_back({finger.tip.body, after, LinkShape::Role::kTip, capsule, capsule});
}

/// Ignore pairs of adjacent links, and pairs that are near each other in the reference
/// configuration.
void HandBuilder::FindIgnored() {
  struct Placed {
    HandModel::Part part;
    int after;
    ConvexShape shape;
  };
  std::vector<Placed> all;
  const auto add = [&](int finger, const std::vector<LinkShape>& shapes) {
    for (int i = 0; i < static_cast<int>(shapes.size()); ++i) {
      Isometry3d pose = Isometry3d::Identity();
      pose.translation() = OriginAtRest({finger, shapes[i].after});
      all.push_back({{finger < 0 ? FingerIndex{} : FingerIndex(finger), i},
                     shapes[i].after,
                     Moved(pose, shapes[i].shape)});
    }
  };
  add(-1, hand_.palm);
  for (int i = 0; i < static_cast<int>(hand_.fingers.size()); ++i) add(i, hand_.fingers[i].shapes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const Placed& a = all[i];
      const Placed& b = all[j];
      const bool same_chain =
          a.part.finger == b.part.finger || !a.part.finger.valid() || !b.part.finger.valid();
      const bool neighbours = same_chain && std::abs(a.after - b.after) <= 1;
      if (neighbours || !AreApart(a.shape, b.shape, kNearAtRest)) {
        hand_.ignored.emplace_back(a.part, b.part);
      }
    }
  }
  std::ranges::sort(hand_.ignored);
}

/// Return the digest of the description, of all model files and of all meshes: a hash of their
/// concatenated hashes.
std::string Digest(const std::string& description, const ModelText& model) {
  std::string digests = Sha256(description);
  for (const fs::path& file : model.files) digests += Sha256(ReadFile(file));
  for (const MeshFile& mesh : model.meshes) digests += Sha256(ReadFile(mesh.path));
  return Sha256(digests);
}

}  // namespace

HandModel BuildHand(const HandDescription& description, const CompiledModel& compiled,
                    const std::string& file) {
  CheckPhysics(compiled);
  HandModel hand = HandBuilder(description, file, *compiled.model).Build();
  CheckCouplings(hand, description.palm, compiled, file);
  CheckCollisionGeoms(description, compiled, file);
  return hand;
}

HandFile ReadHandFile(const fs::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".xml" || ending == ".urdf" || ending == ".mjcf" || ending == ".xacro") {
    throw InputError(path.string() + ": expected a hand file, found a model; help: hand --model " +
                     path.string() + " --output hand.json");
  }
  const std::string text = ReadFile(path);
  HandFile file;
  file.description = ParseHandDescription(text, path.string());
  file.compiled = std::make_shared<const CompiledModel>(
      CompileModel(path.parent_path() / file.description.model));
  file.hand = BuildHand(file.description, *file.compiled, path.string());
  file.hand.file = path.filename().string();
  file.hand.sha256 = Digest(text, file.compiled->text);
  file.warnings = ActuationWarnings(file.hand, *file.compiled);
  return file;
}

std::vector<fs::path> FilesOfHand(const fs::path& path) {
  try {
    const HandDescription description = ParseHandDescription(ReadFile(path), path.string());
    const ModelText model = ReadModelText(path.parent_path() / description.model);
    std::vector<fs::path> files = model.files;
    for (const MeshFile& mesh : model.meshes) files.push_back(mesh.path);
    return files;
  } catch (const InputError&) {
    return {};
  }
}

HandModel ReadHand(const fs::path& path) { return ReadHandFile(path).hand; }

HandFile HandOfPlan(HandFile file, const plan::Plan& plan) {
  if (plan.hand && plan.hand->up) SetUp(*plan.hand->up, file.hand);
  return file;
}

}  // namespace regrasp::kinematics
