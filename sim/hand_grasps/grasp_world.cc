#include "sim/hand_grasps/grasp_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/object/rotation.h"
#include "sim/actuation/model_numbers.h"
#include "sim/actuation/scene_model.h"
#include "sim/actuation/surface_shell.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using kinematics::VectorAt;
using kinematics::XmlElement;

/// Collision bit of the pair of hand and object. Models rarely use it.
constexpr int kObjectBit = 1 << 29;
/// Servo of a joint whose model has none: stiffness in N m/rad or N/m, and least inertia, kg m² or
/// kg. The stiffness of revolute joints is that of DexGraspBench's hands.
constexpr double kRevoluteStiffness = 5;
constexpr double kPrismaticStiffness = 1000;
constexpr double kLeastInertia = 1e-3;
/// Contact parameters of the hand's geoms in DexGraspBench (solref, solimp).
constexpr std::array<double, 2> kHandSolref = {0.005, 1};
constexpr std::array<double, 5> kHandSolimp = {0.5, 0.99, 0.0001, 0.5, 2};
/// The same of the object: MuJoCo's defaults.
constexpr std::array<double, 2> kObjectSolref = {0.02, 1};
constexpr std::array<double, 5> kObjectSolimp = {0.9, 0.95, 0.001, 0.5, 2};
constexpr double kImpratio = 10;
constexpr int kNoslipIterations = 2;
/// Largest number of pieces of an object that is not a surface shell. Decompositions have fewer.
constexpr int kMostPieces = 256;

XmlElement ObjectElement(std::string name,
                         std::vector<std::pair<std::string, std::string>> attributes) {
  XmlElement element;
  element.name = std::move(name);
  element.attributes = std::move(attributes);
  return element;
}

/// Return a mesh whose triangles MuJoCo computes: the convex hull.
XmlElement HullElement(const std::string& name, std::span<const Vector3d> vertices) {
  std::vector<double> numbers;
  for (const Vector3d& at : vertices) numbers.insert(numbers.end(), at.begin(), at.end());
  // The hand's model may have a default scale of meshes.
  return ObjectElement("mesh",
                       {{"name", name}, {"scale", "1 1 1"}, {"vertex", NumbersText(numbers)}});
}

XmlElement GeomElement(const std::string& mesh) {
  return ObjectElement("geom", {{"type", "mesh"},
                                {"mesh", mesh},
                                {"mass", "0"},
                                {"margin", "0"},
                                {"gap", "0"},
                                {"contype", "0"},
                                {"conaffinity", "0"}});
}

/// Return the convex hulls that are the collision geometry of an object, in metres from its
/// centroid.
GraspWorld::Pieces HullsOf(const object::Polyhedron& solid, double scale,
                           const GraspWorld::Pieces& pieces) {
  GraspWorld::Pieces hulls = pieces;
  if (hulls.empty() && IsConvex(solid)) hulls.push_back(solid.vertices());
  for (std::vector<Vector3d>& hull : hulls) {
    for (Vector3d& point : hull) point = scale * (point - solid.mass_properties().centroid);
  }
  if (!hulls.empty()) return hulls;
  for (const ShellPiece& piece : SurfaceShell(solid, scale)) {
    hulls.emplace_back(piece.begin(), piece.end());
  }
  return hulls;
}

/// Add the object of 1 kg with its collision geometry.
void AddObject(const object::Polyhedron& solid, double scale, const GraspWorld::Pieces& pieces,
               XmlElement& root) {
  const object::MassProperties& properties = solid.mass_properties();
  const Eigen::Matrix3d inertia = scale * scale / properties.volume * properties.inertia;
  XmlElement body = ObjectElement("body", {{"name", kGraspObject}});
  body.children.push_back(ObjectElement("freejoint", {}));
  body.children.push_back(ObjectElement(
      "inertial", {{"pos", "0 0 0"},
                   {"mass", "1"},
                   {"fullinertia", NumbersText({inertia(0, 0), inertia(1, 1), inertia(2, 2),
                                                inertia(0, 1), inertia(0, 2), inertia(1, 2)})}}));
  XmlElement assets = ObjectElement("asset", {});
  int number = 0;
  for (const std::vector<Vector3d>& hull : HullsOf(solid, scale, pieces)) {
    const std::string name = std::string(kGraspObject) + "_" + std::to_string(number++);
    assets.children.push_back(HullElement(name, hull));
    body.children.push_back(GeomElement(name));
  }
  root.children.push_back(std::move(assets));
  XmlElement world = ObjectElement("worldbody", {});
  world.children.push_back(std::move(body));
  root.children.push_back(std::move(world));
}

