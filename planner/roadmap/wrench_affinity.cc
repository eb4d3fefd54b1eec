#include "planner/roadmap/wrench_affinity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace regrasp::roadmap {

namespace {

/// A direction along the surface must keep this share of its length there.
constexpr double kParallel = 1e-6;

/// arccos x to 7e-5, for −1 ≤ x ≤ 1 (Abramowitz and Stegun 1964, 4.4.45), without branches, so that
/// the compiler makes vectors of it: an affinity needs no more, and 32 million of them are taken
/// for a thousand contacts.
inline double FastArcCosine(double x) {
  const double a = std::min(std::abs(x), 1.0);
  const double positive =
      std::sqrt(1 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
  return x < 0 ? std::numbers::pi - positive : positive;
}

/// Whether a vector leads along the surface at a contact.
bool LeadsAlong(const Eigen::Vector3d& vector, const grasp::Contact& contact, double radius) {
  return contact.n.cross(vector).norm() > kParallel * radius;
}

}  // namespace

WrenchPyramid PyramidOf(const grasp::Contact& contact, const object::WrenchFrame& frame,
                        double half_angle, const Eigen::Vector3d& towards) {
  const Eigen::Vector3d u = (towards - contact.n.dot(towards) * contact.n).normalized();
  const Eigen::Vector3d v = contact.n.cross(u);
  const Eigen::Vector3d arm = (contact.p - frame.origin) / frame.radius;
  WrenchPyramid pyramid;
  for (int side = 0; side < kPyramidSides; ++side) {
    const double turn = 2 * std::numbers::pi * side / kPyramidSides;
    const Eigen::Vector3d force = std::cos(half_angle) * contact.n +
                                  std::sin(half_angle) * (std::cos(turn) * u + std::sin(turn) * v);
    pyramid.col(side) << force, arm.cross(force);
    pyramid.col(side).normalize();
  }
  return pyramid;
}

WrenchPyramid PyramidOf(const grasp::Contact& contact, const object::WrenchFrame& frame,
                        double half_angle, std::span<const grasp::Contact> others) {
  Eigen::Vector3d towards = contact.p - frame.origin;
  for (std::size_t i = 0; i < others.size() && !LeadsAlong(towards, contact, frame.radius); ++i) {
    towards = others[i].p - contact.p;
  }
  if (!LeadsAlong(towards, contact, frame.radius)) towards = contact.n.unitOrthogonal();
  return PyramidOf(contact, frame, half_angle, towards);
}

double WrenchDistance(const WrenchPyramid& a, const WrenchPyramid& b) {
  constexpr int m = kPyramidSides;
  Eigen::Matrix<double, m, m> angle = a.transpose() * b;
  for (int i = 0; i < m * m; ++i) angle.data()[i] = FastArcCosine(angle.data()[i]);
  double least = std::numeric_limits<double>::infinity();
  for (int shift = 0; shift < m; ++shift) {
    double sum = 0;
    for (int k = 0; k < m; ++k) sum += angle(k, (k + shift) % m);
    least = std::min(least, sum);
  }
  return least / m;
}

Eigen::MatrixXd WrenchDistances(std::span<const WrenchPyramid> pyramids, const Tell& tell) {
  const auto count = static_cast<Eigen::Index>(pyramids.size());
  Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(count, count);
  CountedProgress progress(tell, "comparing pairs of contact points", count * (count - 1) / 2);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      distances(i, j) = distances(j, i) = WrenchDistance(pyramids[i], pyramids[j]);
    }
    progress.Reach(j * (j + 1) / 2);
  }
  return distances;
}

}  // namespace regrasp::roadmap
