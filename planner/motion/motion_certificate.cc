#include "planner/motion/motion_certificate.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Bounds the rounding of the sums of at most 64 products of numbers below 2, with forces that sum
/// to 1; what is left inside the cones must exceed it.
constexpr double kRounding = 1e-13;

/// The same for the eigenvalues of G Gᵀ, relative to the largest.
constexpr double kEigenvalueRounding = 1e-12;

/// The wrench (force, q × force), force x, y and torque z in the plane.
VectorXd WrenchOf(const Vector3d& q, const Vector3d& force, int dimension) {
  const Vector3d torque = q.cross(force);
  if (dimension == 2) return Vector3d(force.x(), force.y(), torque.z());
  VectorXd wrench(6);
  wrench << force, torque;
  return wrench;
}

/// Distance of a force to the border of the cone about n; negative outside.
double DistanceInside(const Vector3d& force, const Vector3d& n, double half_angle) {
  const double normal = force.dot(n);
  return normal * std::sin(half_angle) - (force - normal * n).norm() * std::cos(half_angle);
}

/// The grasp at the centre of the interval in the contacts' own frame, with its velocities.
struct MovingGrasp {
  int dimension;
  Grasp contacts;
  WrenchFrame frame;
  std::vector<Vector3d> q;
  std::vector<Vector3d> v;
  MatrixXd matrix;  ///< G: one block of columns per contact

  MovingGrasp(const GraspMotion& motion, int space, double centre)
      : dimension(space),
        contacts(GraspAt(motion, centre)),
        frame(ContactFrame(contacts, space)),
        matrix(space == 3 ? 6 : 3, space * static_cast<int>(motion.size())) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      q.push_back((contacts[i].p - frame.origin) / frame.radius);
      v.push_back(motion[i].velocity() / frame.radius);
      for (int axis = 0; axis < space; ++axis) {
        matrix.col(static_cast<int>(i) * space + axis) =
            WrenchOf(q.back(), Vector3d::Unit(axis), space);
      }
    }
  }

  /// Σ (w × x, as a wrench) of the torques alone.
  [[nodiscard]] VectorXd TorqueOf(const std::vector<Vector3d>& arms,
                                  const std::vector<Vector3d>& forces) const {
    VectorXd sum = VectorXd::Zero(matrix.rows());
    for (std::size_t i = 0; i < arms.size(); ++i) {
      VectorXd wrench = WrenchOf(arms[i], forces[i], dimension);
      wrench.head(dimension).setZero();
      sum += wrench;
    }
    return sum;
  }

  [[nodiscard]] VectorXd Balance(const std::vector<Vector3d>& forces) const {
    VectorXd sum = VectorXd::Zero(matrix.rows());
    for (std::size_t i = 0; i < q.size(); ++i) sum += WrenchOf(q[i], forces[i], dimension);
    return sum;
  }

  /// A lower bound on the least singular value of G.
  [[nodiscard]] double LeastSingularValue() const {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix * matrix.transpose(),
                                                         Eigen::EigenvaluesOnly);
    const VectorXd& values = solver.eigenvalues();
    const double least = values.minCoeff() - kEigenvalueRounding * values.maxCoeff();
    return std::sqrt(std::max(least, 0.0));
  }

  /// The least forces whose wrenches sum to −wrench.
  [[nodiscard]] std::vector<Vector3d> ForcesAgainst(const VectorXd& wrench) const {
    const VectorXd stacked =
        -matrix.transpose() * (matrix * matrix.transpose()).ldlt().solve(wrench);
    std::vector<Vector3d> forces(q.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < forces.size(); ++i) {
      forces[i].head(dimension) = stacked.segment(static_cast<int>(i) * dimension, dimension);
    }
    return forces;
  }
};

}  // namespace

bool CertifyForceClosure(const GraspMotion& motion, int dimension, double half_angle, double centre,
                         double reach) {
  if (motion.size() < 2) return false;
  const MovingGrasp grasp(motion, dimension, centre);
  if (!(grasp.frame.radius > 0)) return false;
  const GraspForces internal =
      ComputeGraspForces(grasp.contacts, grasp.frame, half_angle, Wrench(), /*total_normal=*/1);
  if (!internal.balanced || !(internal.margin > 0)) return false;

  double fastest = 0;
  for (const Vector3d& v : grasp.v) fastest += v.squaredNorm();
  const double least_singular = grasp.LeastSingularValue() - reach * std::sqrt(fastest);
  if (!(least_singular > 0)) return false;

  const std::vector<Vector3d>& f = internal.forces;
  const VectorXd turning = grasp.TorqueOf(grasp.v, f);
  const std::vector<Vector3d> h = grasp.ForcesAgainst(turning);
  const double wrench_left = grasp.Balance(f).norm() + reach * (turning + grasp.Balance(h)).norm() +
                             reach * reach * grasp.TorqueOf(grasp.v, h).norm() + kRounding;
  const double balancing = wrench_left / least_singular;

  for (std::size_t i = 0; i < f.size(); ++i) {
    const Vector3d& n = grasp.contacts[i].n;
    const double inside = std::min(DistanceInside(f[i] + reach * h[i], n, half_angle),
                                   DistanceInside(f[i] - reach * h[i], n, half_angle));
    const double turned = reach * motion[i].turn() * (f[i].norm() + reach * h[i].norm());
    if (!(inside - turned - balancing > kRounding)) return false;
  }
  return true;
}

}  // namespace regrasp
