#include "pyramid_program.h"

#include <glpk.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace regrasp::grasp {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr int kRows = 7;  // balance, and the sum of the normal forces
/// Lower bound of the margin, below every number in the tests.
constexpr double kLeastMargin = -1e3;

/// Force and its torque about the contact's normal.
struct Edge {
  Eigen::Vector3d force;
  double torque = 0;
};

Vector6 WrenchOf(const Contact& contact, const object::WrenchFrame& frame, const Edge& edge) {
  const Eigen::Vector3d torque =
      (contact.p - frame.origin).cross(edge.force) + edge.torque * contact.n;
  Vector6 wrench;
  wrench << edge.force, torque / frame.radius;
  return wrench;
}

class Program {
 public:
  Program() : problem_(glp_create_prob(), &glp_delete_prob) {
    glp_set_obj_dir(problem_.get(), GLP_MAX);
    glp_add_rows(problem_.get(), kRows);
  }

  void SetRow(int row, double value) {
    glp_set_row_bnds(problem_.get(), row, GLP_FX, value, value);
  }

  /// Add a column with a wrench, its contribution to the sum of normal forces, and its lower bound.
  int AddColumn(const Vector6& wrench, double normal, double least) {
    const int column = glp_add_cols(problem_.get(), 1);
    glp_set_col_bnds(problem_.get(), column, GLP_LO, least, 0);
    std::array<int, kRows + 1> rows{};
    std::array<double, kRows + 1> values{};
    for (int r = 1; r <= kRows; ++r) {
      rows[r] = r;
      values[r] = r < kRows ? wrench[r - 1] : normal;
    }
    glp_set_mat_col(problem_.get(), column, kRows, rows.data(), values.data());
    return column;
  }

  std::optional<double> Maximise(int column) {
    glp_set_obj_coef(problem_.get(), column, 1);
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_OFF;
    const bool solved = glp_simplex(problem_.get(), &parameters) == 0;
    if (!solved || glp_get_status(problem_.get()) != GLP_OPT) return std::nullopt;
    return glp_get_obj_val(problem_.get());
  }

 private:
  std::unique_ptr<glp_prob, void (*)(glp_prob*)> problem_;
};

/// Return points on the unit sphere: the poles and bands between them.
/// Every direction is within an angle δ of a point, composed of half a band and half of the spacing
/// of two meridians. Hence the hull contains the ball of radius cos δ.
std::vector<Eigen::Vector3d> SpherePoints(const Pyramid& pyramid) {
  const int bands = pyramid.sides / 2;
  const double apart = std::numbers::pi / bands;
  const double within = apart / 2 + std::numbers::pi / pyramid.sides;
  const double radius = pyramid.circumscribed ? 1 / std::cos(within) : 1;
  std::vector<Eigen::Vector3d> points = {{0, 0, radius}, {0, 0, -radius}};
  for (int band = 1; band < bands; ++band) {
    const double polar = band * apart;
    for (int side = 0; side < pyramid.sides; ++side) {
      const double angle = 2 * std::numbers::pi * side / pyramid.sides;
      points.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(angle),
                                                std::sin(polar) * std::sin(angle),
                                                std::cos(polar)));
    }
  }
  return points;
}

/// Return points on the unit circle, or outside it such that their polygon contains it.
std::vector<Eigen::Vector3d> CirclePoints(const Pyramid& pyramid) {
  const double radius = pyramid.circumscribed ? 1 / std::cos(std::numbers::pi / pyramid.sides) : 1;
  std::vector<Eigen::Vector3d> points;
  for (int side = 0; side < pyramid.sides; ++side) {
    const double angle = 2 * std::numbers::pi * side / pyramid.sides;
    points.push_back(radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return points;
}

/// Return the edges of a contact's pyramid for unit normal force; in the plane those of the cone
/// itself.
std::vector<Edge> Edges(const Contact& contact, int dimension, double friction_angle,
                        const Pyramid& pyramid) {
  const double tangential = std::tan(friction_angle);
  if (dimension == 2) {
    const Eigen::Vector3d tangent(-contact.n.y(), contact.n.x(), 0);
    return {{contact.n + tangential * tangent}, {contact.n - tangential * tangent}};
  }
  const Eigen::Vector3d first = contact.n.unitOrthogonal();
  const Eigen::Vector3d second = contact.n.cross(first);
  std::vector<Edge> edges;
  for (const Eigen::Vector3d& point :
       contact.torsion > 0 ? SpherePoints(pyramid) : CirclePoints(pyramid)) {
    edges.push_back({contact.n + tangential * (point.x() * first + point.y() * second),
                     tangential * contact.torsion * point.z()});
  }
  return edges;
}

}  // namespace

std::optional<double> PyramidMargin(std::span<const Contact> contacts,
                                    const object::WrenchFrame& frame, double friction_angle,
                                    const Pyramid& pyramid, const Wrench& load) {
  Program program;
  for (int r = 0; r < 3; ++r) {
    program.SetRow(1 + r, -load.force[r]);
    program.SetRow(4 + r, -load.torque_over_radius[r]);
  }
  program.SetRow(kRows, 1);
  Vector6 inset = Vector6::Zero();
  for (const Contact& contact : contacts) {
    inset += WrenchOf(contact, frame, {contact.n}) / static_cast<double>(contacts.size());
    for (const Edge& edge : Edges(contact, frame.dimension, friction_angle, pyramid)) {
      program.AddColumn(WrenchOf(contact, frame, edge), 1, 0);
    }
  }
  return program.Maximise(program.AddColumn(inset, 1, kLeastMargin));
}

}  // namespace regrasp::grasp
