#include "planner/kinematics/hand_model.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/fit_tip.h"
#include "planner/kinematics/joint_relations.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/plan/json_reader.h"

namespace regrasp::kinematics {
namespace {

using plan::JsonReader;

constexpr char kFormat[] = "regrasp-hand";
/// Smallest number of fingers, because a grasp requires three contacts.
constexpr std::size_t kFewestFingers = 3;
constexpr double kLargestRadius = 0.1;

std::string NonEmpty(const JsonReader& json) {
  std::string text = json.String();
  if (text.empty()) json.Fail("expected a name, found an empty one");
  return text;
}

Eigen::Vector3d Direction(const JsonReader& json) {
  const Eigen::Vector3d vector = json.Vector(3);
  if (!(vector.norm() > 1e-6)) json.Fail("expected a direction, found " + json.Quoted());
  return vector.normalized();
}

HandDescription::Tip ParseTip(const JsonReader& json) {
  const JsonReader tip = json.Member("tip");
  HandDescription::Tip parsed{NonEmpty(json.Member("name")), NonEmpty(tip.Member("body")),
                              tip.Member("centre").Vector(3), tip.Member("radius").Number()};
  if (!(parsed.radius > 0) || parsed.radius > kLargestRadius) {
    tip.Member("radius").Fail("expected metres in (0, 0.1], found " +
                              tip.Member("radius").Quoted());
  }
  return parsed;
}

HandDescription::Coupling ParseCoupling(const JsonReader& json) {
  HandDescription::Coupling parsed{NonEmpty(json.Member("joint")), NonEmpty(json.Member("follows")),
                                   json.Member("ratio").Number()};
  if (json.Has("offset")) parsed.offset = json.Member("offset").Number();
  if (parsed.ratio == 0) json.Member("ratio").Fail("expected a number other than 0");
  return parsed;
}

void ExpectDifferent(const std::vector<HandDescription::Tip>& tips, const JsonReader& json) {
  for (std::size_t i = 0; i < tips.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (tips[i].name == tips[j].name)
        json.Fail("names of fingers must be unique, found " + tips[i].name + " twice");
      if (tips[i].body == tips[j].body) {
        json.Fail("fingers " + tips[j].name + " and " + tips[i].name +
                  " must have different fingertips, found " + tips[i].body + " twice");
      }
    }
  }
}

}  // namespace

HandDescription ParseHandDescription(std::string_view text, const std::string& name) {
  const Json value = ParseJson(text, name);
  const JsonReader json(value, name);
  json.ExpectFormat(kFormat);
  HandDescription description;
  description.name = NonEmpty(json.Member("name"));
  description.model = NonEmpty(json.Member("model"));
  description.palm = NonEmpty(json.Member("palm"));
  description.up = Direction(json.Member("up"));
  const JsonReader fingers = json.Member("fingers");
  for (const JsonReader& finger : fingers.Elements()) description.tips.push_back(ParseTip(finger));
  if (description.tips.size() < kFewestFingers) {
    fingers.Fail("expected at least 3 fingers, found " + std::to_string(description.tips.size()));
  }
  ExpectDifferent(description.tips, fingers);
  if (json.Has("couplings")) {
    for (const JsonReader& coupling : json.Member("couplings").Elements()) {
      description.couplings.push_back(ParseCoupling(coupling));
    }
  }
  return description;
}

std::string FormatHandDescription(const HandDescription& description) {
  Json json = {{"format", kFormat},        {"version", 1},
               {"name", description.name}, {"model", description.model},
               {"palm", description.palm}, {"up", plan::VectorJson(description.up, 3)},
               {"fingers", Json::array()}};
  for (const HandDescription::Tip& tip : description.tips) {
    json["fingers"].push_back({{"name", tip.name},
                               {"tip",
                                {{"body", tip.body},
                                 {"centre", plan::VectorJson(tip.centre, 3)},
                                 {"radius", tip.radius}}}});
  }
  if (!description.couplings.empty()) {
    json["couplings"] = Json::array();
    for (const HandDescription::Coupling& coupling : description.couplings) {
      Json written = {
          {"joint", coupling.joint}, {"follows", coupling.follows}, {"ratio", coupling.ratio}};
      if (coupling.offset != 0) written["offset"] = coupling.offset;
      json["couplings"].push_back(std::move(written));
    }
  }
  return FormatJson(json);
}

