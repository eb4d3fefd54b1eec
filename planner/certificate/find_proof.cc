#include "planner/certificate/find_proof.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/pair_line.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Forces of a piece stay this much of their size away from the cone's border, so that the exact
/// correction of their rounding does not bring them out.
constexpr double kSlack = 1e-9;

/// What a solution of the balance may leave, over the size of the forces.
constexpr double kUnbalanced = 1e-10;

bool IsInside(const Vector3d& force, const Vector3d& n, double half_angle) {
  const double normal = force.dot(n);
  const double inside =
      normal * std::sin(half_angle) - (force - normal * n).norm() * std::cos(half_angle);
  return inside > kSlack * (1 + force.norm());
}

WrenchFrame OwnFrame(std::span<const Contact> contacts, int dimension) {
  return ContactFrame(contacts, dimension);
}

/// The refutation that the pair lines give; kNone where they give none.
GraspProof FindLine(const UnitContacts& contacts) {
  const int count = static_cast<int>(contacts.size());
  GraspProof proof;
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      bool positive = false;
      bool negative = false;
      bool other = false;
      for (int c = 0; c < count; ++c) {
        if (c == a || c == b) continue;
        const Turn turn = TurnAboutLine(contacts[a], contacts[b], contacts[c]);
        positive = positive || turn == Turn::kPositive;
        negative = negative || turn == Turn::kNegative;
        other = other || turn == Turn::kBoth || turn == Turn::kUnclear;
      }
      if (other || (positive && negative)) continue;
      proof.kind = GraspProof::Kind::kLine;
      proof.line = {a, b};
      return proof;
    }
  }
  return proof;
}

/// A twist of the contacts' own frame as one of the object's coordinates.
template <int kDim>
GraspProof TwistProof(const typename WrenchSimplex<kDim>::Vector& twist, const WrenchFrame& frame) {
  GraspProof proof;
  proof.kind = GraspProof::Kind::kTwist;
  if constexpr (kDim == 6) {
    proof.omega = Vector3d(twist[3], twist[4], twist[5]) / frame.radius;
    proof.v = Vector3d(twist[0], twist[1], twist[2]) - proof.omega.cross(frame.origin);
  } else {
    proof.omega = Vector3d(0, 0, twist[2]) / frame.radius;
    proof.v = Vector3d(twist[0], twist[1], 0) - proof.omega.cross(frame.origin);
  }
  return proof;
}

template <int kDim>
GraspProof FindRefutation(std::span<const Contact> contacts, const WrenchFrame& frame,
                          double half_angle) {
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitForces(units, half_angle);
  if constexpr (kDim == 6) {
    const GraspProof line = FindLine(units);
    if (line.kind != GraspProof::Kind::kNone) return line;
  }
  ForceClosureProof<kDim> found;
  const ForceClosure answer = DecideForceClosure<kDim>(units, &found);
  const bool has_twist =
      std::any_of(found.twist.begin(), found.twist.end(), [](double x) { return x != 0; });
  if (answer.decision != Decision::kNo || !has_twist) return {};
  return TwistProof<kDim>(found.twist, frame);
}

/// The linear equations of forces f + s h, s from −reach to reach, that balance for all s when f
/// does at s = 0: Σ h = 0, Σ q × h + v × f = 0, Σ v × h = 0.
class LinearForces {
 public:
  LinearForces(const Grasp& contacts, const std::vector<Vector3d>& velocities,
               const WrenchFrame& frame, int dimension)
      : dimension_(dimension), torques_(dimension == 3 ? 3 : 1) {
    const int count = static_cast<int>(contacts.size());
    matrix_ = MatrixXd::Zero(dimension + 2 * torques_, dimension * count);
    for (int i = 0; i < count; ++i) {
      const Vector3d q = (contacts[i].p - frame.origin) / frame.radius;
      velocities_.push_back(velocities[i] / frame.radius);
      for (int axis = 0; axis < dimension; ++axis) {
        const int column = i * dimension + axis;
        const Vector3d unit = Vector3d::Unit(axis);
        matrix_(axis, column) = 1;
        WriteTorque(q.cross(unit), dimension, column);
        WriteTorque(velocities_.back().cross(unit), dimension + torques_, column);
      }
    }
  }