void SetPose(const Isometry3d& pose, mjtNum* position, mjtNum* quaternion) {
  const Quaterniond turn(pose.linear());
  std::copy_n(pose.translation().data(), 3, position);
  const std::array<double, 4> values = {turn.w(), turn.x(), turn.y(), turn.z()};
  std::ranges::copy(values, quaternion);
}

void SetContactParameters(int geom, const std::array<double, 2>& solref,
                          const std::array<double, 5>& solimp, mjModel& model) {
  std::ranges::copy(solref, model.geom_solref + std::ptrdiff_t{mjNREF} * geom);
  std::ranges::copy(solimp, model.geom_solimp + std::ptrdiff_t{mjNIMP} * geom);
  model.geom_condim[geom] = 4;
  model.geom_priority[geom] = 0;
  model.geom_solmix[geom] = 1;
  model.geom_margin[geom] = 0;
  model.geom_gap[geom] = 0;
}

}  // namespace

GraspWorld::GraspWorld(const WholeHand& hand, const object::Polyhedron& solid, double scale,
                       const Pieces& pieces)
    : centroid_(scale * solid.mass_properties().centroid) {
  kinematics::ModelText text = hand.text;
  AddObject(solid, scale, pieces, text.root);
  model_ = kinematics::CompileText(hand.model_file, text);
  data_.reset(mj_makeData(model_.get()));
  scratch_.reset(mj_makeData(model_.get()));
  if (!data_ || !scratch_) throw EnvironmentError("MuJoCo has no memory for a hand");
  FindParts(hand);
  FindFollowers();
  SetContacts();
  MakeServos();
  SetOptions();
  SetPhysics({});
}

void GraspWorld::FindParts(const WholeHand& hand) {
  const mjModel& model = *model_;
  object_body_ = mj_name2id(&model, mjOBJ_BODY, kGraspObject);
  object_qpos_ = model.jnt_qposadr[model.body_jntadr[object_body_]];
  palm_ = mj_name2id(&model, mjOBJ_BODY, hand.palm.c_str());
  hand_qpos_ = model.jnt_qposadr[model.body_jntadr[mj_name2id(&model, mjOBJ_BODY, kWholeHandBody)]];
  is_link_.assign(model.nbody, false);
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int body = model.geom_bodyid[geom];
    if (body == object_body_ || !kinematics::Collides(model, geom)) continue;
    if (!is_link_[body]) links_.push_back(body);
    is_link_[body] = true;
  }
  std::set<int> above;
  for (int body = palm_; body > 0; body = model.body_parentid[body]) above.insert(body);
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    if (type != mjJNT_HINGE && type != mjJNT_SLIDE) continue;
    const std::string name = kinematics::JointName(model, joint);
    joint_ids_[name] = joint;
    if (above.contains(model.jnt_bodyid[joint])) continue;
    joints_.push_back({name, type == mjJNT_SLIDE, model.jnt_limited[joint] != 0,
                       model.jnt_range[2 * joint], model.jnt_range[2 * joint + 1]});
  }
}

void GraspWorld::FindFollowers() {
  const mjModel& model = *model_;
  for (int i = 0; i < model.neq; ++i) {
    if (model.eq_type[i] != mjEQ_JOINT || model.eq_active[i] == 0) continue;
    followers_.push_back(
        {model.eq_obj1id[i], model.eq_obj2id[i], model.eq_data + std::ptrdiff_t{mjNEQDATA} * i});
  }
}

/// Set the contacts of hand and object. Contacts within the hand remain those of its model.
void GraspWorld::SetContacts() {
  mjModel& model = *model_;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_bodyid[geom] == object_body_) {
      model.geom_contype[geom] = model.geom_conaffinity[geom] = kObjectBit;
      SetContactParameters(geom, kObjectSolref, kObjectSolimp, model);
    } else if (kinematics::Collides(model, geom)) {
      model.geom_contype[geom] |= kObjectBit;
      SetContactParameters(geom, kHandSolref, kHandSolimp, model);
    }
  }
}

