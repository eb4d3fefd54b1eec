#include "planner/object/body_measures.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "planner/base/number.h"

namespace regrasp::object {

namespace {

using DiameterKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<DiameterKernel>>;

/// Largest number of points for which testing all pairs is faster than building a tree.
constexpr std::size_t kFewPoints = 256;

double LargestSquaredByPairs(std::span<const Eigen::Vector3d> points) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, (points[i] - points[j]).squaredNorm());
    }
  }
  return largest;
}

/// Directions in which the width of a solid is measured, in addition to normals of its faces.
constexpr int kWidthDirections = 200;

/// Relative bound on the rounding of distances.
constexpr double kSlack = 1e-9;

const Eigen::Vector3d& FarthestFrom(const Eigen::Vector3d& point,
                                    std::span<const Eigen::Vector3d> points) {
  return *std::ranges::max_element(
      points, {}, [&](const Eigen::Vector3d& p) { return (p - point).squaredNorm(); });
}

/// Return a point at an end of the bounding box along its longest direction.
const Eigen::Vector3d& EndOfBox(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(p);
  Eigen::Index longest = 0;
  box.sizes().maxCoeff(&longest);
  return *std::ranges::min_element(points, {},
                                   [&](const Eigen::Vector3d& p) { return p[longest]; });
}

/// Return the points that can be ends of the diameter.
///
/// If all points are within r of a centre and two of them are L apart, then an end is at least L −
/// r from the centre. Elongated objects have few such points.
std::vector<DiameterKernel::Point_3> FindOuter(std::span<const Eigen::Vector3d> points) {
  const Eigen::Vector3d& one = FarthestFrom(EndOfBox(points), points);
  const Eigen::Vector3d& other = FarthestFrom(one, points);
  const Eigen::Vector3d centre = one / 2 + other / 2;
  const double radius = (FarthestFrom(centre, points) - centre).norm();
  const double least = (other - one).norm() - radius - kSlack * radius;
  std::vector<DiameterKernel::Point_3> outer;
  for (const auto& p : points) {
    if ((p - centre).norm() >= least) outer.emplace_back(p.x(), p.y(), p.z());
  }
  return outer;
}

double LargestSquaredByTree(std::span<const Eigen::Vector3d> points) {
  const std::vector<DiameterKernel::Point_3> copies = FindOuter(points);
  Search::Tree tree(copies.begin(), copies.end());
  constexpr bool kNearest = false;  // search the farthest point instead
  double largest = 0;
  for (const auto& p : copies) {
    const Search farthest(tree, p, 1, 0.0, kNearest);
    // Recomputed, because the search accumulates its distance incrementally, which rounds.
    const DiameterKernel::Vector_3 difference = farthest.begin()->first - p;
    largest = std::max(largest, difference.squared_length());
  }
  return largest;
}

}  // namespace

double ComputeDiameter(std::span<const Eigen::Vector3d> points) {
  return std::sqrt(points.size() <= kFewPoints ? LargestSquaredByPairs(points)
                                               : LargestSquaredByTree(points));
}

namespace {

struct LengthUnit {
  const char* name;
  double metres;
};

/// Usual units of files, most likely first.
constexpr std::array<LengthUnit, 4> kUnits = {
    {{"millimetres", 0.001}, {"centimetres", 0.01}, {"inches", 0.0254}, {"metres", 1}}};

/// Range of the size of most objects that a hand grasps, m.
constexpr double kSmallestGuess = 0.02, kLargestGuess = 0.4;

}  // namespace

double MeasureWidth(const Polyhedron& solid) {
  double width = std::numeric_limits<double>::infinity();
  const auto measure = [&](const Eigen::Vector3d& direction) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const Eigen::Vector3d& vertex : solid.vertices()) {
      least = std::min(least, vertex.dot(direction));
      most = std::max(most, vertex.dot(direction));
    }
    width = std::min(width, most - least);
  };
  for (FaceIndex face{0}; face < solid.face_count(); ++face) measure(solid.inward_normal(face));
  // Points of a Fibonacci lattice on the sphere.
  for (int k = 0; k < kWidthDirections; ++k) {
    const double z = 1 - (2 * k + 1.0) / kWidthDirections;
    const double turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    measure({r * std::cos(turn), r * std::sin(turn), z});
  }
  return width;
}

BodyMeasures MeasureBody(const Object& object, double scale, double density_kg_m3,
                         std::optional<double> thickness) {
  BodyMeasures body;
  body.diameter_m = object.diameter() * scale;
  const bool planar = object.dimension() == 2;
  if (planar) body.thickness_m = thickness.value_or(kPrismThickness * object.diameter()) * scale;
  body.mass_kg = density_kg_m3 * object.mass_properties().volume * scale * scale *
                 (planar ? body.thickness_m : scale);
  return body;
}

std::string MeasuresText(const BodyMeasures& body) {
  const std::string thick = body.thickness_m > 0 ? FormatLength(body.thickness_m) + " thick, " : "";
  return FormatLength(body.diameter_m) + " across, " + thick + FormatMass(body.mass_kg);
}

std::string UnitText(const std::string& unit) {
  if (unit.empty()) return "";
  return "; the file is in " + unit + (unit == "metres" ? "" : ", read as metres");
}

std::string SizeWarning(const BodyMeasures& body, double scale) {
  if (body.diameter_m >= kSmallestUsual && body.diameter_m <= kLargestUsual) return "";
  const double units = body.diameter_m / scale;
  const auto unit = std::ranges::find_if(kUnits, [&](const LengthUnit& guess) {
    return units * guess.metres >= kSmallestGuess && units * guess.metres <= kLargestGuess;
  });
  const std::string size = "the object is " + MeasuresText(body) + "; help: ";
  if (unit == kUnits.end()) {
    return size +
           "pass the length of a file unit in metres with --scale, for example 0.001 for "
           "millimetres";
  }
  return size + "if the file is in " + unit->name + ", pass --scale " + FormatShort(unit->metres) +
         " (" + FormatLength(units * unit->metres) + " across)";
}

}  // namespace regrasp::object
