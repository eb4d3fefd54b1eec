#include "bench/plate.h"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/mujoco/handles.h"
#include "planner/mujoco/memory_files.h"
#include "sim/ode/ode_world.h"
#include "sim/ode/patch_touch.h"

namespace regrasp {
namespace {

using Eigen::Vector3d;

constexpr double kWeight = 1 / (kPlateTime * kPlateTime);
constexpr int kRampSteps = 200, kHeldSteps = 500;
/// The balls reach into the plate by so much at the beginning.
constexpr double kFirstDepth = 1e-7;
/// MuJoCo contacts' time constant, in steps, and impedance, as in scenes/grasp.xml.
constexpr double kContactSteps = 2;

double ShareAt(int step) { return std::min(1.0, static_cast<double>(step) / kRampSteps); }

/// Follows where the plate is: x, y and the way of its supports in a turn.
class Track {
 public:
  void Add(int step, const Vector3d& at) {
    if (step == kRampSteps) start_ = at;
    if (step >= kRampSteps + kHeldSteps / 2) {
      motion_.creep = std::max(motion_.creep, (at - last_).norm() * kPlateTime / kPlateStep);
    }
    if (step >= kRampSteps) motion_.moved = std::max(motion_.moved, (at - start_).norm());
    last_ = at;
  }
  [[nodiscard]] const PlateMotion& motion() const { return motion_; }

 private:
  Vector3d start_ = Vector3d::Zero(), last_ = Vector3d::Zero();
  PlateMotion motion_;
};

std::string PlateMjcf(const Plate& plate, const std::string& cone, bool strict) {
  const auto number = [](double value) { return FormatDouble(value); };
  std::string text = "<mujoco><option timestep='" + number(kPlateStep) + "' cone='" + cone +
                     "' solver='Newton' iterations='50' tolerance='1e-10'" +
                     (strict ? " impratio='100'" : "") + "/><default><geom condim='3' friction='" +
                     number(plate.mu) + " 1e-5 1e-5' solref='" +
                     number(kContactSteps * kPlateStep) + " 1'" +
                     (strict ? " solimp='0.9999 0.9999 0.0001'" : "") +
                     "/></default><worldbody><body name='plate'><freejoint/>"
                     "<geom type='box' mass='1' size='" +
                     number(kPlateHalf) + " " + number(kPlateHalf) + " " +
                     number(kPlateHalfThickness) + "'/></body>";
  for (int i = 0; i < plate.points; ++i) {
    const Vector3d p = plate.ball(i);
    text += "<geom type='sphere' size='" + number(kPlateBall) + "' pos='" + number(p.x()) + " " +
            number(p.y()) + " " + number(p.z()) + "'/>";
  }
  return text + "</worldbody></mujoco>";
}

/// The underside as a patch, in the plate's frame.
sim::PatchPrism Underside() {
  sim::ContactPatch patch;
  const double z = -kPlateHalfThickness;
  patch.outline = {{-kPlateHalf, -kPlateHalf, z},
                   {-kPlateHalf, kPlateHalf, z},
                   {kPlateHalf, kPlateHalf, z},
                   {kPlateHalf, -kPlateHalf, z}};
  return sim::MakePrism(patch, Vector3d::UnitZ(), kPlateHalfThickness);
}

/// The plate in ODE.
class OdePlate {
 public:
  explicit OdePlate(const Plate& plate) : plate_(plate), forces_(plate.points, Vector3d::Zero()) {
    dWorldSetERP(world_.get(), 0.2);
    dWorldSetCFM(world_.get(), 1e-7 * kPlateStep);
    dWorldSetContactSurfaceLayer(world_.get(), kFirstDepth);
    dMass mass;
    dMassSetBoxTotal(&mass, 1, 2 * kPlateHalf, 2 * kPlateHalf, 2 * kPlateHalfThickness);
    dBodySetMass(body_, &mass);
  }

  void Step(double share, const BoxRule& rule, int solutions) {
    const dReal* p = dBodyGetPosition(body_);
    const dReal* q = dBodyGetQuaternion(body_);
    const dReal* v = dBodyGetLinearVel(body_);
    const dReal* w = dBodyGetAngularVel(body_);
    const std::array<dReal, 3> at{p[0], p[1], p[2]}, speed{v[0], v[1], v[2]},
        spin{w[0], w[1], w[2]};
    const std::array<dReal, 4> turn{q[0], q[1], q[2], q[3]};
    const Vector3d load = plate_.gravity(share), torque = plate_.torque(share);
    for (int i = 0; i < solutions; ++i) {
      dBodySetPosition(body_, at[0], at[1], at[2]);
      dBodySetQuaternion(body_, turn.data());
      dBodySetLinearVel(body_, speed[0], speed[1], speed[2]);
      dBodySetAngularVel(body_, spin[0], spin[1], spin[2]);
      dBodySetForce(body_, load.x(), load.y(), load.z());
      dBodySetTorque(body_, torque.x(), torque.y(), torque.z());
      if (Solve(rule)) return;
    }
  }
  [[nodiscard]] Vector3d Place() const {
    const dReal* p = dBodyGetPosition(body_);
    const dReal* R = dBodyGetRotation(body_);
    return {p[0], p[1], std::atan2(R[4], R[0]) * kPlateRadius};
  }

