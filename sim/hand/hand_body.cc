#include "sim/hand/hand_body.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "planner/kinematics/fit_tip.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::sim {
namespace {

std::string NameOfJoint(const mjModel& model, int joint) {
  const char* name = mj_id2name(&model, mjOBJ_JOINT, joint);
  return name != nullptr ? name : std::to_string(joint);
}

}  // namespace

CouplingResiduals::CouplingResiduals(const kinematics::HandFile& file)
    : model_(*file.compiled->model) {
  AddEqualities();
  for (const kinematics::Mimic& mimic : file.compiled->text.mimics) {
    AddRelation(mimic.joint, mimic.follows, mimic.multiplier, mimic.offset,
                "<mimic> of joint " + mimic.joint);
  }
  for (const auto& coupling : file.description.couplings) {
    AddRelation(coupling.joint, coupling.follows, coupling.ratio, coupling.offset,
                "coupling of joint " + coupling.joint + " in the hand's file");
  }
}

void CouplingResiduals::AddRelation(const std::string& joint, const std::string& leader,
                                    double ratio, double offset, const std::string& source) {
  const int follower = mj_name2id(&model_, mjOBJ_JOINT, joint.c_str());
  const int other = mj_name2id(&model_, mjOBJ_JOINT, leader.c_str());
  if (follower < 0 || other < 0) return;
  equations_.push_back({{{follower, 1}, {other, -ratio}}, offset, source});
}

void CouplingResiduals::AddTendon(int tendon, double factor, Equation& equation) const {
  for (int i = 0; i < model_.tendon_num[tendon]; ++i) {
    const int wrap = model_.tendon_adr[tendon] + i;
    const int joint = model_.wrap_objid[wrap];
    const double coefficient = factor * model_.wrap_prm[wrap];
    equation.terms.push_back({joint, coefficient});
    equation.constant += coefficient * model_.qpos0[model_.jnt_qposadr[joint]];
  }
}

/// Add constraints relative to the positions of the reference configuration.
/// The hand reader rejects nonlinear terms, spatial tendons and loops.
void CouplingResiduals::AddEqualities() {
  const auto is_fixed = [&](int tendon) {
    return model_.wrap_type[model_.tendon_adr[tendon]] == mjWRAP_JOINT;
  };
  for (int i = 0; i < model_.neq; ++i) {
    if (model_.eq_active[i] == 0) continue;
    const mjtNum* polynomial = model_.eq_data + std::ptrdiff_t{mjNEQDATA} * i;
    const int first = model_.eq_obj1id[i];
    const int second = model_.eq_obj2id[i];
    Equation equation{{}, polynomial[0], ""};
    if (model_.eq_type[i] == mjEQ_JOINT) {
      equation.source = "equality constraint of joint " + NameOfJoint(model_, first);
      for (const auto& [joint, factor] : {std::pair(first, 1.0), {second, -polynomial[1]}}) {
        if (joint < 0) continue;
        equation.terms.push_back({joint, factor});
        equation.constant += factor * model_.qpos0[model_.jnt_qposadr[joint]];
      }
    } else if (model_.eq_type[i] == mjEQ_TENDON && is_fixed(first) &&
               (second < 0 || is_fixed(second))) {
      equation.source = "equality constraint of a tendon";
      AddTendon(first, 1, equation);
      if (second >= 0) AddTendon(second, -polynomial[1], equation);
    } else {
      continue;
    }
    equations_.push_back(std::move(equation));
  }
}

CouplingResiduals::Residual CouplingResiduals::Largest(const mjData& data) const {
  Residual largest;
  for (const Equation& equation : equations_) {
    double off = -equation.constant;
    for (const Term& term : equation.terms) {
      off += term.coefficient * data.qpos[model_.jnt_qposadr[term.joint]];
    }
    const double radians = std::abs(off / equation.terms.front().coefficient);
    if (largest.joint >= 0 && radians <= largest.radians) continue;
    largest = {equation.terms.front().joint, radians, equation.source};
  }
  return largest;
}

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Role = HandPart::Role;

constexpr double kNearAtRest = 1e-3;

Isometry3d PoseOf(const mjtNum* position, const mjtNum* matrix) {
  Isometry3d pose = Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    pose.translation()[row] = position[row];
    for (int column = 0; column < 3; ++column) {
      pose.linear()(row, column) = matrix[3 * row + column];
    }
  }
  return pose;
}

}  // namespace

struct HandBody::Impl {
  /// Points of a shape in the frame of its body.
  struct Shape {
    int body;
    std::vector<Vector3d> points;
    double radius;
  };

  explicit Impl(const kinematics::HandFile& file)
      : compiled(file.compiled),
        hand(file.hand),
        description(file.description),
        model(compiled->model.get()),
        couplings(file) {}

