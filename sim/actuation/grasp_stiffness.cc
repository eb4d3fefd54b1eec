#include "sim/actuation/grasp_stiffness.h"

#include <Eigen/Dense>

#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Step of the derivatives with respect to joint angles, radians.
constexpr double kJointStep = 1e-6;

Matrix3d CrossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Jacobians of the last link of a finger with respect to its independent joints.
struct LinkJacobian {
  Matrix3Xd point;  ///< velocity of the link's point at a given place, metres per radian
  Matrix3Xd turn;   ///< angular velocity
};

LinkJacobian JacobianAt(const kinematics::Finger& finger,
                        const kinematics::JointConfiguration& configuration,
                        const Vector3d& place) {
  LinkJacobian jacobian{Matrix3Xd::Zero(3, finger.drives), Matrix3Xd::Zero(3, finger.drives)};
  const kinematics::JointFrames frames = kinematics::FramesOf(finger, configuration);
  for (std::size_t k = 0; k < finger.joints.size(); ++k) {
    const kinematics::Joint& joint = finger.joints[k];
    const Vector3d axis = joint.ratio * (frames[k].linear() * joint.axis);
    jacobian.turn.col(joint.drive) += axis;
    jacobian.point.col(joint.drive) += axis.cross(place - frames[k].translation());
  }
  return jacobian;
}

/// Return the derivative of the joint torques of a constant force at a constant place with respect
/// to the joint angles.
MatrixXd TorqueChange(const StiffFinger& given) {
  const int drives = given.finger->drives;
  MatrixXd change(drives, drives);
  for (int k = 0; k < drives; ++k) {
    kinematics::JointConfiguration up = given.configuration;
    kinematics::JointConfiguration down = given.configuration;
    up[k] += kJointStep;
    down[k] -= kJointStep;
    const Matrix3Xd difference = JacobianAt(*given.finger, up, given.contact).point -
                                 JacobianAt(*given.finger, down, given.contact).point;
    change.col(k) = difference.transpose() * given.force / (2 * kJointStep);
  }
  return change;
}

/// Return the change of a finger's wrench about the centroid per displacement of the object.
Eigen::Matrix<double, 6, 6> WrenchChange(const StiffFinger& given, const Vector3d& centroid) {
  const int n = given.finger->drives;
  const double radius = given.finger->tip.radius;
  const LinkJacobian at = JacobianAt(*given.finger, given.configuration, given.contact);
  const Vector3d to_contact = radius * given.inward;
  const Matrix3Xd centre = at.point + CrossMatrix(to_contact) * at.turn;
  const Matrix3d arm = CrossMatrix(given.contact - centroid);
  // Change of the joint torques of the force as its point of application moves.
  const MatrixXd by_place = -at.turn.transpose() * CrossMatrix(given.force);
  MatrixXd system = MatrixXd::Zero(n + 3, n + 3);
  system.topLeftCorner(3, n) = at.point;
  system.bottomLeftCorner(n, n) =
      MatrixXd(given.stiffness.asDiagonal()) + TorqueChange(given) + by_place * centre;
  system.bottomRightCorner(n, 3) = at.point.transpose();
  // The object's velocity at the contact, and the motion of the contact as the normal turns.
  Eigen::Matrix<double, 3, 6> moved;
  moved << Matrix3d::Identity(), -arm;
  Eigen::Matrix<double, 3, 6> turned;
  turned << Matrix3d::Zero(), -CrossMatrix(to_contact);
  MatrixXd right(n + 3, 6);
  right << moved, -by_place * turned;
  const MatrixXd solved = system.fullPivLu().solve(right);
  const MatrixXd force = solved.bottomRows(3);
  Eigen::Matrix<double, 3, 6> place = centre * solved.topRows(n) + turned;
  place.leftCols(3) -= Matrix3d::Identity();  // relative to the centroid
  Eigen::Matrix<double, 6, 6> change;
  change << force, arm * force - CrossMatrix(given.force) * place;
  return change;
}

}  // namespace

GraspStiffness ComputeGraspStiffness(const std::vector<StiffFinger>& fingers,
                                     const Vector3d& centroid, double radius) {
  GraspStiffness stiffness = GraspStiffness::Zero();
  for (const StiffFinger& finger : fingers) stiffness -= WrenchChange(finger, centroid);
  Eigen::Matrix<double, 6, 1> units;
  units << 1, 1, 1, 1 / radius, 1 / radius, 1 / radius;
  return units.asDiagonal() * stiffness * units.asDiagonal();
}

double SmallestStiffness(const GraspStiffness& stiffness) {
  const GraspStiffness symmetric = (stiffness + stiffness.transpose()) / 2;
  return Eigen::SelfAdjointEigenSolver<GraspStiffness>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

}  // namespace regrasp::sim
