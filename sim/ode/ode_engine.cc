#include "sim/ode/ode_engine.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include "sim/ode/ode_world.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

/// Additional depth of contacts, over kRestDepth, if a step still fails after kFirstDeeper tries.
/// It increases their forces.
constexpr double kDeeper = 0.01;
constexpr int kFirstDeeper = 5;

/// Depth over D of contacts in equilibrium, so that they hold the object from step to step.
constexpr double kRestDepth = 1e-7;

/// Contact force over the grasp force below which the cone is not checked.
constexpr double kSlack = 1e-6;

/// Inertia of fingers over m D², so large that they do not rotate.
constexpr double kFingerInertia = 1e6;

/// Position and velocity of a body or a fingertip, in the engine's units.
struct Motion {
  Vector3d position = Vector3d::Zero(), velocity = Vector3d::Zero();
};

/// Patch in contact with a finger.
struct PatchIndex {
  FingerIndex finger;
  SiteIndex site;
  int patch = 0;
  auto operator<=>(const PatchIndex&) const = default;
};

/// Contact in a step, in S.
struct Touch {
  PatchIndex where;
  PatchTouch place;
  Vector3d force = Vector3d::Zero();  ///< on the object
};

Vector3d Read(const dReal* values) { return {values[0], values[1], values[2]}; }

void SetInertia(dBodyID body, double mass, const Eigen::Matrix3d& I) {
  dMass values;
  dMassSetParameters(&values, mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  dBodySetMass(body, &values);
}

bool IsFinite(const Motion& motion) {
  return motion.position.allFinite() && motion.velocity.allFinite();
}

}  // namespace

std::string OdeVersion() { return dODE_VERSION; }

struct OdeEngine::Impl {
  EngineUnits units;
  Scene scene;  ///< scene in the engine's units
  double mu = 0;
  std::vector<std::vector<PatchPrism>> sites;  ///< prisms [site]

  OdeWorld world = MakeOdeWorld();
  OdeJointsPtr joints{dJointGroupCreate(0)};
  dBodyID object = nullptr;
  std::vector<dBodyID> fingers;

  // State.
  double time = 0;
  Motion centre;
  Quaterniond turn = Quaterniond::Identity();
  Vector3d spin = Vector3d::Zero();
  std::vector<Motion> tips;
  std::map<PatchIndex, Vector3d> forces;  ///< contact forces of the last step, on the object
  std::vector<TipForce> tip_forces;       ///< sums of forces per finger, newtons; without torques

  // Inputs.
  std::vector<Vector3d> targets;
  std::vector<std::vector<SiteIndex>> sites_of_finger;
  double gravity = 0;
  Vector3d load = Vector3d::Zero(), torque = Vector3d::Zero();

  Impl(const Scene& metres, const object::Object& body);
  [[nodiscard]] Vector3d ServoPush(FingerIndex finger) const;
  [[nodiscard]] std::vector<Touch> FindTouches() const;
  void LoadBodies();
  void AddJoint(const Touch& touch, const FrictionBox& box, double deeper,
                dJointFeedback& feedback);
  void AddJoints(const std::vector<Touch>& touches, int tried, std::vector<FrictionBox>& boxes,
                 std::vector<dJointFeedback>& feedback);
  [[nodiscard]] bool Solve(int tried, std::vector<Touch>& touches);
  void SolveByTries(std::vector<Touch>& touches);
  void TakeBodies(const std::vector<Touch>& touches);
  void SumForces();
};

OdeEngine::Impl::Impl(const Scene& metres, const object::Object& body)
    : units(UnitsOf(metres.settings)), scene(InUnits(metres, units)) {
  const ReplaySettings& s = scene.settings;
  mu = s.friction_factor * s.mu;
  for (const SceneSite& site : scene.sites) {
    std::vector<PatchPrism>& prisms = sites.emplace_back();
    for (const ContactPatch& patch : site.patches) {
      prisms.push_back(MakePrism(patch, body.inward_normal(site.place.face), s.patch_thickness_m));
    }
  }
  dWorldSetERP(world.get(), kOdeDepthRecovery);
  dWorldSetContactSurfaceLayer(world.get(), kRestDepth * s.diameter_m);
  object = dBodyCreate(world.get());
  SetInertia(object, s.mass_factor * s.mass_kg, scene.inertia);
  for (const SceneFinger& finger : scene.fingers) {
    fingers.push_back(dBodyCreate(world.get()));
    const double inertia = kFingerInertia * s.finger_mass_kg * s.diameter_m * s.diameter_m;
    SetInertia(fingers.back(), s.finger_mass_kg, inertia * Eigen::Matrix3d::Identity());
    tips.push_back({finger.start_S, Vector3d::Zero()});
    targets.push_back(finger.start_S);
  }
  sites_of_finger.resize(fingers.size());
  SumForces();
}