 private:
  /// @return whether all contacts keep their cones.
  bool Solve(const BoxRule& rule) {
    const dReal* p = dBodyGetPosition(body_);
    const dReal* q = dBodyGetQuaternion(body_);
    const Eigen::Isometry3d X =
        Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    dJointGroupEmpty(joints_.get());
    std::vector<dJointFeedback> feedback(plate_.points);
    std::vector<sim::FrictionBox> boxes(plate_.points);
    std::vector<Vector3d> normals(plate_.points, Vector3d::Zero());
    for (int i = 0; i < plate_.points; ++i) {
      const auto touch = sim::TouchPatch(
          underside_, X.inverse() * (plate_.ball(i) + kFirstDepth * Vector3d::UnitZ()), kPlateBall);
      if (!touch) continue;
      normals[i] = X.linear() * touch->normal;
      boxes[i] = rule(normals[i], forces_[i], plate_.mu);
      const Vector3d point = X * touch->point;
      dContact contact{};
      contact.surface.mode = dContactMu2 | dContactFDir1;
      contact.surface.mu = boxes[i].along;
      contact.surface.mu2 = boxes[i].across;
      contact.geom.depth = touch->depth;
      for (int k = 0; k < 3; ++k) {
        contact.geom.pos[k] = point[k];
        contact.geom.normal[k] = normals[i][k];
        contact.fdir1[k] = boxes[i].direction[k];
      }
      const dJointID joint = dJointCreateContact(world_.get(), joints_.get(), &contact);
      dJointAttach(joint, body_, nullptr);
      dJointSetFeedback(joint, &feedback[i]);
    }
    (void)sim::StepOde(world_.get(), kPlateStep);
    bool kept = true;
    for (int i = 0; i < plate_.points; ++i) {
      forces_[i] = Vector3d(feedback[i].f1[0], feedback[i].f1[1], feedback[i].f1[2]);
      if (normals[i].isZero()) continue;
      kept = kept &&
             sim::KeepsCone(normals[i], boxes[i], forces_[i], plate_.mu, kFirstDepth * kWeight);
    }
    return kept;
  }

  const Plate& plate_;
  sim::PatchPrism underside_ = Underside();
  sim::OdeWorld world_ = sim::MakeOdeWorld();
  sim::OdeJointsPtr joints_{dJointGroupCreate(0)};
  dBodyID body_ = dBodyCreate(world_.get());
  std::vector<Vector3d> forces_;
};

}  // namespace

double Plate::critical() const { return twist > 0 ? twist : std::tan(tilt); }

Vector3d Plate::gravity(double share) const {
  const double now = share * tilt;
  return kWeight * Vector3d(std::sin(now) * std::cos(azimuth), std::sin(now) * std::sin(azimuth),
                            -std::cos(now));
}

Vector3d Plate::torque(double share) const {
  return share * twist * kWeight * kPlateRadius * Vector3d::UnitZ();
}

Vector3d Plate::ball(int point) const {
  constexpr double kFirst = 0.3;
  const double angle = kFirst + 2 * std::numbers::pi * point / points;
  return {kPlateRadius * std::cos(angle), kPlateRadius * std::sin(angle),
          -kPlateHalfThickness - kPlateBall};
}

PlateMotion MoveInMujoco(const Plate& plate, const std::string& cone, bool strict) {
  mujoco::MemoryFiles files;
  files.Add("plate.xml", PlateMjcf(plate, cone, strict));
  std::array<char, 1000> error{};
  const mujoco::ModelPtr model(
      mj_loadXML("plate.xml", files.get(), error.data(), static_cast<int>(error.size())));
  if (!model) throw EnvironmentError(error.data());
  const mujoco::DataPtr data(mj_makeData(model.get()));
  Track track;
  for (int step = 0; step < kRampSteps + kHeldSteps; ++step) {
    const Vector3d gravity = plate.gravity(ShareAt(step)), torque = plate.torque(ShareAt(step));
    std::copy_n(gravity.data(), 3, model->opt.gravity);
    constexpr int kTorqueOfPlate = 6 + 3;
    std::copy_n(torque.data(), 3, data->xfrc_applied + kTorqueOfPlate);
    mj_step(model.get(), data.get());
    const mjtNum* q = data->qpos;
    track.Add(step, {q[0], q[1], 2 * std::atan2(q[6], q[3]) * kPlateRadius});
  }
  return track.motion();
}

PlateMotion MoveInOde(const Plate& plate, const BoxRule& rule, int solutions) {
  OdePlate ode(plate);
  Track track;
  for (int step = 0; step < kRampSteps + kHeldSteps; ++step) {
    ode.Step(ShareAt(step), rule, solutions);
    track.Add(step, ode.Place());
  }
  return track.motion();
}

}  // namespace regrasp
