#include "planner/motion/moving_forces.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "planner/grasp/cone_support.h"
#include "planner/lp/simplex.h"

namespace regrasp::motion {

namespace {

using Eigen::Vector3d;

/// Least reduced cost of a column that improves, relative to the dual's size.
constexpr double kImprovement = 1e-13;

/// Limits of the simplex method. Proofs take 15 to 40 pivots in space; a piece that takes more is
/// close to the limit, and is halved.
constexpr lp::Limits kLimits = {.pivots = 100};

/// Unbalanced remainder of forces of size 1 that counts as rounding of their sums.
constexpr double kUnbalanced = 1e-12;

/// Relative size below which an equation counts as implied by the others. Rounding causes about
/// 1e-15; geometry rarely causes values this small.
constexpr double kRedundant = 1e-11;

/// Contribution of a coefficient's torque: `factor` times its cross product with an arm, in a block
/// of rows.
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
    double fastest = 0;
    for (const MovingContact& contact : contacts) {
      fastest = std::max(fastest, contact.velocity.norm());
    }
    const double per_speed = fastest > 0 ? 1 / fastest : 0;
    for (const MovingContact& contact : contacts) {
      for (int k = 0; k <= kDegree; ++k) {
        Source& source = sources_.emplace_back();
        source.contact = {contact.start, contact.n, contact.axial, contact.tangential,
                          contact.torsion};
        source.coefficient = k;
        for (int a = 0; a < kArms; ++a) {
          source.arms[a] = Arms<kDegree>::kOf[k][a].factor *
                           ArmOf(contact, Arms<kDegree>::kOf[k][a].kind, per_speed);
        }
      }
    }
  }

  /// Omit equations that the others imply.
  /// @returns false if there are none.
  bool LeaveOutRedundant() {
    const int unit_forces = static_cast<int>(sources_.size()) * kSpace;
    Eigen::MatrixXd columns(unit_forces + static_cast<int>(sources_.size()), kRows);
    for (int c = 0; c < unit_forces; ++c) {
      columns.row(c) = Column{&sources_[c / kSpace], {Vector3d::Unit(c % kSpace)}}.Dense();
    }
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const double torque = sources_[s].contact.torsion > 0 ? 1 : 0;
      columns.row(unit_forces + static_cast<int>(s)) =
          Column{&sources_[s], {Vector3d::Zero(), torque}}.Dense();
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rows(columns);
    rows.setThreshold(kRedundant);
    for (int r = static_cast<int>(rows.rank()); r < kRows; ++r) {
      kept_[rows.colsPermutation().indices()[r]] = 0;
    }
    return rows.rank() < kRows;
  }

  bool Solve(MovingForces<kDegree>& forces, MovingTorques<kDegree>* torques) {
    Row right = Row::Zero();
    for (int s = 0; s < static_cast<int>(sources_.size()); ++s) {
      right -= Column{&sources_[s], {lp::UnevenWeight(s) * sources_[s].contact.n}}.Dense();
    }
    program_.StartFeasibility(right, kept_);
    program_.Run([&](const Row& dual, Column& column) { return FindBest(dual, column); }, kLimits);
    if (program_.unbalanced() > kUnbalanced) return false;
    ReadForces(right, forces, torques);
    return true;
  }

 private:
  static constexpr int kTorques = kSpace == 3 ? 3 : 1;
  static constexpr int kForceRows = kSpace * (kDegree + 1);
  static constexpr int kRows = kForceRows + kTorques * (kDegree + 2);
  static constexpr int kArms = Arms<kDegree>::kCount;

  using Row = Eigen::Matrix<double, kRows, 1>;

  /// Contact's coefficient as a family of columns.
  struct Source {
    grasp::UnitContact contact;
    int coefficient;
    std::array<Vector3d, kArms> arms;
  };
  struct Column {
    const Source* source;
    grasp::ContactWrench applied;

    template <class Visit>
    void ForEachEntry(const Visit& visit) const {
      const int coefficient = source->coefficient;
      const Vector3d& force = applied.force;
      for (int axis = 0; axis < kSpace; ++axis) visit(kSpace * coefficient + axis, force[axis]);
      for (int a = 0; a < kArms; ++a) {
        const int at = TorqueRow(Arms<kDegree>::kOf[coefficient][a].block);
        Vector3d torque = source->arms[a].cross(force);
        if (applied.torque != 0) {
          torque += (TwistShare(coefficient, a) * applied.torque) * source->contact.n;
        }
        for (int k = 0; k < kTorques; ++k) visit(at + k, torque[kSpace == 3 ? k : 2]);
      }
    }
    [[nodiscard]] static double cost() { return 0; }
    [[nodiscard]] Row Dense() const {
      Row row = Row::Zero();
      ForEachEntry([&](int r, double value) { row[r] += value; });
      return row;
    }
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

  /// Return what a torque about the normal adds to a block.
  /// Values have the weight of the force's arm; the leading coefficient has none.
  static double TwistShare(int coefficient, int arm) {
    const Arm& of = Arms<kDegree>::kOf[coefficient][arm];
    return of.kind == Arm::Kind::kVelocity ? 0 : of.factor;
  }

