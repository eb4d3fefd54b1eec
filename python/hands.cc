#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include "planner/base/in_blocks.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/projection.h"
#include "python/binding.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

using Values = py::array_t<double, py::array::c_style>;

/// The angle of a coupled joint is not read; it follows from its independent joint.
kinematics::JointConfiguration ConfigurationOf(const kinematics::Finger& finger,
                                               const double* angles) {
  kinematics::JointConfiguration configuration =
      kinematics::JointConfiguration::Zero(finger.drives);
  std::vector<bool> known(static_cast<std::size_t>(finger.drives), false);
  for (std::size_t j = 0; j < finger.joints.size(); ++j) {
    const auto drive = static_cast<std::size_t>(finger.joints[j].drive);
    if (known[drive] && finger.joints[j].follows) continue;
    known[drive] = true;
    configuration[finger.joints[j].drive] = kinematics::DriveAngle(finger.joints[j], angles[j]);
  }
  return configuration;
}

/// Return the centres of the fingertip spheres in the palm frame, shape (N, F, 3), m.
/// @param angles  joint angles, shape (N, J), in the order of the fingers.
py::array_t<double> TipsOf(const PythonHand& of, const Values& angles) {
  const kinematics::HandModel& hand = of.file.hand;
  const auto fingers = static_cast<py::ssize_t>(hand.fingers.size());
  py::array_t<double> tips({angles.shape(0), fingers, py::ssize_t{3}});
  auto out = tips.mutable_unchecked<3>();
  for (py::ssize_t g = 0; g < angles.shape(0); ++g) {
    py::ssize_t joint = 0;
    for (py::ssize_t f = 0; f < fingers; ++f) {
      const kinematics::Finger& finger = hand.fingers[static_cast<std::size_t>(f)];
      const auto tip = kinematics::TipAt(finger, ConfigurationOf(finger, angles.data(g, joint)));
      for (py::ssize_t i = 0; i < 3; ++i) out(g, f, i) = tip.centre[i];
      joint += static_cast<py::ssize_t>(finger.joints.size());
    }
  }
  return tips;
}

std::vector<std::vector<std::string>> JointNames(const PythonHand& of) {
  std::vector<std::vector<std::string>> names;
  for (const kinematics::Finger& finger : of.file.hand.fingers) {
    names.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) names.back().push_back(joint.name);
  }
  return names;
}

/// Return the nearest points of the surface and the normals there, for points (M, 3). Uses all
/// cores.
py::tuple NearestOf(const PythonObject& object, const Values& points) {
  py::array_t<double> nearest({points.shape(0), py::ssize_t{3}});
  py::array_t<double> normals({points.shape(0), py::ssize_t{3}});
  const double* from = points.data();
  double* to = nearest.mutable_data();
  double* inward = normals.mutable_data();
  const auto count = static_cast<std::size_t>(points.shape(0));
  const py::gil_scoped_release unlocked;
  constexpr std::size_t kBlock = 64;
  InBlocks(count, kBlock, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
      const grasp::Contact found =
          plan::NearestContact(*object.file.object, {Eigen::Vector3d::Map(from + i), {}});
      Eigen::Vector3d::Map(to + i) = found.p;
      Eigen::Vector3d::Map(inward + i) = found.n;
    }
  });
  const py::gil_scoped_acquire locked;
  return py::make_tuple(nearest, normals);
}

}  // namespace

void BindHands(py::module_& module) {
  py::class_<PythonHand>(module, "Hand")
      .def_property_readonly("sha256", [](const PythonHand& of) { return of.file.hand.sha256; })
      .def_property_readonly("name", [](const PythonHand& of) { return of.file.hand.name; })
      .def_property_readonly("file", [](const PythonHand& of) { return of.file.hand.file; })
      .def_property_readonly("path", [](const PythonHand& of) { return of.path; })
      .def_property_readonly("fingers",
                             [](const PythonHand& of) {
                               std::vector<std::string> names;
                               for (const auto& f : of.file.hand.fingers) names.push_back(f.name);
                               return names;
                             })
      .def_property_readonly("radii",
                             [](const PythonHand& of) {
                               std::vector<double> radii;
                               for (const auto& f : of.file.hand.fingers)
                                 radii.push_back(f.tip.radius);
                               return radii;
                             })
      .def_property_readonly("joint_names", JointNames)
      .def("tips", TipsOf);
  module.def("read_hand", [](const std::filesystem::path& path) {
    return PythonHand{kinematics::ReadHandFile(path), path};
  });
  module.def("nearest", NearestOf);
}

}  // namespace regrasp::python
