#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/object/polyhedron.h"
#include "python/binding.h"
#include "sim/hand_grasps/grasp_conventions.h"
#include "sim/hand_grasps/grasp_protocols.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

using Values = py::array_t<double, py::array::c_style>;
using sim::HandConfiguration;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr int kProtocols = 4;

/// A hand around an object of one size.
struct PythonGraspWorld {
  sim::WholeHand hand;
  const object::Polyhedron* solid = nullptr;
  double scale = 1;
  std::unique_ptr<sim::GraspWorld> world;
  std::unique_ptr<sim::GraspGeometry> geometry;
};

/// Configurations of N hands: palm positions (N, 3), quaternions (N, 4) and joints (N, J).
using Configurations = std::tuple<Values, Values, Values>;

HandConfiguration ConfigurationOf(const Configurations& all, py::ssize_t grasp,
                                  const std::vector<std::string>& joint_names) {
  const auto& [positions, quaternions, joints] = all;
  HandConfiguration configuration;
  configuration.palm.translation() = Eigen::Vector3d::Map(positions.data(grasp, 0));
  const double* q = quaternions.data(grasp, 0);
  configuration.palm.linear() =
      Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  for (std::size_t j = 0; j < joint_names.size(); ++j) {
    configuration.joints[joint_names[j]] = joints.at(grasp, static_cast<py::ssize_t>(j));
  }
  return configuration;
}

PythonGraspWorld MakeGraspWorld(const std::filesystem::path& hand, const PythonObject& object,
                                double scale, const sim::GraspWorld::Pieces& pieces) {
  PythonGraspWorld made;
  made.solid = dynamic_cast<const object::Polyhedron*>(object.file.object.get());
  if (made.solid == nullptr) throw InputError("object must be a solid, found a polygon");
  made.scale = scale;
  const py::gil_scoped_release unlocked;
  made.hand = sim::ReadWholeHand(hand);
  made.world = std::make_unique<sim::GraspWorld>(made.hand, *made.solid, scale, pieces);
  made.geometry = std::make_unique<sim::GraspGeometry>(*made.world, *made.solid, scale);
  return made;
}

std::vector<std::string> LinkNames(const PythonGraspWorld& of) {
  std::vector<std::string> names;
  for (const int link : of.world->links())
    names.push_back(kinematics::BodyName(of.world->model(), link));
  return names;
}

/// Arrays of the results of N grasps. Values that a grasp does not have are NaN, faults -1.
struct ResultArrays {
  py::array_t<double> distance, quality, moved, rotated, seconds, resisted;
  py::array_t<std::int64_t> contacts;
  py::array_t<std::int8_t> faults;

  ResultArrays(py::ssize_t count, py::ssize_t links)
      : distance(count),
        quality(count),
        moved(count),
        rotated(count),
        seconds({count, py::ssize_t{sim::kLoadDirections}}),
        resisted({count, py::ssize_t{sim::kLoadDirections}}),
        contacts({count, links}),
        faults({count, py::ssize_t{kProtocols}}) {
    for (auto* array : {&distance, &quality, &moved, &rotated, &seconds, &resisted}) {
      std::fill_n(array->mutable_data(), array->size(), kNoValue);
    }
    std::fill_n(contacts.mutable_data(), contacts.size(), 0);
    std::fill_n(faults.mutable_data(), faults.size(), std::int8_t{-1});
  }

