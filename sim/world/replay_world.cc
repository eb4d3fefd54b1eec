#include "sim/world/replay_world.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/error.h"
#include "sim/ode/ode_engine.h"
#include "sim/scene/mujoco_engine.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

/// Return the first contact of a finger in the plan; without a face if there is none.
grasp::Contact FirstContact(const object::Object& body, const Scene& scene, FingerIndex finger) {
  const SiteIndex first = scene.fingers[finger].first_site;
  if (!first.valid()) return {};
  const ContactSite& place = scene.sites[first].place;
  return {place.from, body.inward_normal(place.face), place.face};
}

std::unique_ptr<Engine> MakeEngine(const Scene& scene, const object::Object& body) {
  if (scene.settings.engine == EngineChoice::kOde) {
    if (scene.settings.torsion_m != 0) {
      throw InputError(
          "--engine ode: soft-finger contacts not supported, expected hard contacts; help: "
          "--engine mujoco");
    }
    return std::make_unique<OdeEngine>(scene, body);
  }
  const EngineUnits units = UnitsOf(scene.settings);
  return std::make_unique<MujocoEngine>(
      FormatScene(InUnits(scene, units), body, {}, /*surface=*/false),
      static_cast<int>(scene.fingers.size()), units);
}

}  // namespace

ReplayWorld::ReplayWorld(const object::Object& body, const plan::Plan& plan, Scene scene,
                         const ReplayObserver& observer)
    : p_WS_(body.mass_properties().centroid * plan.scale),
      scene_(std::move(scene)),
      observer_(observer),
      engine_(MakeEngine(scene_, body)),
      fingers_(scene_.fingers.size()),
      monitor_(scene_.settings) {
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    engine_->SetSite(f, SiteIndex());
    fingers_[f].anchor_S = scene_.fingers[f].start_S;
    fingers_[f].contact = FirstContact(body, scene_, f);
  }
  SetGravity(0);
  StartMonitoring();
}

object::WrenchFrame ReplayWorld::frame_B() const {
  return {Vector3d::Zero(), settings().diameter_m / 2, scene_.dimension};
}

double ReplayWorld::friction_angle() const { return std::atan(settings().mu); }

std::vector<FingerIndex> ReplayWorld::HoldingFingers() const {
  std::vector<FingerIndex> holding;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    if (fingers_[f].holding) holding.push_back(f);
  }
  return holding;
}

Vector3d ReplayWorld::ContactPoint_B(FingerIndex finger) const {
  return X_SB().inverse() * engine_->tip(finger) +
         settings().fingertip_radius_m * fingers_[finger].contact.n;
}

double ReplayWorld::Twist(FingerIndex finger) const {
  if (settings().torsion_m == 0) return 0;
  return engine_->tip_force(finger).torque.norm() / settings().torsion_m;
}

Vector3d ReplayWorld::TipAt_S(const grasp::Contact& contact_B, double gap) const {
  return X_SB() * (contact_B.p - (settings().fingertip_radius_m + gap) * contact_B.n);
}

Vector3d ReplayWorld::weight_S() const { return {0, 0, -settings().mass_kg * gravity_}; }

void ReplayWorld::SetGravity(double gravity) {
  gravity_ = gravity;
  engine_->SetGravity(gravity);
}

void ReplayWorld::Step() {
  const Vector3d own_weight(0, 0, settings().finger_mass_kg * gravity_);
  const double compliance = 1 / settings().finger_stiffness_N_m;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    const WorldFinger& finger = fingers_[f];
    engine_->SetTarget(f, finger.anchor_S + compliance * (finger.force_S + own_weight));
  }
  engine_->Step();
  MonitorMotion();
  if (sampling_) Sample();
}

int ReplayWorld::StepsIn(double duration) const {
  const double steps = duration * settings().characteristic_time_s / settings().timestep_s;
  return std::max(1, static_cast<int>(std::lround(steps)));
}

void ReplayWorld::Run(double duration, const std::function<void(double)>& drive) {
  const int steps = StepsIn(duration);
  for (int i = 1; i <= steps; ++i) {
    drive(static_cast<double>(i) / steps);
    Step();
  }
}

void ReplayWorld::StartMonitoring() {
  monitor_.Start(X_SB());
  for (const FingerIndex f : HoldingFingers()) fingers_[f].touch_B = ContactPoint_B(f);
}

void ReplayWorld::MonitorMotion() {
  // Computed after every step, hence in the frame of the scene, in which positions are given.
  const Isometry3d X_SB = this->X_SB();
  monitor_.AddPose(X_SB);
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    const WorldFinger& finger = fingers_[f];
    if (!finger.holding || finger.sliding) continue;
    const Vector3d normal_S = X_SB.linear() * finger.contact.n;
    monitor_.AddForce(f, engine_->tip_force(f).force, normal_S, Twist(f));
    const Vector3d point_S = engine_->tip(f) + settings().fingertip_radius_m * normal_S;
    const Vector3d slide_S = point_S - X_SB * finger.touch_B;
    monitor_.AddSlip(f, (slide_S - slide_S.dot(normal_S) * normal_S).norm());
  }
}