Vector3d OdeEngine::Impl::ServoPush(FingerIndex finger) const {
  const ReplaySettings& s = scene.settings;
  const auto& [position, velocity] = tips[finger];
  return s.finger_stiffness_N_m * (targets[finger] - position) - s.finger_damping_Ns_m * velocity;
}

/// Return the contacts with the forces of the last step; a new contact has the force of its servo.
std::vector<Touch> OdeEngine::Impl::FindTouches() const {
  const Isometry3d X_SB = Eigen::Translation3d(centre.position) * turn;
  const Isometry3d X_BS = X_SB.inverse();
  std::vector<Touch> touches;
  for (FingerIndex f{0}; f < std::ssize(fingers); ++f) {
    const Vector3d tip_B = X_BS * tips[f].position;
    for (const SiteIndex site : sites_of_finger[f]) {
      for (std::size_t k = 0; k < sites[site].size(); ++k) {
        const auto found = TouchPatch(sites[site][k], tip_B, scene.settings.fingertip_radius_m);
        if (!found) continue;
        Touch touch{{f, site, static_cast<int>(k)}, *found};
        touch.place.point = X_SB * found->point;
        touch.place.normal = turn * found->normal;
        const auto last = forces.find(touch.where);
        touch.force = last != forces.end() ? last->second : ServoPush(f);
        touches.push_back(touch);
      }
    }
  }
  return touches;
}

/// Set ODE's bodies to the state, with all loads on them.
void OdeEngine::Impl::LoadBodies() {
  dWorldSetGravity(world.get(), 0, 0, -gravity);
  dBodySetPosition(object, centre.position.x(), centre.position.y(), centre.position.z());
  const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
  dBodySetQuaternion(object, q);
  dBodySetLinearVel(object, centre.velocity.x(), centre.velocity.y(), centre.velocity.z());
  dBodySetAngularVel(object, spin.x(), spin.y(), spin.z());
  dBodySetForce(object, load.x(), load.y(), load.z());
  dBodySetTorque(object, torque.x(), torque.y(), torque.z());
  const dQuaternion none = {1, 0, 0, 0};
  for (FingerIndex f{0}; f < std::ssize(fingers); ++f) {
    const auto& [p, v] = tips[f];
    const Vector3d push = ServoPush(f);
    dBodySetPosition(fingers[f], p.x(), p.y(), p.z());
    dBodySetQuaternion(fingers[f], none);
    dBodySetLinearVel(fingers[f], v.x(), v.y(), v.z());
    dBodySetAngularVel(fingers[f], 0, 0, 0);
    dBodySetForce(fingers[f], push.x(), push.y(), push.z());
    dBodySetTorque(fingers[f], 0, 0, 0);
  }
}

/// Add the contact joint of a touch.
/// @param deeper  additional depth over kRestDepth beyond equilibrium; 0: the actual depth.
void OdeEngine::Impl::AddJoint(const Touch& touch, const FrictionBox& box, double deeper,
                               dJointFeedback& feedback) {
  dContact contact{};
  contact.surface.mode = dContactMu2 | dContactFDir1;
  contact.surface.mu = box.along;
  contact.surface.mu2 = box.across;
  const double rest = kRestDepth * scene.settings.diameter_m;
  contact.geom.depth =
      deeper > 0 ? std::max(touch.place.depth, rest) + deeper * rest : touch.place.depth;
  for (int k = 0; k < 3; ++k) {
    contact.geom.pos[k] = touch.place.point[k];
    contact.geom.normal[k] = touch.place.normal[k];
    contact.fdir1[k] = box.direction[k];
  }
  const dJointID joint = dJointCreateContact(world.get(), joints.get(), &contact);
  // ODE's normals point into the first body.
  dJointAttach(joint, object, fingers[touch.where.finger]);
  dJointSetFeedback(joint, &feedback);
}