  static int TorqueRow(int block) { return kForceRows + kTorques * block; }

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

  [[nodiscard]] double SpinOf(const Source& source, const Row& dual) const {
    if (kSpace == 2 || source.contact.torsion == 0) return 0;
    double spin = 0;
    for (int a = 0; a < kArms; ++a) {
      const int at = TorqueRow(Arms<kDegree>::kOf[source.coefficient][a].block);
      spin += TwistShare(source.coefficient, a) *
              source.contact.n.dot(dual.template segment<3>(kSpace == 3 ? at : 0));
    }
    return spin;
  }

  /// Find the column with the largest reduced cost; false if balance is reached or impossible.
  bool FindBest(const Row& dual, Column& column) const {
    if (program_.unbalanced() <= kUnbalanced) return false;
    boost::container::small_vector<double, grasp::kInlineContacts*(kDegree + 1)> supports;
    for (const Source& source : sources_) {
      supports.push_back(
          grasp::ConeSupport(source.contact, VelocityOf(source, dual), SpinOf(source, dual)));
    }
    const auto best = std::max_element(supports.begin(), supports.end());
    if (!(*best > kImprovement * dual.template lpNorm<1>())) return false;
    // Weights λ ≥ 0 with Σ λ w = b give y·b = Σ λ (y·w) ≤ best Σ λ for the current dual y.
    if (*best * largest_weight_ < program_.objective()) return false;
    constexpr int kDim = kSpace == 3 ? 6 : 3;
    column.source = &sources_[best - supports.begin()];
    column.applied = grasp::SupportWrench<kDim>(
        column.source->contact, VelocityOf(*column.source, dual), SpinOf(*column.source, dual));
    return true;
  }

  /// Return the forces a n + g of the basic solution, refined by the inverse basis.
  void ReadForces(const Row& right, MovingForces<kDegree>& forces,
                  MovingTorques<kDegree>* torques) const {
    Row weights = program_.weights();
    Row left = right;
    for (int r = 0; r < kRows; ++r) {
      if (const Column* column = program_.column(r)) left -= weights[r] * column->Dense();
    }
    weights += program_.inverse() * left;
    forces.resize(contacts_.size());
    MovingTorques<kDegree> twists(contacts_.size());
    double largest = 0;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const grasp::UnitContact& contact = sources_[s].contact;
      forces[s / (kDegree + 1)][sources_[s].coefficient] =
          lp::UnevenWeight(static_cast<int>(s)) * contact.n;
    }
    for (int r = 0; r < kRows; ++r) {
      const Column* column = program_.column(r);
      if (column == nullptr) continue;
      const auto source = column->source - sources_.data();
      const int coefficient = column->source->coefficient;
      forces[source / (kDegree + 1)][coefficient] += weights[r] * column->applied.force;
      twists[source / (kDegree + 1)][coefficient] += weights[r] * column->applied.torque;
    }
    for (auto& of_contact : forces) {
      for (const Vector3d& force : of_contact) largest = std::max(largest, force.norm());
    }
    for (auto& of_contact : forces) {
      for (Vector3d& force : of_contact) force /= largest;
    }
    if (torques == nullptr) return;
    for (auto& of_contact : twists) {
      for (double& torque : of_contact) torque /= largest;
    }
    *torques = std::move(twists);
  }

  std::span<const MovingContact> contacts_;
  double largest_weight_;
  boost::container::small_vector<Source, grasp::kInlineContacts*(kDegree + 1)> sources_;
  Row kept_ = Row::Ones();  ///< 0 for omitted equations
  lp::Simplex<kRows, Column> program_;
};

}  // namespace

template <int kSpace, int kDegree>
bool FindMovingForces(std::span<const MovingContact> contacts, MovingForces<kDegree>& forces,
                      double largest_weight, MovingTorques<kDegree>* torques) {
  return ForceProgram<kSpace, kDegree>(contacts, largest_weight).Solve(forces, torques);
}

template <int kSpace>
bool FindMovingForcesWithoutRedundancy(std::span<const MovingContact> contacts,
                                       MovingForces<1>& forces, double largest_weight,
                                       MovingTorques<1>* torques) {
  ForceProgram<kSpace, 1> program(contacts, largest_weight);
  return program.LeaveOutRedundant() && program.Solve(forces, torques);
}

template bool FindMovingForces<2, 1>(std::span<const MovingContact>, MovingForces<1>&, double,
                                     MovingTorques<1>*);
template bool FindMovingForces<3, 1>(std::span<const MovingContact>, MovingForces<1>&, double,
                                     MovingTorques<1>*);
template bool FindMovingForces<2, 2>(std::span<const MovingContact>, MovingForces<2>&, double,
                                     MovingTorques<2>*);
template bool FindMovingForces<3, 2>(std::span<const MovingContact>, MovingForces<2>&, double,
                                     MovingTorques<2>*);
template bool FindMovingForcesWithoutRedundancy<2>(std::span<const MovingContact>, MovingForces<1>&,
                                                   double, MovingTorques<1>*);
template bool FindMovingForcesWithoutRedundancy<3>(std::span<const MovingContact>, MovingForces<1>&,
                                                   double, MovingTorques<1>*);

}  // namespace regrasp::motion