void ReplayWorld::MonitorRest() {
  for (const FingerIndex f : HoldingFingers()) {
    const grasp::Contact& contact = fingers_[f].contact;
    monitor_.AddGap(f, contact.n.dot(contact.p - ContactPoint_B(f)));
  }
}

void ReplayWorld::Sample() {
  if (!observer_.on_sample || engine_->time() < next_sample_) return;
  observer_.on_sample(TakeSnapshot());
  next_sample_ = engine_->time() + observer_.sample_interval_s;
}

plan::Snapshot ReplayWorld::TakeSnapshot() const {
  plan::Snapshot snapshot;
  snapshot.time_s = engine_->time();
  const Isometry3d X_SB = this->X_SB();
  snapshot.X_WO = Eigen::Translation3d(p_WS_) * X_SB * Eigen::Translation3d(-p_WS_);
  snapshot.fingertip_radius_m = settings().fingertip_radius_m;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    const WorldFinger& finger = fingers_[f];
    if (!finger.contact.face.valid()) continue;
    plan::FingerState state;
    state.finger = f;
    state.role = finger.role;
    state.tip_W = p_WS_ + engine_->tip(state.finger);
    state.normal_W = X_SB.linear() * finger.contact.n;
    state.contact_W =
        p_WS_ + X_SB * (finger.holding ? ContactPoint_B(state.finger) : finger.contact.p);
    state.force_W = engine_->tip_force(state.finger).force;
    if (finger.role == plan::FingerRole::kMoved) {
      for (const Vector3d& point_B : finger.path_B) state.path_W.push_back(p_WS_ + X_SB * point_B);
    }
    snapshot.fingers.push_back(state);
  }
  return snapshot;
}

namespace {

using Eigen::Vector3d;

/// Poses of the object and of the fingers in contact.
struct JointConfiguration {
  Eigen::Isometry3d X_SB;
  std::vector<FingerIndex> fingers;
  std::vector<Vector3d> tips_S;
};

JointConfiguration TakeConfiguration(const ReplayWorld& world) {
  JointConfiguration configuration{world.X_SB(), world.HoldingFingers(), {}};
  for (const FingerIndex f : configuration.fingers)
    configuration.tips_S.push_back(world.engine().tip(f));
  return configuration;
}

/// Return the motion of the object's points per angle of a rotation: metres, at most its radius.
double ArmOf(const Eigen::AngleAxisd& turn_B, const ReplayWorld& world) {
  const ReplaySettings& s = world.settings();
  const Vector3d& axis = turn_B.axis();
  const double gyration =
      std::sqrt(axis.dot(world.scene().inertia * axis) / (s.mass_factor * s.mass_kg));
  return std::min(s.diameter_m / 2, kArmOfGyration * gyration);
}

/// Return whether any of them has moved by more than a limit, metres.
bool HasTravelled(const JointConfiguration& from, double limit, const ReplayWorld& world) {
  const Eigen::Isometry3d X_SB = world.X_SB();
  for (std::size_t i = 0; i < from.fingers.size(); ++i) {
    if ((world.engine().tip(from.fingers[i]) - from.tips_S[i]).norm() > limit) return true;
  }
  // The longest arm first, because it requires no axis.
  if (MeasureMotion(from.X_SB, X_SB, world.settings().diameter_m / 2) <= limit) return false;
  const Eigen::AngleAxisd turn_B(
      Eigen::Quaterniond(from.X_SB.linear().transpose() * X_SB.linear()));
  return (X_SB.translation() - from.X_SB.translation()).norm() +
             ArmOf(turn_B, world) * std::abs(turn_B.angle()) >
         limit;
}

}  // namespace

bool WaitUntilStill(ReplayWorld& world) {
  const double still = kStill * world.settings().diameter_m;
  const int enough = world.StepsIn(kStillTime);
  JointConfiguration since = TakeConfiguration(world);
  int quiet = 0;
  for (int i = world.StepsIn(kLongestWait); i > 0 && quiet < enough; --i) {
    world.Step();
    if (world.monitor().lost()) return false;
    ++quiet;
    if (!HasTravelled(since, still, world)) continue;
    since = TakeConfiguration(world);
    quiet = 0;
  }
  return quiet >= enough;
}

void ComeToRest(ReplayWorld& world) {
  if (!WaitUntilStill(world)) world.monitor().AddUnrest();
  world.MonitorRest();
}

double FreeMotion(double ramp) {
  return ramp * ramp / 6 + ramp / 2 * kLongestWait + kLongestWait * kLongestWait / 2;
}

}  // namespace regrasp::sim