void OdeEngine::Impl::AddJoints(const std::vector<Touch>& touches, int tried,
                                std::vector<FrictionBox>& boxes,
                                std::vector<dJointFeedback>& feedback) {
  dJointGroupEmpty(joints.get());
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const std::size_t i = (k + static_cast<std::size_t>(tried)) % touches.size();
    const Touch& touch = touches[i];
    boxes[i] = scene.dimension == 3 ? BoxInCircle(touch.place.normal, touch.force, mu)
                                    : BoxInPlane(touch.place.normal, touch.force, mu);
    const double nudge = tried * static_cast<double>(k + 1);
    boxes[i].along *= 1 - kOdeNarrower * nudge;
    const double deeper = tried < kFirstDeeper ? 0 : kDeeper * static_cast<double>(k + 1);
    AddJoint(touch, boxes[i], deeper, feedback[i]);
  }
}

/// Solve the step repeatedly with the resulting forces until they obey their cones.
/// @return whether ODE's solver converged.
bool OdeEngine::Impl::Solve(int tried, std::vector<Touch>& touches) {
  const ReplaySettings& s = scene.settings;
  std::vector<FrictionBox> boxes(touches.size());
  std::vector<dJointFeedback> feedback(touches.size());
  for (int solution = 0; solution < kMostOdeSolutions; ++solution) {
    LoadBodies();
    AddJoints(touches, tried, boxes, feedback);
    if (!StepOde(world.get(), s.timestep_s)) return false;
    bool kept = true;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      touches[i].force = Read(feedback[i].f1);
      kept = kept && KeepsCone(touches[i].place.normal, boxes[i], touches[i].force, mu,
                               kSlack * s.grasp_force_N);
    }
    if (kept) break;
  }
  return true;
}

void OdeEngine::Impl::SolveByTries(std::vector<Touch>& touches) {
  const ReplaySettings& s = scene.settings;
  const double mobility = 1 / (s.mass_factor * s.mass_kg) + 1 / s.finger_mass_kg;
  double compliance = kOdeCompliance;
  for (int tried = 0; tried < kMostOdeTries; ++tried, compliance *= kOdeSofter) {
    dWorldSetCFM(world.get(), compliance * mobility * s.timestep_s);
    if (Solve(tried, touches)) return;
  }
  throw UnstableError("the solver of ODE did not converge");
}

void OdeEngine::Impl::TakeBodies(const std::vector<Touch>& touches) {
  centre = {Read(dBodyGetPosition(object)), Read(dBodyGetLinearVel(object))};
  const dReal* q = dBodyGetQuaternion(object);
  turn = Quaterniond(q[0], q[1], q[2], q[3]);
  spin = Read(dBodyGetAngularVel(object));
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    tips[f] = {Read(dBodyGetPosition(fingers[f])), Read(dBodyGetLinearVel(fingers[f]))};
  }
  if (scene.dimension == 2) {
    // No force acts out of the plane, so any motion out of it is rounding and is removed.
    centre.position.z() = centre.velocity.z() = 0;
    turn = Quaterniond(turn.w(), 0, 0, turn.z()).normalized();
    spin.head<2>().setZero();
  }
  forces.clear();
  for (const Touch& touch : touches) forces[touch.where] = touch.force;
  SumForces();
  const bool finite = IsFinite(centre) && turn.coeffs().allFinite() && spin.allFinite() &&
                      std::ranges::all_of(tips, IsFinite);
  if (!finite) throw UnstableError("the state is not finite");
}

void OdeEngine::Impl::SumForces() {
  tip_forces.assign(fingers.size(), TipForce());
  for (const auto& [where, force] : forces) {
    tip_forces[where.finger].force += units.force_N() * force;
  }
}

OdeEngine::OdeEngine(const Scene& scene, const object::Object& body)
    : impl_(std::make_unique<Impl>(scene, body)) {}
