#include "planner/motion/moving_forces.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/cone_support.h"

namespace regrasp {

namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Entries below this (the tableau's are of the order of 1) are no pivots: the inverse would lose
/// more than half of its digits.
constexpr double kPivot = 1e-9;

/// Basic weights are allowed to be this much below zero in the ratio test (Harris 1973), so that a
/// larger pivot can be taken among nearly equal ratios.
constexpr double kRatioSlack = 1e-13;

/// In place of entries that are no pivots: no ratio over it is the least.
constexpr double kNoDivisor = 1e-200;

/// A column improves only if its reduced cost exceeds this, relative to the dual's size.
constexpr double kImprovement = 1e-13;

/// Proofs take 15 to 40 pivots in space; what takes more is close to the limit, and is halved.
constexpr int kMaxPivots = 100;

/// What the balance may leave of forces of size 1: some roundings of each of their sums.
constexpr double kUnbalanced = 1e-12;

/// Equations that the others imply up to this, relative to the largest, are taken to be implied:
/// rounding makes some 1e-15 of them, geometry hardly ever as little as this.
constexpr double kRedundant = 1e-11;

/// Multiples of the golden ratio, modulo 1, never repeat: no two coefficients weigh the same, and
/// symmetric grasps cause no degenerate pivots.
double UnevenWeight(int i) {
  const double turns = i * 0.6180339887498949;
  return 1 + 0.5 * (turns - std::floor(turns));
}

/// Where the torque of a coefficient enters: `factor` times its cross product with an arm in the
/// block of rows.
struct Arm {
  int block;
  enum class Kind { kStart, kMiddle, kEnd, kVelocity } kind;
  double factor;
};

template <int kDegree>
struct Arms;

template <>
struct Arms<1> {
  static constexpr int kCount = 2;
  static constexpr std::array<std::array<Arm, kCount>, 2> kOf = {
      {{{{0, Arm::Kind::kStart, 1}, {2, Arm::Kind::kVelocity, -1}}},
       {{{1, Arm::Kind::kEnd, 1}, {2, Arm::Kind::kVelocity, 1}}}}};
};

template <>
struct Arms<2> {
  static constexpr int kCount = 3;
  static constexpr std::array<std::array<Arm, kCount>, 3> kOf = {
      {{{{0, Arm::Kind::kStart, 1}, {1, Arm::Kind::kMiddle, 0.25}, {3, Arm::Kind::kVelocity, 1}}},
       {{{1, Arm::Kind::kMiddle, 0.5}, {3, Arm::Kind::kVelocity, -2}, {0, Arm::Kind::kStart, 0}}},
       {{{1, Arm::Kind::kMiddle, 0.25}, {2, Arm::Kind::kEnd, 1}, {3, Arm::Kind::kVelocity, 1}}}}};
};

template <int kSpace, int kDegree>
class ForceProgram {
 public:
  ForceProgram(std::span<const MovingContact> contacts, double largest_weight)
      : contacts_(contacts), largest_weight_(largest_weight) {
    kept_.fill(true);
    double fastest = 0;
    for (const MovingContact& contact : contacts) {
      fastest = std::max(fastest, contact.velocity.norm());
    }
    const double per_speed = fastest > 0 ? 1 / fastest : 0;
    for (const MovingContact& contact : contacts) {
      for (int k = 0; k <= kDegree; ++k) {
        Source& source = sources_.emplace_back();
        source.contact = {contact.start, contact.n, contact.axial, contact.tangential};
        source.coefficient = k;
        for (int a = 0; a < kArms; ++a) {
          source.arms[a] = Arms<kDegree>::kOf[k][a].factor *
                           ArmOf(contact, Arms<kDegree>::kOf[k][a].kind, per_speed);
        }
      }
    }
  }

  /// Leaves out equations that the others imply. @returns false where there are none.
  bool LeaveOutRedundant() {
    const int unit_forces = static_cast<int>(sources_.size()) * kSpace;
    Eigen::MatrixXd columns(unit_forces, kRows);
    for (int c = 0; c < unit_forces; ++c) {
      columns.row(c) = ColumnOf({c / kSpace, Vector3d::Unit(c % kSpace)});
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rows(columns);
    rows.setThreshold(kRedundant);
    for (int r = static_cast<int>(rows.rank()); r < kRows; ++r) {
      kept_[rows.colsPermutation().indices()[r]] = false;
    }
    return rows.rank() < kRows;
  }

  bool Solve(MovingForces<kDegree>& forces) {
    Start();
    for (int pivot = 0; Unbalanced() > kUnbalanced; ++pivot) {
      if (pivot == kMaxPivots || !Improve()) return false;
    }
    return ReadForces(forces);
  }

 private:
  static constexpr int kTorques = kSpace == 3 ? 3 : 1;
  static constexpr int kForceRows = kSpace * (kDegree + 1);
  static constexpr int kRows = kForceRows + kTorques * (kDegree + 2);
  static constexpr int kTableau = kRows + 1;  // and the objective
  static constexpr int kArms = Arms<kDegree>::kCount;
  static constexpr int kArtificial = -1;

  using Row = Eigen::Matrix<double, kRows, 1>;
  using TableauColumn = Eigen::Matrix<double, kTableau, 1>;

  /// A contact's coefficient as a family of columns.
  struct Source {
    UnitContact contact;
    int coefficient;
    std::array<Vector3d, kArms> arms;
  };
  struct Column {
    int source;
    Vector3d force;
  };

  static Vector3d ArmOf(const MovingContact& contact, Arm::Kind kind, double per_speed) {
    switch (kind) {
      case Arm::Kind::kStart:
        return contact.start;
      case Arm::Kind::kEnd:
        return contact.end;
      case Arm::Kind::kMiddle:
        return (contact.start + contact.end) / 2;
      case Arm::Kind::kVelocity:
        break;
    }
    return per_speed * contact.velocity;
  }

  static int TorqueRow(int block) { return kForceRows + kTorques * block; }

  /// Calls visit(row, value) on the entries of a column that can differ from 0.
  template <typename Visit>
  void VisitColumn(const Column& column, const Visit& visit) const {
    const Source& source = sources_[column.source];
    const auto visit_kept = [&](int row, double value) {
      if (kept_[row]) visit(row, value);
    };
    for (int axis = 0; axis < kSpace; ++axis) {
      visit_kept(kSpace * source.coefficient + axis, column.force[axis]);
    }
    for (int a = 0; a < kArms; ++a) {
      const int at = TorqueRow(Arms<kDegree>::kOf[source.coefficient][a].block);
      const Vector3d torque = source.arms[a].cross(column.force);
      for (int k = 0; k < kTorques; ++k) visit_kept(at + k, torque[kSpace == 3 ? k : 2]);
    }
  }
  Row ColumnOf(const Column& column) const {
    Row row = Row::Zero();
    VisitColumn(column, [&](int r, double value) { row[r] += value; });
    return row;
  }

  void Start() {
    Row right = Row::Zero();
    for (int s = 0; s < static_cast<int>(sources_.size()); ++s) {
      right -= ColumnOf({s, UnevenWeight(s) * sources_[s].contact.n});
    }
    tableau_.setZero();
    basis_.fill({kArtificial, Vector3d::Zero()});
    artificial_.setZero();
    for (int r = 0; r < kRows; ++r) {
      if (!kept_[r]) continue;
      artificial_[r] = 1;
      const double sign = right[r] < 0 ? -1 : 1;
      tableau_(r, r) = sign;
      tableau_(r, kRows) = sign * right[r];
      tableau_(kRows, r) = sign;
      tableau_(kRows, kRows) += sign * right[r];
    }
    right_ = right;
  }

  [[nodiscard]] Vector3d VelocityOf(const Source& source, const Row& dual) const {
    Vector3d u = Vector3d::Zero();
    u.head<kSpace>() = dual.template segment<kSpace>(kSpace * source.coefficient);
    for (int a = 0; a < kArms; ++a) {
      const int at = TorqueRow(Arms<kDegree>::kOf[source.coefficient][a].block);
      if constexpr (kSpace == 3) {
        u += dual.template segment<3>(at).cross(source.arms[a]);
      } else {
        u += dual[at] * Vector3d(-source.arms[a].y(), source.arms[a].x(), 0);
      }
    }
    return u;
  }

  /// Brings the column with the largest reduced cost into the basis. @returns false at the optimum.
  bool Improve() {
    const Row dual = tableau_.row(kRows).template head<kRows>();
    boost::container::small_vector<double, kInlineContacts*(kDegree + 1)> supports;
    for (const Source& source : sources_) {
      supports.push_back(ConeSupport(source.contact, VelocityOf(source, dual)));
    }
    const auto best = std::max_element(supports.begin(), supports.end());
    if (!(*best > kImprovement * dual.template lpNorm<1>())) return false;
    // Weights λ ≥ 0 with Σ λ w = b give y·b = Σ λ (y·w) ≤ best Σ λ for the dual y at hand.
    if (*best * largest_weight_ < tableau_(kRows, kRows)) return false;
    const int chosen = static_cast<int>(best - supports.begin());
    const Source& source = sources_[chosen];
    const Vector3d velocity = VelocityOf(source, dual);
    return Enter({chosen, SupportForce < kSpace == 3 ? 6 : 3 > (source.contact, velocity)});
  }

  bool Enter(const Column& column) {
    TableauColumn alpha = TableauColumn::Zero();
    VisitColumn(column, [&](int row, double entry) { alpha += entry * tableau_.col(row); });
    const int leaving = ChooseLeaving(alpha);
    if (leaving < 0) return false;
    Pivot(leaving, alpha);
    basis_[leaving] = column;
    artificial_[leaving] = 0;
    return true;
  }

  int ChooseLeaving(const TableauColumn& alpha) const {
    // All rows at once: which entries can be pivots nobody predicts, and branches that are
    // mispredicted took longer than the rest of a pivot.
    TableauColumn divisors;
    for (int r = 0; r < kTableau; ++r) divisors[r] = alpha[r] > kPivot ? alpha[r] : kNoDivisor;
    divisors[kRows] = kNoDivisor;
    const TableauColumn weights = tableau_.col(kRows).cwiseMax(0);
    const double bound = ((weights.array() + kRatioSlack) / divisors.array()).minCoeff();
    int leaving = -1;
    double largest = 0;
    for (int r = 0; r < kRows; ++r) {
      if (!(weights[r] <= bound * alpha[r]) || !(alpha[r] > kPivot)) continue;
      const double preference = (1 + artificial_[r]) * alpha[r];
      if (preference > largest) {
        largest = preference;
        leaving = r;
      }
    }
    return leaving;
  }

  void Pivot(int leaving, TableauColumn alpha) {
    const Eigen::Matrix<double, 1, kTableau> row = tableau_.row(leaving) * (1 / alpha[leaving]);
    alpha[leaving] = 0;
    tableau_.noalias() -= alpha * row;
    tableau_.row(leaving) = row;
  }

  /// What artificial columns still carry.
  [[nodiscard]] double Unbalanced() const {
    return artificial_.dot(tableau_.col(kRows).cwiseMax(0));
  }

  /// The forces a n + g of the basic solution, refined by the inverse basis.
  bool ReadForces(MovingForces<kDegree>& forces) const {
    Row weights = tableau_.col(kRows).template head<kRows>();
    Row left = right_;
    for (int r = 0; r < kRows; ++r) {
      if (basis_[r].source != kArtificial) left -= weights[r] * ColumnOf(basis_[r]);
    }
    weights += tableau_.template topLeftCorner<kRows, kRows>() * left;
    forces.resize(contacts_.size());
    double largest = 0;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const UnitContact& contact = sources_[s].contact;
      forces[s / (kDegree + 1)][sources_[s].coefficient] =
          UnevenWeight(static_cast<int>(s)) * contact.n;
    }
    for (int r = 0; r < kRows; ++r) {
      if (basis_[r].source == kArtificial) continue;
      const Source& source = sources_[basis_[r].source];
      forces[basis_[r].source / (kDegree + 1)][source.coefficient] += weights[r] * basis_[r].force;
    }
    for (auto& of_contact : forces) {
      for (const Vector3d& force : of_contact) largest = std::max(largest, force.norm());
    }
    for (auto& of_contact : forces) {
      for (Vector3d& force : of_contact) force /= largest;
    }
    return true;
  }

  std::span<const MovingContact> contacts_;
  double largest_weight_;
  boost::container::small_vector<Source, kInlineContacts*(kDegree + 1)> sources_;
  std::array<bool, kRows> kept_;  ///< equations that are not left out
  std::array<Column, kRows> basis_;
  TableauColumn artificial_;  ///< 1 for rows whose basic column is, otherwise 0
  Row right_;
  // Row r: the inverse basis's row and the weight of basis_[r]; the last row: the dual and the
  // objective's value.
  Eigen::Matrix<double, kTableau, kTableau> tableau_;
};

}  // namespace

template <int kSpace, int kDegree>
bool FindMovingForces(std::span<const MovingContact> contacts, MovingForces<kDegree>& forces,
                      double largest_weight) {
  return ForceProgram<kSpace, kDegree>(contacts, largest_weight).Solve(forces);
}

template <int kSpace>
bool FindMovingForcesWithoutRedundancy(std::span<const MovingContact> contacts,
                                       MovingForces<1>& forces, double largest_weight) {
  ForceProgram<kSpace, 1> program(contacts, largest_weight);
  return program.LeaveOutRedundant() && program.Solve(forces);
}

template bool FindMovingForces<2, 1>(std::span<const MovingContact>, MovingForces<1>&, double);
template bool FindMovingForces<3, 1>(std::span<const MovingContact>, MovingForces<1>&, double);
template bool FindMovingForces<2, 2>(std::span<const MovingContact>, MovingForces<2>&, double);
template bool FindMovingForces<3, 2>(std::span<const MovingContact>, MovingForces<2>&, double);
template bool FindMovingForcesWithoutRedundancy<2>(std::span<const MovingContact>, MovingForces<1>&,
                                                   double);
template bool FindMovingForcesWithoutRedundancy<3>(std::span<const MovingContact>, MovingForces<1>&,
                                                   double);

}  // namespace regrasp