/// Turn every actuator that is not a position servo into one.
void GraspWorld::MakeServos() {
  mjModel& model = *model_;
  mj_resetData(&model, scratch_.get());
  mj_forward(&model, scratch_.get());
  for (int a = 0; a < model.nu; ++a) {
    mjtNum* gain = model.actuator_gainprm + std::ptrdiff_t{mjNGAIN} * a;
    mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
    if (model.actuator_biastype[a] == mjBIAS_AFFINE && bias[1] < 0 && gain[0] > 0) continue;
    const mjtNum* moments = scratch_->actuator_moment + std::ptrdiff_t{a} * model.nv;
    double inertia = kLeastInertia;
    bool slides = false;
    for (int dof = 0; dof < model.nv; ++dof) {
      if (moments[dof] == 0) continue;
      inertia = std::max(inertia, model.dof_M0[dof]);
      slides |= model.jnt_type[model.dof_jntid[dof]] == mjJNT_SLIDE;
    }
    if (model.actuator_ctrllimited[a] != 0 && model.actuator_forcelimited[a] == 0) {
      const mjtNum* control = model.actuator_ctrlrange + std::ptrdiff_t{2} * a;
      mjtNum* force = model.actuator_forcerange + std::ptrdiff_t{2} * a;
      std::tie(force[0], force[1]) = std::minmax(gain[0] * control[0], gain[0] * control[1]);
      model.actuator_forcelimited[a] = 1;
    }
    model.actuator_ctrllimited[a] = 0;
    model.actuator_dyntype[a] = mjDYN_NONE;
    const double stiffness = slides ? kPrismaticStiffness : kRevoluteStiffness;
    model.actuator_gaintype[a] = mjGAIN_FIXED;
    model.actuator_biastype[a] = mjBIAS_AFFINE;
    gain[0] = stiffness;
    bias[0] = 0;
    bias[1] = -stiffness;
    bias[2] = -2 * std::sqrt(stiffness * inertia);
  }
}

void GraspWorld::SetOptions() {
  mjOption& opt = model_->opt;
  mj_defaultOption(&opt);
  opt.timestep = kTimestep;
  opt.integrator = mjINT_IMPLICIT;
  opt.cone = mjCONE_ELLIPTIC;
  opt.impratio = kImpratio;
  opt.noslip_iterations = kNoslipIterations;
  opt.disableflags = mjDSBL_GRAVITY;
  // Many pieces have many contacts without it.
  const bool is_shell = model_->body_geomnum[object_body_] > kMostPieces;
  opt.enableflags = is_shell ? 0 : mjENBL_MULTICCD;
}

void GraspWorld::SetPhysics(const GraspPhysics& physics) {
  mjModel& model = *model_;
  const double factor = physics.mass_kg / mass_;
  mass_ = physics.mass_kg;
  model.body_mass[object_body_] *= factor;
  mjtNum* inertia = model.body_inertia + std::ptrdiff_t{3} * object_body_;
  for (int i = 0; i < 3; ++i) inertia[i] *= factor;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    mjtNum* friction = model.geom_friction + std::ptrdiff_t{3} * geom;
    friction[0] = physics.mu;
    friction[1] = physics.torsion_mu;
  }
  UpdateConstants(model, *data_);
}

const GraspWorld::JointRange& GraspWorld::FindJoint(const std::string& name,
                                                    const std::string& where) const {
  const auto found = std::ranges::find(joints_, name, &JointRange::name);
  if (found != joints_.end()) return *found;
  std::string names;
  for (const JointRange& joint : joints_) names += (names.empty() ? "" : ", ") + joint.name;
  throw InputError(where + ": unknown joint \"" + name + "\", expected " + names);
}

void GraspWorld::CheckJoints(const HandConfiguration& configuration,
                             const std::string& where) const {
  for (const auto& [name, unused] : configuration.joints) {
    static_cast<void>(FindJoint(name, where + ": joints"));
  }
  for (const JointRange& joint : joints_) {
    const bool follows = std::ranges::any_of(followers_, [&](const Follower& follower) {
      return follower.joint == joint_ids_.at(joint.name);
    });
    if (follows || configuration.joints.contains(joint.name)) continue;
    throw InputError(where + ": joints: joint \"" + joint.name + "\" not found");
  }
}

HandConfiguration GraspWorld::Closed(const HandConfiguration& configuration,
                                     const std::map<std::string, double>& closing,
                                     const std::string& where) const {
  HandConfiguration closed = configuration;
  for (const auto& [name, factor] : closing) {
    const JointRange& joint = FindJoint(name, where);
    if (!joint.limited) throw InputError(where + ": joint \"" + name + "\" has no range");
    closed.joints[name] = std::abs(factor) * (factor > 0 ? joint.upper : joint.lower);
  }
  return closed;
}

void GraspWorld::SetQpos(const HandConfiguration& configuration, mjData& data) const {
  const mjModel& model = *model_;
  std::copy_n(model.qpos0, model.nq, data.qpos);
  for (const auto& [name, value] : configuration.joints) {
    data.qpos[model.jnt_qposadr[joint_ids_.at(name)]] = value;
  }
  for (const Follower& follower : followers_) {
    const int at = model.jnt_qposadr[follower.joint];
    if (configuration.joints.contains(kinematics::JointName(model, follower.joint))) continue;
    double x = 0;
    if (follower.leader >= 0) {
      const int leader = model.jnt_qposadr[follower.leader];
      x = data.qpos[leader] - model.qpos0[leader];
    }
    const mjtNum* c = follower.coefficients;
    data.qpos[at] = model.qpos0[at] + c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
  }
  SetPose(Isometry3d::Identity(), data.qpos + hand_qpos_, data.qpos + hand_qpos_ + 3);
  mj_kinematics(&model, &data);
  const Isometry3d base =
      configuration.palm * kinematics::PoseAt(data.xpos, data.xmat, palm_).inverse();
  SetPose(base, data.qpos + hand_qpos_, data.qpos + hand_qpos_ + 3);
  Isometry3d object = Isometry3d::Identity();
  object.translation() = centroid_;
  SetPose(object, data.qpos + object_qpos_, data.qpos + object_qpos_ + 3);
}