OdeEngine::~OdeEngine() = default;

double OdeEngine::time() const { return impl_->time * impl_->units.time_s; }

Isometry3d OdeEngine::object_pose() const {
  return Eigen::Translation3d(impl_->units.length_m * impl_->centre.position) * impl_->turn;
}

Vector3d OdeEngine::tip(FingerIndex finger) const {
  return impl_->units.length_m * impl_->tips[finger].position;
}

const TipForce& OdeEngine::tip_force(FingerIndex finger) const { return impl_->tip_forces[finger]; }

void OdeEngine::PlaceTip(FingerIndex finger, const Vector3d& tip) {
  impl_->tips[finger] = {tip / impl_->units.length_m, Vector3d::Zero()};
}

void OdeEngine::ShiftTip(FingerIndex finger, const Vector3d& offset) {
  impl_->tips[finger].position += offset / impl_->units.length_m;
}

void OdeEngine::SetTarget(FingerIndex finger, const Vector3d& target) {
  impl_->targets[finger] = target / impl_->units.length_m;
}

void OdeEngine::SetSite(FingerIndex finger, SiteIndex site) {
  impl_->sites_of_finger[finger].clear();
  if (site.valid()) AddSite(finger, site);
}

void OdeEngine::AddSite(FingerIndex finger, SiteIndex site) {
  std::vector<SiteIndex>& sites = impl_->sites_of_finger[finger];
  if (std::ranges::find(sites, site) == sites.end()) sites.push_back(site);
}

void OdeEngine::SetGravity(double gravity) {
  const EngineUnits& units = impl_->units;
  impl_->gravity = gravity * units.time_s * units.time_s / units.length_m;
}

void OdeEngine::SetLoad(const Vector3d& force, const Vector3d& torque) {
  const double newton = 1 / impl_->units.force_N();
  impl_->load = newton * force;
  impl_->torque = newton / impl_->units.length_m * torque;
}

void OdeEngine::Step() {
  std::vector<Touch> touches = impl_->FindTouches();
  impl_->SolveByTries(touches);
  impl_->TakeBodies(touches);
  impl_->time += impl_->scene.settings.timestep_s;
}

// Save the state. Positions: centre, rotation as w x y z, fingertips. Velocities: centre, spin,
// fingertips. In place of MuJoCo's warm start there are the contacts: finger, site, patch, and
// force.
OdeEngine::State OdeEngine::Save() const {
  State state;
  state.time = impl_->time;
  const Quaterniond& turn = impl_->turn;
  AppendVector(impl_->centre.position, state.qpos);
  state.qpos.insert(state.qpos.end(), {turn.w(), turn.x(), turn.y(), turn.z()});
  AppendVector(impl_->centre.velocity, state.qvel);
  AppendVector(impl_->spin, state.qvel);
  for (const Motion& tip : impl_->tips) {
    AppendVector(tip.position, state.qpos);
    AppendVector(tip.velocity, state.qvel);
  }
  for (const auto& [where, force] : impl_->forces) {
    AppendVector(Vector3d(where.finger, where.site, where.patch), state.qacc_warmstart);
    AppendVector(force, state.qacc_warmstart);
  }
  return state;
}

void OdeEngine::Restore(const State& state) {
  impl_->time = state.time;
  const double* q = state.qpos.data();
  const double* v = state.qvel.data();
  impl_->centre = {TakeVector(q), TakeVector(v)};
  impl_->turn = Quaterniond(q[0], q[1], q[2], q[3]);
  q += 4;
  impl_->spin = TakeVector(v);
  for (Motion& tip : impl_->tips) tip = {TakeVector(q), TakeVector(v)};
  impl_->forces.clear();
  const std::vector<double>& contacts = state.qacc_warmstart;
  for (const double* c = contacts.data(); c != contacts.data() + contacts.size();) {
    const PatchIndex where{FingerIndex(static_cast<int>(c[0])), SiteIndex(static_cast<int>(c[1])),
                           static_cast<int>(c[2])};
    c += 3;
    impl_->forces[where] = TakeVector(c);
  }
  impl_->SumForces();
}

}  // namespace regrasp::sim