  /// The least h; nullopt where there is none.
  [[nodiscard]] std::optional<std::vector<Vector3d>> Solve(const std::vector<Vector3d>& f) const {
    Vector3d turning = Vector3d::Zero();
    for (std::size_t i = 0; i < f.size(); ++i) turning += velocities_[i].cross(f[i]);
    VectorXd right = VectorXd::Zero(matrix_.rows());
    if (dimension_ == 3) {
      right.segment(3, 3) = -turning;
    } else {
      right[2] = -turning.z();
    }
    const VectorXd stacked = matrix_.completeOrthogonalDecomposition().solve(right);
    if ((matrix_ * stacked - right).norm() > kUnbalanced * (1 + right.norm())) return std::nullopt;
    std::vector<Vector3d> h(f.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < h.size(); ++i) {
      h[i].head(dimension_) = stacked.segment(static_cast<int>(i) * dimension_, dimension_);
    }
    return h;
  }

 private:
  void WriteTorque(const Vector3d& torque, int row, int column) {
    if (torques_ == 3) {
      matrix_.block<3, 1>(row, column) = torque;
    } else {
      matrix_(row, column) = torque.z();
    }
  }

  int dimension_;
  int torques_;
  MatrixXd matrix_;
  std::vector<Vector3d> velocities_;
};

std::optional<MotionPiece> FindPiece(const GraspMotion& motion, int dimension, double half_angle,
                                     double from, double to) {
  const Grasp contacts = GraspAt(motion, (from + to) / 2);
  const WrenchFrame frame = OwnFrame(contacts, dimension);
  if (!(frame.radius > 0)) return std::nullopt;
  const GraspForces middle = ComputeGraspForces(contacts, frame, half_angle, Wrench(), 1);
  if (!middle.balanced || !(middle.margin > 0)) return std::nullopt;
  std::vector<Vector3d> velocities;
  for (const ContactMotion& contact : motion) velocities.push_back(contact.velocity());
  const auto h = LinearForces(contacts, velocities, frame, dimension).Solve(middle.forces);
  if (!h) return std::nullopt;
  const double reach = (to - from) / 2;
  MotionPiece piece{from, to, {}, {}};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    piece.start.push_back(middle.forces[i] - reach * (*h)[i]);
    piece.end.push_back(middle.forces[i] + reach * (*h)[i]);
    if (!IsInside(piece.start.back(), contacts[i].n, half_angle) ||
        !IsInside(piece.end.back(), contacts[i].n, half_angle)) {
      return std::nullopt;
    }
  }
  return piece;
}

bool AddPieces(const GraspMotion& motion, int dimension, double half_angle, double from, double to,
               std::vector<MotionPiece>& pieces) {
  if (auto piece = FindPiece(motion, dimension, half_angle, from, to)) {
    pieces.push_back(std::move(*piece));
    return true;
  }
  if (to - from <= kShortestPiece) return false;
  const double middle = (from + to) / 2;
  return AddPieces(motion, dimension, half_angle, from, middle, pieces) &&
         AddPieces(motion, dimension, half_angle, middle, to, pieces);
}

}  // namespace

namespace {

/// No forces resist a turn about the line that all contacts are on.
bool AreOnOneLine(std::span<const Contact> contacts, const WrenchFrame& frame) {
  double farthest = 0;
  for (const Contact& a : contacts) {
    for (const Contact& b : contacts) {
      farthest = std::max(farthest, (a.p - contacts[0].p).cross(b.p - contacts[0].p).norm());
    }
  }
  return farthest <= kOnLine * frame.radius * frame.radius;
}

}  // namespace

GraspProof FindGraspProof(std::span<const Contact> contacts, int dimension, double half_angle) {
  const WrenchFrame frame = OwnFrame(contacts, dimension);
  CheckHalfAngle(half_angle);
  if (!(frame.radius > 0)) return {};
  const GraspForces internal = ComputeGraspForces(contacts, frame, half_angle, Wrench(), 1);
  bool inside = internal.balanced && internal.margin > 0 &&
                !(dimension == 3 && AreOnOneLine(contacts, frame));
  for (std::size_t i = 0; inside && i < contacts.size(); ++i) {
    inside = IsInside(internal.forces[i], contacts[i].n, half_angle);
  }
  if (inside) {
    GraspProof proof;
    proof.kind = GraspProof::Kind::kForces;
    proof.forces = internal.forces;
    return proof;
  }
  return dimension == 3 ? FindRefutation<6>(contacts, frame, half_angle)
                        : FindRefutation<3>(contacts, frame, half_angle);
}

std::optional<std::vector<MotionPiece>> FindMotionProof(const GraspMotion& motion, int dimension,
                                                        double half_angle) {
  for (const ContactMotion& contact : motion) {
    if (contact.turn() > 0) return std::nullopt;
  }
  std::vector<MotionPiece> pieces;
  if (!AddPieces(motion, dimension, half_angle, 0, 1, pieces)) return std::nullopt;
  return pieces;
}

}  // namespace regrasp