namespace {

using collision::ConvexShape;
using Eigen::Vector3d;

/// Largest protrusion of a fingertip sphere from its link, metres. A soft cover, for example, has
/// no collision geom.
constexpr double kLargestProtrusion = 5e-3;
constexpr int kDirections = 1000;
constexpr double kSameCoupling = 1e-9;

/// Flags that change the simulated physics. All other flags are accepted.
constexpr std::pair<int, const char*> kPhysicsFlags[] = {
    {mjDSBL_CONSTRAINT, "constraint"},     {mjDSBL_EQUALITY, "equality"},
    {mjDSBL_FRICTIONLOSS, "frictionloss"}, {mjDSBL_LIMIT, "limit"},
    {mjDSBL_CONTACT, "contact"},           {mjDSBL_PASSIVE, "passive"},
    {mjDSBL_GRAVITY, "gravity"},           {mjDSBL_CLAMPCTRL, "clampctrl"},
    {mjDSBL_ACTUATION, "actuation"}};

[[noreturn]] void RefuseModel(const CompiledModel& compiled, const std::string& what) {
  throw InputError(compiled.text.files.front().string() + ": " + what);
}

void CheckOptions(const CompiledModel& compiled) {
  const mjOption& options = compiled.model->opt;
  for (const auto& [bit, name] : kPhysicsFlags) {
    if ((options.disableflags & bit) == 0) continue;
    RefuseModel(compiled, std::string("<flag> ") + name +
                              ": not supported, expected \"enable\", found \"disable\"");
  }
  if ((options.enableflags & mjENBL_OVERRIDE) != 0) {
    RefuseModel(compiled, "<flag> override: not supported, expected \"disable\", found \"enable\"");
  }
  const std::pair<const char*, double> kMedium[] = {{"wind", VectorAt(options.wind, 0).norm()},
                                                    {"density", options.density},
                                                    {"viscosity", options.viscosity}};
  for (const auto& [name, value] : kMedium) {
    if (value == 0) continue;
    RefuseModel(compiled, std::string("<option> ") + name + ": not supported, expected 0, found " +
                              FormatShort(value));
  }
}

void CheckActuators(const CompiledModel& compiled) {
  const mjModel& model = *compiled.model;
  for (int i = 0; i < model.nu; ++i) {
    const int type = model.actuator_trntype[i];
    if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT || type == mjTRN_TENDON) continue;
    const char* found = type == mjTRN_BODY          ? "adhesion of a body"
                        : type == mjTRN_SLIDERCRANK ? "a slider-crank"
                                                    : "a force at a site";
    RefuseModel(compiled, ActuatorName(model, i) +
                              ": moves no joint, expected actuators of joints or fixed tendons, "
                              "found " +
                              found);
  }
}

/// Return unit vectors spread evenly over the sphere.
std::vector<Vector3d> EvenDirections() {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vector3d> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kDirections;
    const double across = std::sqrt(1 - z * z);
    directions.emplace_back(across * std::cos(turn * i), across * std::sin(turn * i), z);
  }
  return directions;
}

/// Return the colliding geoms of a link in the frame of one of its bodies.
std::vector<ConvexShape> ShapesOfLink(const mjModel& model, const mjData& rest, int body) {
  const Eigen::Isometry3d to_body = PoseAt(rest.xpos, rest.xmat, body).inverse();
  std::vector<ConvexShape> shapes;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (!Collides(model, geom)) continue;
    if (LinkOf(model, model.geom_bodyid[geom]) != LinkOf(model, body)) continue;
    ConvexShape shape = ShapeOfGeom(model, geom);
    if (shape.points.empty()) continue;
    shapes.push_back(Moved(to_body * PoseAt(rest.geom_xpos, rest.geom_xmat, geom), shape));
  }
  return shapes;
}

/// Return the protrusion of a sphere from the convex hull of shapes, metres, by support functions.
double ProtrusionOf(const collision::BoundingSphere& sphere,
                    const std::vector<ConvexShape>& shapes) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& direction : EvenDirections()) {
    double support = -std::numeric_limits<double>::infinity();
    for (const ConvexShape& shape : shapes) {
      for (const Vector3d& point : shape.points) {
        support = std::max(support, direction.dot(point) + shape.radius);
      }
    }
    most = std::max(most, direction.dot(sphere.centre) + sphere.radius - support);
  }
  return most;
}

