#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/body_measures.h"
#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"
#include "planner/repair/repair.h"
#include "python/binding.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

using Vertices = py::array_t<double, py::array::c_style>;
using Faces = py::array_t<std::int64_t, py::array::c_style>;

PythonObject ReadFileAsObject(const std::filesystem::path& path, double scale, bool repaired,
                              std::optional<object::Shells> shells, py::object progress) {
  Interrupt interrupt({}, std::move(progress));
  object::Reading reading;
  reading.deadline = interrupt.deadline();
  reading.progress = interrupt.progress();
  reading.shells = shells;
  std::optional<PythonObject> read;
  {
    const py::gil_scoped_release unlocked;
    try {
      read = PythonObject{
          repaired ? repair::ReadRepaired(path, {}, reading) : object::ReadObject(path, reading),
          scale, "", shells};
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    } catch (const object::MeshError& error) {
      throw InputError(error.what() + repair::RepairHint(path, reading));
    }
  }
  interrupt.ThrowIfRaised();
  return std::move(*read);
}

/// Create an object whose file content is `text`.
PythonObject FromText(std::string text, const std::string& name,
                      std::unique_ptr<const object::Object> made, double scale) {
  PythonObject result;
  result.file = {name, Sha256(text), std::move(made)};
  result.scale = scale;
  result.text = std::move(text);
  return result;
}

PythonObject FromArrays(const Vertices& vertices, const Faces& faces, double scale,
                        const std::string& name) {
  object::PolygonSoup soup;
  const auto v = vertices.unchecked<2>();
  for (py::ssize_t i = 0; i < v.shape(0); ++i) {
    soup.vertices.emplace_back(v(i, 0), v(i, 1), v(i, 2));
  }
  const auto f = faces.unchecked<2>();
  for (py::ssize_t i = 0; i < f.shape(0); ++i) {
    std::vector<int>& facet = soup.facets.emplace_back();
    for (py::ssize_t j = 0; j < f.shape(1); ++j) facet.push_back(static_cast<int>(f(i, j)));
  }
  const py::gil_scoped_release unlocked;
  // Convert through the text, so that the programs get the same object from the file.
  std::string text = repair::FormatSolid(soup);
  auto solid = std::make_unique<object::Polyhedron>(
      object::Polyhedron::FromSoup(object::ReadObj(text, name), name));
  return FromText(std::move(text), name, std::move(solid), scale);
}

PythonObject FromWkt(const std::string& text, double scale, const std::string& name) {
  auto polygon = std::make_unique<object::Polygon>(object::Polygon::FromWkt(text, name));
  return FromText(text, name, std::move(polygon), scale);
}

/// Return the vertices of a solid's surface, or those of a polygon's outer ring.
py::array_t<double> VerticesOf(const PythonObject& of) {
  std::vector<Eigen::Vector3d> corners;
  const object::Object& object = *of.file.object;
  const int dimension = object.dimension();
  if (const auto* solid = dynamic_cast<const object::Polyhedron*>(&object)) {
    corners = solid->vertices();
  } else {
    for (const auto& p : dynamic_cast<const object::Polygon&>(object).rings().front()) {
      corners.emplace_back(p.x(), p.y(), 0);
    }
  }
  py::array_t<double> array({static_cast<py::ssize_t>(corners.size()), py::ssize_t{dimension}});
  auto a = array.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < a.shape(0); ++i) {
    for (py::ssize_t j = 0; j < dimension; ++j) a(i, j) = corners[i][j];
  }
  return array;
}

py::array_t<std::int64_t> TrianglesOf(const PythonObject& of) {
  const auto* solid = dynamic_cast<const object::Polyhedron*>(of.file.object.get());
  static const std::vector<std::array<int, 3>> kNone;
  const auto& triangles = solid != nullptr ? solid->triangles() : kNone;
  py::array_t<std::int64_t> array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
  auto a = array.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < a.shape(0); ++i) {
    for (py::ssize_t j = 0; j < 3; ++j) a(i, j) = triangles[i][j];
  }
  return array;
}

}  // namespace

void BindObjects(py::module_& module) {
  py::enum_<object::Shells>(module, "Shells")
      .value("union", object::Shells::kUnion)
      .value("largest", object::Shells::kLargest);
  py::class_<PythonObject>(module, "Object")
      .def_property_readonly("name", [](const PythonObject& o) { return o.file.file; })
      .def_property_readonly("sha256", [](const PythonObject& o) { return o.file.sha256; })
      .def_readonly("scale", &PythonObject::scale)
      .def_readonly("text", &PythonObject::text)
      .def_property_readonly("dimension",
                             [](const PythonObject& o) { return o.file.object->dimension(); })
      .def_property_readonly("face_count",
                             [](const PythonObject& o) { return o.file.object->face_count(); })
      .def_property_readonly("diameter",
                             [](const PythonObject& o) { return o.file.object->diameter(); })
      .def_property_readonly(
          "measure", [](const PythonObject& o) { return o.file.object->mass_properties().volume; })
      .def_property_readonly("centroid",
                             [](const PythonObject& o) {
                               const auto& c = o.file.object->mass_properties().centroid;
                               return std::array{c.x(), c.y(), c.z()};
                             })
      .def_property_readonly(
          "size_text",
          [](const PythonObject& o) {
            return object::MeasuresText(object::MeasureBody(*o.file.object, o.scale)) +
                   " at the density of water";
          })
      .def_property_readonly("vertices", VerticesOf)
      .def_property_readonly("triangles", TrianglesOf);
  module.def("read_object", ReadFileAsObject);
  module.def("object_from_arrays", FromArrays);
  module.def("object_from_wkt", FromWkt);
}

}  // namespace regrasp::python