  void Set(py::ssize_t grasp, const std::vector<int>& links, const sim::GraspVerdict& verdict) {
    distance.mutable_at(grasp) = verdict.distance_m;
    for (const sim::LinkTouch& touch : verdict.touches) {
      const auto link = std::ranges::find(links, touch.link) - links.begin();
      contacts.mutable_at(grasp, link) = static_cast<std::int64_t>(touch.contacts.size());
    }
    for (const sim::ProtocolResult& result : verdict.results) {
      faults.mutable_at(grasp, static_cast<py::ssize_t>(result.protocol)) =
          static_cast<std::int8_t>(result.fault);
      if (result.quality) quality.mutable_at(grasp) = *result.quality;
      if (result.moved_m) moved.mutable_at(grasp) = *result.moved_m;
      if (result.rotated_deg) rotated.mutable_at(grasp) = *result.rotated_deg;
      for (std::size_t i = 0; i < result.seconds.size(); ++i) {
        if (result.seconds[i])
          seconds.mutable_at(grasp, static_cast<py::ssize_t>(i)) = *result.seconds[i];
      }
      for (std::size_t i = 0; i < result.resisted_N.size(); ++i) {
        resisted.mutable_at(grasp, static_cast<py::ssize_t>(i)) = result.resisted_N[i];
      }
    }
  }
};

/// Test grasps. @param index  index of each grasp in messages.
py::tuple TestGrasps(PythonGraspWorld& of, const std::vector<std::string>& joint_names,
                     const Configurations& grasps, const std::optional<Configurations>& pregrasps,
                     const std::optional<Configurations>& targets,
                     const std::vector<int>& protocols, double mu, double mass_kg,
                     const std::vector<std::int64_t>& index) {
  const py::ssize_t count = std::get<0>(grasps).shape(0);
  const std::vector<int>& links = of.world->links();
  ResultArrays arrays(count, static_cast<py::ssize_t>(links.size()));
  std::vector<sim::GraspProtocol> tests;
  for (const int protocol : protocols) tests.push_back(static_cast<sim::GraspProtocol>(protocol));
  for (py::ssize_t i = 0; i < count; ++i) {
    sim::HandGrasp grasp;
    grasp.scale = of.scale;
    grasp.grasp = ConfigurationOf(grasps, i, joint_names);
    if (pregrasps) grasp.pregrasp = ConfigurationOf(*pregrasps, i, joint_names);
    if (targets) grasp.target = ConfigurationOf(*targets, i, joint_names);
    const std::string where = "grasps[" + std::to_string(index[static_cast<std::size_t>(i)]) + "]";
    sim::GraspVerdict verdict;
    {
      const py::gil_scoped_release unlocked;
      sim::CheckGraspScale(grasp, of.hand, *of.solid, where);
      sim::CheckGraspConventions(grasp, of.hand, *of.solid, *of.world, where);
      verdict = sim::TestHandGrasp(grasp, *of.solid, *of.geometry, tests,
                                   {.mu = mu, .mass_kg = mass_kg}, *of.world);
    }
    arrays.Set(i, links, verdict);
  }
  return py::make_tuple(arrays.distance, arrays.contacts, arrays.faults, arrays.quality,
                        arrays.moved, arrays.rotated, arrays.seconds, arrays.resisted);
}

std::vector<std::string> FaultNames() {
  std::vector<std::string> names;
  for (int fault = 0; fault <= static_cast<int>(sim::GraspFault::kUnstable); ++fault) {
    names.emplace_back(sim::GraspFaultName(static_cast<sim::GraspFault>(fault)));
  }
  return names;
}

std::vector<std::string> ProtocolNames() {
  std::vector<std::string> names;
  for (int protocol = 0; protocol < kProtocols; ++protocol) {
    names.emplace_back(sim::GraspProtocolName(static_cast<sim::GraspProtocol>(protocol)));
  }
  return names;
}

}  // namespace

void BindHandGrasps(py::module_& module) {
  py::class_<PythonGraspWorld>(module, "GraspWorld")
      .def(py::init(&MakeGraspWorld), py::keep_alive<1, 3>())
      .def_property_readonly("hand", [](const PythonGraspWorld& of) { return of.hand.name; })
      .def_property_readonly("links", LinkNames)
      .def("test", TestGrasps);
  module.def("grasp_faults", FaultNames);
  module.def("grasp_protocols", ProtocolNames);
}

}  // namespace regrasp::python