  std::shared_ptr<const kinematics::CompiledModel> compiled;
  kinematics::HandModel hand;
  kinematics::HandDescription description;
  const mjModel* model;
  kinematics::DataPtr data;
  int palm = 0;
  std::vector<std::vector<int>> joint_ids;  ///< joint of the model [finger][joint]
  std::vector<int> tip_bodies;
  std::vector<HandPart> parts;
  std::vector<Shape> shapes;                ///< shapes [part]
  std::vector<std::vector<double>> levers;  ///< moment arms [part][joint]
  std::set<std::pair<int, int>> may_touch;
  CouplingResiduals couplings;

  [[nodiscard]] Isometry3d BodyPose(int body) const {
    const Isometry3d to_world =
        PoseOf(data->xpos + std::ptrdiff_t{3} * palm, data->xmat + std::ptrdiff_t{9} * palm);
    return to_world.inverse() *
           PoseOf(data->xpos + std::ptrdiff_t{3} * body, data->xmat + std::ptrdiff_t{9} * body);
  }
  [[nodiscard]] int BodyId(const std::string& name) const {
    return mj_name2id(model, mjOBJ_BODY, name.c_str());
  }
  /// Return the finger of a body, and the number of its joints at or above the body.
  [[nodiscard]] HandPart Owner(int body) const {
    HandPart part;
    for (FingerIndex finger{0}; finger < std::ssize(joint_ids); ++finger) {
      const auto above = std::ranges::count_if(joint_ids[finger], [&](int joint) {
        int at = body;
        while (at != 0 && at != model->jnt_bodyid[joint]) at = model->body_parentid[at];
        return at != 0;
      });
      if (above > part.joints) part = {finger, static_cast<int>(above), Role::kLink, ""};
    }
    return part;
  }
  void AddPart(int body, std::vector<Vector3d> points, double radius, Role role) {
    HandPart part = Owner(body);
    part.role = role;
    const char* name = mj_id2name(model, mjOBJ_BODY, body);
    part.body = name != nullptr ? name : "body " + std::to_string(body);
    parts.push_back(part);
    shapes.push_back({body, std::move(points), radius});
  }
  [[nodiscard]] bool IsPartOfTip(int geom) const {
    for (std::size_t i = 0; i < tip_bodies.size(); ++i) {
      const kinematics::HandDescription::Tip& tip = description.tips[i];
      if (kinematics::IsPartOfFingertip(*model, *data, geom, tip_bodies[i],
                                        {tip.centre, tip.radius})) {
        return true;
      }
    }
    return false;
  }
  void AddParts() {
    for (int geom = 0; geom < model->ngeom; ++geom) {
      const int body = model->geom_bodyid[geom];
      const bool collides = model->geom_contype[geom] != 0 || model->geom_conaffinity[geom] != 0;
      if (!collides || model->body_rootid[body] != model->body_rootid[palm]) continue;
      const bool is_covered = IsPartOfTip(geom);
      // A marker of another body, inside the fingertip sphere.
      if (is_covered && std::ranges::find(tip_bodies, body) == tip_bodies.end()) continue;
      const collision::ConvexShape shape = kinematics::ShapeOfGeom(*model, geom);
      if (shape.points.empty()) continue;
      mjtNum matrix[9];
      mju_quat2Mat(matrix, model->geom_quat + std::ptrdiff_t{4} * geom);
      const Isometry3d in_body = PoseOf(model->geom_pos + std::ptrdiff_t{3} * geom, matrix);
      std::vector<Vector3d> points;
      for (const Vector3d& point : shape.points) points.push_back(in_body * point);
      AddPart(body, std::move(points), shape.radius, is_covered ? Role::kCovered : Role::kLink);
    }
    for (std::size_t i = 0; i < tip_bodies.size(); ++i) {
      const kinematics::HandDescription::Tip& tip = description.tips[i];
      AddPart(tip_bodies[i], {Vector3d::Zero(), tip.centre}, tip.radius, Role::kTip);
    }
  }
  /// Measure moment arms in the reference configuration.
  /// They are sums of distances from each joint to the next one, and from the last one to the
  /// farthest point.
  void MeasureLevers() {
    const auto anchor = [&](int joint) -> Vector3d {
      return Eigen::Map<const Vector3d>(data->xanchor + std::ptrdiff_t{3} * joint);
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::vector<double> lever(parts[i].joints, 0);
      if (!lever.empty()) {
        const std::vector<int>& joints = joint_ids[parts[i].finger];
        const Isometry3d pose = PoseOf(data->xpos + std::ptrdiff_t{3} * shapes[i].body,
                                       data->xmat + std::ptrdiff_t{9} * shapes[i].body);
        double reach = 0;
        for (const Vector3d& point : shapes[i].points) {
          reach = std::max(reach, (pose * point - anchor(joints[parts[i].joints - 1])).norm());
        }
        reach += shapes[i].radius;
        for (int k = parts[i].joints - 1; k >= 0; --k) {
          lever[k] = reach;
          if (k > 0) reach += (anchor(joints[k]) - anchor(joints[k - 1])).norm();
        }
      }
      levers.push_back(std::move(lever));
    }
  }
};