std::string RelationText(const JointRelation& relation) {
  return "ratio " + FormatShort(relation.ratio) + " and offset " + FormatShort(relation.offset);
}

}  // namespace

void CheckPhysics(const CompiledModel& compiled) {
  CheckOptions(compiled);
  CheckActuators(compiled);
}

void CheckCouplings(const HandModel& hand, const std::string& palm, const CompiledModel& compiled,
                    const std::string& file) {
  const mjModel& model = *compiled.model;
  std::vector<std::vector<int>> fingers;
  std::vector<std::pair<int, const Joint*>> joints;
  const int palm_body = mj_name2id(&model, mjOBJ_BODY, palm.c_str());
  for (const Finger& finger : hand.fingers) {
    const int tip = mj_name2id(&model, mjOBJ_BODY, finger.tip.body.c_str());
    fingers.push_back(JointsBetween(model, palm_body, tip));
    for (std::size_t k = 0; k < finger.joints.size(); ++k) {
      joints.emplace_back(fingers.back()[k], &finger.joints[k]);
    }
  }
  const auto find = [&](int id) -> const Joint& {
    return *std::ranges::find(joints, id, &std::pair<int, const Joint*>::first)->second;
  };
  for (const JointRelation& relation : ReadJointRelations(compiled, fingers)) {
    const Joint& joint = find(relation.joint);
    const Joint& leader = find(relation.leader);
    const std::string what = file + ": /couplings: joints " + joint.name + " and " + leader.name +
                             " are coupled in the model (" + relation.source + "), expected ";
    const std::string help = "; help: write the hand's file again with hand --model";
    if (joint.drive != leader.drive) {
      throw InputError(what + "a coupling with " + RelationText(relation) + ", found none" + help);
    }
    const double ratio = joint.ratio / leader.ratio;
    const double offset = joint.coupling_offset - ratio * leader.coupling_offset;
    const bool agrees = std::abs(ratio - relation.ratio) <= kSameCoupling * std::abs(ratio) &&
                        std::abs(offset - relation.offset) <= kSameCoupling;
    if (agrees || relation.shares_actuator) continue;
    throw InputError(what + RelationText(relation) + ", found ratio " + FormatShort(ratio) +
                     " and offset " + FormatShort(offset) + help);
  }
}

void CheckCollisionGeoms(const HandDescription& description, const CompiledModel& compiled,
                         const std::string& file) {
  const mjModel& model = *compiled.model;
  const DataPtr rest = AtRest(model);
  const auto shapes_of = [&](const std::string& where, const std::string& body) {
    const int id = mj_name2id(&model, mjOBJ_BODY, body.c_str());
    std::vector<ConvexShape> shapes = ShapesOfLink(model, *rest, id);
    if (!shapes.empty()) return shapes;
    throw InputError(file + ": " + where + ": body " + body +
                     " has no geom that collides, expected at least one with contype or "
                     "conaffinity other than 0");
  };
  static_cast<void>(shapes_of("/palm", description.palm));
  for (std::size_t i = 0; i < description.tips.size(); ++i) {
    const HandDescription::Tip& tip = description.tips[i];
    const std::string where = "/fingers/" + std::to_string(i) + "/tip";
    const double most = ProtrusionOf({tip.centre, tip.radius}, shapes_of(where, tip.body));
    if (most <= kLargestProtrusion) continue;
    const auto mm = [](double metres) { return FormatShort(1e3 * metres, 3) + " mm"; };
    throw InputError(file + ": " + where + ": the fingertip sphere reaches " + mm(most) +
                     " beyond the link of body " + tip.body + ", limit " + mm(kLargestProtrusion));
  }
}

void SetUp(const Eigen::Vector3d& up, HandModel& hand) {
  if (up == hand.up) return;
  hand.up = up;
  hand.has_own_up = false;
}

std::vector<Eigen::Vector3d> UpDirections(const HandModel& hand) {
  std::vector<Eigen::Vector3d> ups = {hand.up};
  for (const double sign : {1.0, -1.0}) {
    for (const Eigen::Index axis : {2, 1, 0}) {
      const Eigen::Vector3d up = sign * Eigen::Vector3d::Unit(axis);
      if (!up.isApprox(hand.up)) ups.push_back(up);
    }
  }
  return ups;
}

}  // namespace regrasp::kinematics
