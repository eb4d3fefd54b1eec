#include "sim/actuation/trajectory.h"

#include "planner/base/number.h"
#include "planner/base/zip_archive.h"

namespace regrasp::sim {
namespace {

const std::vector<std::string> kObjectColumns = {
    "object_x_m", "object_y_m", "object_z_m", "object_qw", "object_qx", "object_qy", "object_qz"};

/// Format a field of a row, in quotes if RFC 4180 requires them.
std::string Field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

const char* RoleName(plan::FingerRole role) {
  switch (role) {
    case plan::FingerRole::kFree:
      return "free";
    case plan::FingerRole::kHolding:
      return "holding";
    case plan::FingerRole::kPlaced:
      return "placed";
    case plan::FingerRole::kReleased:
      return "released";
    case plan::FingerRole::kMoved:
      return "moved";
  }
  return "";
}

}  // namespace

std::string FormatTrajectory(const std::vector<plan::Snapshot>& samples) {
  std::string csv =
      "time_s,finger,role,tip_x_m,tip_y_m,tip_z_m,contact_x_m,contact_y_m,contact_z_m,"
      "normal_x,normal_y,normal_z,force_x_N,force_y_N,force_z_N\r\n";
  for (const plan::Snapshot& sample : samples) {
    for (const plan::FingerState& state : sample.fingers) {
      csv += FormatDouble(sample.time_s) + "," + std::to_string(state.finger) + "," +
             RoleName(state.role);
      for (const Eigen::Vector3d* v :
           {&state.tip_W, &state.contact_W, &state.normal_W, &state.force_W}) {
        for (const double x : *v) csv += "," + FormatDouble(x);
      }
      csv += "\r\n";
    }
  }
  return csv;
}

void HandTrajectory::Add(const HandWorld& world) {
  const double half_step = world.timestep() / 2;
  if (samples_.empty()) {
    for (const kinematics::Finger& finger : world.hand().fingers) {
      for (const kinematics::Joint& joint : finger.joints) joint_names_.push_back(joint.name);
    }
    control_names_ = world.control_names();
  } else if (world.time() < samples_.back().time_s + kInterval - half_step) {
    return;
  }
  Sample& sample = samples_.emplace_back();
  sample.time_s = world.time();
  const plan::HandState state = world.state();
  for (const std::vector<double>& finger : state.joints) {
    sample.joints.insert(sample.joints.end(), finger.begin(), finger.end());
  }
  sample.controls = world.controls();
  const Eigen::Vector3d& p = state.pose.translation();
  const Eigen::Quaterniond q(state.pose.linear());
  sample.object = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

std::string HandTrajectory::FormatCsv() const {
  std::string csv = "time_s";
  for (const std::string& name : joint_names_) csv += "," + Field(name);
  for (const std::string& name : control_names_) csv += "," + Field("control " + name);
  for (const std::string& name : kObjectColumns) csv += "," + name;
  csv += "\r\n";
  for (const Sample& sample : samples_) {
    csv += FormatDouble(sample.time_s);
    for (const std::vector<double>* values : {&sample.joints, &sample.controls, &sample.object}) {
      for (const double value : *values) csv += "," + FormatDouble(value);
    }
    csv += "\r\n";
  }
  return csv;
}

std::string HandTrajectory::FormatNpz() const {
  const std::size_t count = samples_.size();
  NpzArray time{"time_s", {count}};
  NpzArray joints{"joints", {count, joint_names_.size()}};
  NpzArray controls{"controls", {count, control_names_.size()}};
  NpzArray object{"object", {count, kObjectColumns.size()}};
  const auto append = [](const std::vector<double>& row, NpzArray& array) {
    array.values.insert(array.values.end(), row.begin(), row.end());
  };
  for (const Sample& sample : samples_) {
    time.values.push_back(sample.time_s);
    append(sample.joints, joints);
    append(sample.controls, controls);
    append(sample.object, object);
  }
  return regrasp::FormatNpz({time,
                             joints,
                             controls,
                             object,
                             {"joint_names", {joint_names_.size()}, {}, joint_names_},
                             {"control_names", {control_names_.size()}, {}, control_names_}});
}

}  // namespace regrasp::sim