HandBody::HandBody(const kinematics::HandFile& file) : impl_(std::make_unique<Impl>(file)) {
  Impl& impl = *impl_;
  impl.data = kinematics::AtRest(*impl.model);
  impl.palm = impl.BodyId(impl.description.palm);
  for (const kinematics::Finger& finger : impl.hand.fingers) {
    impl.joint_ids.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) {
      impl.joint_ids.back().push_back(mj_name2id(impl.model, mjOBJ_JOINT, joint.name.c_str()));
    }
    impl.tip_bodies.push_back(impl.BodyId(finger.tip.body));
  }
  impl.AddParts();
  impl.MeasureLevers();
  for (int a = 0; a < static_cast<int>(impl.parts.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(impl.parts.size()); ++b) {
      const HandPart& first = impl.parts[a];
      const HandPart& second = impl.parts[b];
      const bool chain =
          first.finger == second.finger || !first.finger.valid() || !second.finger.valid();
      const bool neighbours = chain && std::abs(first.joints - second.joints) <= 1;
      if (neighbours || !HaveGap(Place(a), Place(b), kNearAtRest)) impl.may_touch.insert({a, b});
    }
  }
}

HandBody::~HandBody() = default;

const kinematics::HandModel& HandBody::hand() const { return impl_->hand; }

const std::vector<HandPart>& HandBody::parts() const { return impl_->parts; }

bool HandBody::MayTouch(int a, int b) const {
  return impl_->may_touch.contains({std::min(a, b), std::max(a, b)});
}

void HandBody::SetJoints(const std::vector<std::vector<double>>& joints) {
  for (std::size_t i = 0; i < impl_->joint_ids.size(); ++i) {
    for (std::size_t k = 0; k < impl_->joint_ids[i].size(); ++k) {
      impl_->data->qpos[impl_->model->jnt_qposadr[impl_->joint_ids[i][k]]] = joints[i][k];
    }
  }
  mj_kinematics(impl_->model, impl_->data.get());
}

std::optional<HandBody::Uncoupled> HandBody::LargestCouplingResidual() const {
  const CouplingResiduals::Residual found = impl_->couplings.Largest(*impl_->data);
  for (FingerIndex finger{0}; finger < std::ssize(impl_->joint_ids); ++finger) {
    const std::vector<int>& joints = impl_->joint_ids[finger];
    const auto at = std::ranges::find(joints, found.joint);
    if (at == joints.end()) continue;
    return Uncoupled{finger, static_cast<int>(at - joints.begin()), found.radians, found.source};
  }
  return std::nullopt;
}

ConvexBody HandBody::Place(int part) const {
  const Impl::Shape& shape = impl_->shapes[part];
  const Isometry3d pose = impl_->BodyPose(shape.body);
  std::vector<Vector3d> points;
  for (const Vector3d& point : shape.points) points.push_back(pose * point);
  return MakeConvexBody(std::move(points), shape.radius);
}

Vector3d HandBody::JointAnchor(FingerIndex finger, int joint) const {
  const Isometry3d palm = PoseOf(impl_->data->xpos + std::ptrdiff_t{3} * impl_->palm,
                                 impl_->data->xmat + std::ptrdiff_t{9} * impl_->palm);
  const int id = impl_->joint_ids[finger][joint];
  return palm.inverse() *
         Vector3d(Eigen::Map<const Vector3d>(impl_->data->xanchor + std::ptrdiff_t{3} * id));
}

Vector3d HandBody::TipCentre(FingerIndex finger) const {
  return impl_->BodyPose(impl_->tip_bodies[finger]) * impl_->description.tips[finger].centre;
}

Eigen::Matrix3d HandBody::TipTurn(FingerIndex finger) const {
  return impl_->BodyPose(impl_->tip_bodies[finger]).linear();
}

double HandBody::MotionBound(int part, const std::vector<std::vector<double>>& from,
                             const std::vector<std::vector<double>>& to) const {
  double bound = 0;
  const std::vector<double>& levers = impl_->levers[part];
  for (std::size_t k = 0; k < levers.size(); ++k) {
    const FingerIndex finger = impl_->parts[part].finger;
    bound += std::abs(to[finger][k] - from[finger][k]) * levers[k];
  }
  return bound;
}

}  // namespace regrasp::sim