/// Return the controls at which the servos exert no force in a configuration.
std::vector<double> GraspWorld::ControlsAt(const HandConfiguration& configuration) const {
  const mjModel& model = *model_;
  mjData& data = *scratch_;
  mj_resetData(&model, &data);
  SetQpos(configuration, data);
  mj_fwdPosition(&model, &data);
  std::vector<double> controls;
  for (int a = 0; a < model.nu; ++a) {
    const double gain = model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a];
    const mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
    controls.push_back(-(bias[0] + bias[1] * data.actuator_length[a]) / gain);
  }
  return controls;
}

void GraspWorld::Place(const HandConfiguration& configuration) {
  mj_resetData(model_.get(), data_.get());
  SetQpos(configuration, *data_);
  SetPose(configuration.palm, data_->mocap_pos, data_->mocap_quat);
  std::ranges::copy(ControlsAt(configuration), data_->ctrl);
  mj_forward(model_.get(), data_.get());
}

void GraspWorld::Command(const HandConfiguration& from, const HandConfiguration& to, double share) {
  const std::vector<double> begin = ControlsAt(from);
  const std::vector<double> end = ControlsAt(to);
  for (std::size_t a = 0; a < begin.size(); ++a) {
    data_->ctrl[a] = begin[a] + share * (end[a] - begin[a]);
  }
  SetPose(object::PoseBetween(from.palm, to.palm, share), data_->mocap_pos, data_->mocap_quat);
}

void GraspWorld::SetForce(const Vector3d& force) {
  std::copy_n(force.data(), 3, data_->xfrc_applied + std::ptrdiff_t{6} * object_body_);
}

void GraspWorld::Step() {
  mj_step(model_.get(), data_.get());
  CheckState(*model_, *data_);
}

EngineState GraspWorld::Save() const { return SaveState(*model_, *data_); }

void GraspWorld::Restore(const EngineState& state) { RestoreState(state, *data_); }

Isometry3d GraspWorld::object_pose() const {
  Isometry3d pose = kinematics::PoseAt(data_->xpos, data_->xmat, object_body_);
  pose.translation() -= pose.linear() * centroid_;
  return pose;
}

Isometry3d GraspWorld::palm_pose() const {
  return kinematics::PoseAt(data_->xpos, data_->xmat, palm_);
}

std::map<std::string, double> GraspWorld::joint_positions() const {
  std::map<std::string, double> positions;
  for (const auto& [name, joint] : joint_ids_) {
    positions[name] = data_->qpos[model_->jnt_qposadr[joint]];
  }
  return positions;
}

bool GraspWorld::IsTouched() const {
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const int first = model_->geom_bodyid[contact.geom1];
    const int second = model_->geom_bodyid[contact.geom2];
    if (contact.exclude == 0 && (first == object_body_) != (second == object_body_)) return true;
  }
  return false;
}

double GraspWorld::SelfDistance() const {
  double smallest = 0;
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const bool is_of_hand = model_->geom_bodyid[contact.geom1] != object_body_ &&
                            model_->geom_bodyid[contact.geom2] != object_body_;
    if (contact.exclude == 0 && is_of_hand) smallest = std::min(smallest, contact.dist);
  }
  return smallest;
}

std::map<std::string, double> GraspWorld::JointMotion(int link, const Vector3d& point,
                                                      const Vector3d& direction) const {
  const mjModel& model = *model_;
  std::vector<double> jacobian(3 * static_cast<std::size_t>(model.nv));
  mj_jac(&model, data_.get(), jacobian.data(), nullptr, point.data(), link);
  std::map<std::string, double> motion;
  for (const JointRange& joint : joints_) {
    const int dof = model.jnt_dofadr[joint_ids_.at(joint.name)];
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      sum += direction[i] * jacobian[static_cast<std::size_t>(i) * model.nv + dof];
    motion[joint.name] = sum;
  }
  return motion;
}

HandConfiguration GraspWorld::WithinRange(HandConfiguration configuration) const {
  for (const JointRange& joint : joints_) {
    const auto found = configuration.joints.find(joint.name);
    if (found == configuration.joints.end() || !joint.limited) continue;
    found->second = std::clamp(found->second, joint.lower, joint.upper);
  }
  return configuration;
}

}  // namespace regrasp::sim
