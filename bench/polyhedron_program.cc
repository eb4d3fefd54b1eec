#include "bench/polyhedron_program.h"

#include <CGAL/Gmpz.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <cmath>
#include <numbers>

namespace regrasp {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kSides = 8;
/// Resolution of the rows: exact arithmetic is faster on short numbers.
constexpr double kUnit = 1.0 / (1 << 20);
constexpr int kMargin = 11;  // after three coordinates of the focus point and eight of the contacts

using Program = CGAL::Quadratic_program<int>;

int Rounded(double value) { return static_cast<int>(std::lround(value / kUnit)); }

void SetFocusTerm(Program& program, int row, const Vector3d& factor) {
  for (int axis = 0; axis < 3; ++axis) program.set_a(axis, row, Rounded(factor[axis]));
}

void SetContactTerm(Program& program, int contact, int row, const Vector2d& factor) {
  for (int axis = 0; axis < 2; ++axis) {
    program.set_a(3 + 2 * contact + axis, row, Rounded(factor[axis]));
  }
}

/// Add the constraint that the contact is on its part.
void AddPart(Program& program, int contact, const polyhedron::FacePart& part, int& row) {
  const std::vector<Vector2d> outline = part.outline();
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i, ++row) {
    const Vector2d along = outline[(i + 1) % n] - outline[i];
    const Vector2d outward(along.y(), -along.x());
    SetContactTerm(program, contact, row, outward);
    program.set_b(row, Rounded(outward.dot(outline[i])));
  }
}

/// Add the constraint that the focus point is in the contact's pyramid. With the foot of the focus
/// point: a · (foot − contact) + margin ≤ r · height for the normals a of the pyramid's sides.
void AddPyramid(Program& program, int contact, const polyhedron::FacePart& part, bool inner,
                double tangent, int& row) {
  const double radius = tangent * std::cos(std::numbers::pi / kSides);
  const Vector3d axis = inner ? part.normal : Vector3d(-part.normal);
  for (int side = 0; side < kSides; ++side, ++row) {
    const double angle = 2 * std::numbers::pi * side / kSides;
    const Vector2d a(std::cos(angle), std::sin(angle));
    const Vector3d factor = a.x() * part.u + a.y() * part.v - radius * axis;
    SetFocusTerm(program, row, factor);
    SetContactTerm(program, contact, row, -a);
    program.set_a(kMargin, row, Rounded(1));
    program.set_b(row, Rounded(factor.dot(part.origin)));
  }
}

}  // namespace

bool HasPieceByProgram(const polyhedron::FaceParts& parts, const std::array<int, 4>& halves,
                       double tangent) {
  Program program(CGAL::SMALLER, false, 0, false, 0);
  int row = 0;
  for (int contact = 0; contact < 4; ++contact) {
    const polyhedron::FacePart& part = parts.parts[halves[contact] / 2];
    AddPart(program, contact, part, row);
    AddPyramid(program, contact, part, halves[contact] % 2 == 0, tangent, row);
  }
  program.set_u(kMargin, true, 1);
  program.set_c(kMargin, -1);
  const auto solution = CGAL::solve_linear_program(program, CGAL::Gmpz());
  return solution.is_optimal() && solution.objective_value() < 0;
}

}  // namespace regrasp
