#include "planner/grasp/wrench_simplex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/cone_support.h"
#include "planner/lp/simplex.h"

namespace regrasp::grasp {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// Least separation by a twist, relative to |twist| · |wrench|. Several thousand roundings of a
/// double; evaluating the support function has about twenty.
constexpr double kSeparation = 1e-12;

/// Least reduced cost of a column that improves, relative to |twist| · |wrench|.
constexpr double kImprovement = 1e-14;

/// Relative gap of the distance to the hull. For smaller gaps, neighbouring rim forces of one
/// contact become nearly the same column, and the inverse loses its accuracy.
constexpr double kNearestGap = 1e-6;

/// Limits of the simplex method. Grasps take 5 to 20 pivots, forces of full precision 30 to 60;
/// programs that take more are stalling.
constexpr lp::Limits kLimits = {.pivots = 200, .refactor_after = 24};

/// Limit on pivots of Resume. Slightly different rims need one or two pivots; a search from the
/// start costs about twenty.
constexpr int kMostResumed = 12;

/// Largest growth of the tangential part of rims in Resume: the rounding of the column's previous
/// tangential part grows by the same factor.
constexpr double kMostTurned = 1e3;

/// Return a wrench extended by its part of the sum Σ λ = 1.
template <std::size_t kDim>
std::array<double, kDim + 1> WithShare(const std::array<double, kDim>& wrench, double share) {
  std::array<double, kDim + 1> entries;
  std::copy(wrench.begin(), wrench.end(), entries.begin());
  entries[kDim] = share;
  return entries;
}

/// Return Σ |y_r| over the rows of the balance.
template <int kDim, class Dual>
double TwistSize(const Dual& dual) {
  double size = 0;
  for (int r = 0; r < kDim; ++r) size += std::abs(dual[r]);
  return size;
}

}  // namespace

template <int kDim>
WrenchSimplex<kDim>::WrenchSimplex(std::span<const UnitContact> contacts, const Vector& target)
    : contacts_(contacts), target_(target) {
  for (double value : target) target_size_ += std::abs(value);
  const int count = static_cast<int>(contacts.size());
  for (int i = 0; i < count; ++i) start_weight_sum_ += lp::UnevenWeight(i);
  SetRims();
  const std::array<double, kRows> right = WithShare(target, 1);
  program_.StartFeasibility(Dual(right.data()), {kStart, WithShare(start_, 1)}, kDim);
}

template <int kDim>
void WrenchSimplex<kDim>::SetRims() {
  start_ = {};
  column_size_ = 0;
  rims_.clear();
  const int count = static_cast<int>(contacts_.size());
  for (int i = 0; i < count; ++i) {
    const UnitContact& contact = contacts_[i];
    rims_.push_back({contact.axial, contact.tangential});
    column_size_ = std::max(
        column_size_, (contact.axial + contact.tangential) * (1 + contact.q.template lpNorm<1>()) +
                          contact.tangential * contact.torsion * contact.n.template lpNorm<1>());
    Vector wrench;
    WriteWrench<kDim>(contact, {(StartWeight(i) * contact.axial) * contact.n}, wrench.data());
    for (int r = 0; r < kDim; ++r) start_[r] += wrench[r];
  }
}

template <int kDim>
double WrenchSimplex<kDim>::StartWeight(int contact) const {
  return lp::UnevenWeight(contact) / start_weight_sum_;
}

template <int kDim>
double WrenchSimplex<kDim>::FindBest(const Dual& dual, Column& column) const {
  double best = -kNoBound;
  Eigen::Vector3d best_velocity = Eigen::Vector3d::Zero();
  double best_spin = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Eigen::Vector3d u = Velocity<kDim>(contacts_[i], dual.data());
    const double spin = Spin<kDim>(contacts_[i], dual.data());
    const double value = ConeSupport(contacts_[i], u, spin);
    if (value > best) {
      best = value;
      best_velocity = u;
      best_spin = spin;
      column.contact = static_cast<int>(i);
    }
  }
  const UnitContact& contact = contacts_[column.contact];
  WriteWrench<kDim>(contact, SupportWrench<kDim>(contact, best_velocity, best_spin),
                    column.entries.data());
  column.entries[kDim] = 1;
  double reduced_cost = 0;
  for (int r = 0; r < kRows; ++r) reduced_cost += dual[r] * column.entries[r];
  return reduced_cost;
}

template <int kDim>
double WrenchSimplex<kDim>::Support(std::span<const UnitContact> contacts, const Vector& twist) {
  double best = -kNoBound;
  for (const UnitContact& contact : contacts) {
    best = std::max(best, ConeSupportOf<kDim>(contact, twist.data()));
  }
  return best;
}

template <int kDim>
bool WrenchSimplex<kDim>::Separates(const Dual& dual, double reduced_cost) const {
  // y·w ≤ reduced_cost − y_last for all columns w; the target must be beyond that.
  double beyond = dual[kDim] - reduced_cost;
  for (int r = 0; r < kDim; ++r) beyond += dual[r] * target_[r];
  return beyond > kSeparation * TwistSize<kDim>(dual) * (column_size_ + target_size_);
}

template <int kDim>
typename WrenchSimplex<kDim>::Status WrenchSimplex<kDim>::FindWeights(bool stop_early) {
  bool separated = false;
  const auto price = [&](const Dual& dual, Column& column) {
    if (program_.artificial_count() == 0) return false;
    const double reduced_cost = FindBest(dual, column);
    separated = stop_early && Separates(dual, reduced_cost);
    return !separated && reduced_cost > kImprovement * TwistSize<kDim>(dual) * column_size_ &&
           reduced_cost > kNearestGap * unbalanced();
  };
  program_.Run(price, kLimits);
  if (separated) return Status::kInfeasible;
  if (program_.artificial_count() == 0) return Status::kFeasible;
  program_.Refactor();
  if (unbalanced() <= kSeparation * column_size_) return Status::kFeasible;
  Column column;
  const Dual dual = program_.dual();
  return Separates(dual, FindBest(dual, column)) ? Status::kInfeasible : Status::kStalled;
}

template <int kDim>
std::optional<typename WrenchSimplex<kDim>::Column> WrenchSimplex<kDim>::Turned(
    const Column& column, const Rims& before) const {
  if (column.contact == kStart) return Column{kStart, WithShare(start_, 1)};
  if (column.contact < 0) return std::nullopt;
  const Rim& rim = before[column.contact];
  const UnitContact& contact = contacts_[column.contact];
  if (!(rim.tangential * kMostTurned >= contact.tangential)) return std::nullopt;
  // The column is axial w(n) + tangential w(t), and w(t) does not change.
  const double scale = contact.tangential / rim.tangential;
  Vector wrench;
  WriteWrench<kDim>(contact, {(contact.axial - scale * rim.axial) * contact.n}, wrench.data());
  for (int r = 0; r < kDim; ++r) wrench[r] += scale * column.entries[r];
  return Column{column.contact, WithShare(wrench, 1)};
}

template <int kDim>
int WrenchSimplex<kDim>::FarthestFacet() const {
  int farthest = -1;
  double largest = 0;
  for (int r = 0; r < kRows; ++r) {
    const double weight = program_.weights()[r];
    if (!(weight < 0)) continue;
    const double rate = program_.inverse().row(r).template head<kDim>().squaredNorm();
    if (weight * weight > largest * rate) {
      largest = weight * weight / rate;
      farthest = r;
    }
  }
  return farthest;
}

template <int kDim>
typename WrenchSimplex<kDim>::Status WrenchSimplex<kDim>::Resume(Vector& twist) {
  const Rims before = rims_;
  SetRims();
  std::array<Column, kRows> columns;
  for (int r = 0; r < kRows; ++r) {
    const Column* column = program_.column(r);
    const auto turned = column == nullptr ? std::nullopt : Turned(*column, before);
    if (!turned) {
      rims_ = before;  // the columns still belong to the previous rims
      return Status::kStalled;
    }
    columns[r] = *turned;
  }
  const std::array<double, kRows> right = WithShare(target_, 1);
  program_.StartFromBasis(columns, Dual(right.data()));
  Column column;
  for (int pivot = 0; pivot < kMostResumed; ++pivot) {
    if (!program_.weights().allFinite()) return Status::kStalled;
    const int row = FarthestFacet();
    if (row < 0) return Status::kFeasible;
    // Outward normal of the facet: the other columns are all on the facet.
    const Dual outward = -program_.inverse().row(row);
    if (Separates(outward, FindBest(outward, column))) {
      std::copy_n(outward.data(), kDim, twist.begin());
      return Status::kInfeasible;
    }
    if (!program_.EnterAt(row, column)) return Status::kStalled;
  }
  return Status::kStalled;
}

template <int kDim>
typename WrenchSimplex<kDim>::Column WrenchSimplex<kDim>::Unbalanced(int row, double sign) {
  Column column{kUnbalanced, {}};
  column.entries[row] = sign;
  return column;
}

template <int kDim>
void WrenchSimplex<kDim>::FindNearest() {
  std::array<Column, kRows> columns;
  for (int r = 0; r < kDim; ++r) columns[r] = Unbalanced(r, target_[r] < start_[r] ? -1 : 1);
  columns[kDim] = {kStart, WithShare(start_, 1)};
  const std::array<double, kRows> right = WithShare(target_, 1);
  program_.StartFromBasis(columns, Dual(right.data()));
  const auto price = [&](const Dual& dual, Column& column) {
    double reduced_cost = FindBest(dual, column);
    for (int r = 0; r < kDim; ++r) {
      if (std::abs(dual[r]) - 1 <= reduced_cost) continue;
      reduced_cost = std::abs(dual[r]) - 1;
      column = Unbalanced(r, dual[r] < 0 ? -1 : 1);
    }
    return reduced_cost > kNearestGap * unbalanced();
  };
  program_.Run(price, kLimits);
  program_.Refactor();
}

template <int kDim>
typename WrenchSimplex<kDim>::Maximum WrenchSimplex<kDim>::Maximise(const Vector& column,
                                                                    double share,
                                                                    const Goal& goal) {
  program_.StartOptimality();
  const int row = program_.EnterFree({kMaximised, WithShare(column, share)});
  if (row < 0) return {kNoBound, kNoBound};
  program_.Refactor();
  Maximum maximum{0, kNoBound};
  const auto price = [&](const Dual& dual, Column& best) {
    const double reduced_cost = FindBest(dual, best);
    maximum.lower = program_.weights()[row];
    maximum.upper = std::min(maximum.upper, maximum.lower + std::max(reduced_cost, 0.0));
    return maximum.upper - maximum.lower > goal.gap && !(maximum.lower > goal.enough);
  };
  if (program_.Run(price, kLimits) == lp::End::kUnbounded) return {kNoBound, kNoBound};
  program_.Refactor();
  maximum.lower = program_.weights()[row];
  return maximum;
}

template <int kDim>
double WrenchSimplex<kDim>::BallRadius() const {
  if (program_.artificial_count() > 0) return 0;
  // A weight is 1 at its column and 0 on the opposite facet, so its gradient does not vanish.
  Dual squared = Dual::Zero();
  for (int c = 0; c < kDim; ++c) squared += program_.inverse().col(c).cwiseAbs2();
  return (program_.weights().array() / squared.array().sqrt()).minCoeff();
}

template <int kDim>
double WrenchSimplex<kDim>::Reach(const Vector& direction) const {
  Dual rate = Dual::Zero();
  for (int c = 0; c < kDim; ++c) rate -= direction[c] * program_.inverse().col(c);
  double reach = kNoBound;
  for (int r = 0; r < kRows; ++r) {
    if (rate[r] > 0) reach = std::min(reach, program_.weights()[r] / rate[r]);
  }
  return reach;
}

template <int kDim>
Eigen::Vector3d WrenchSimplex<kDim>::ForceOf(int contact) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int r = 0; r < kRows; ++r) {
    const Column* column = program_.column(r);
    if (column == nullptr) continue;
    const double weight = program_.weights()[r];
    if (column->contact == contact) {
      for (int c = 0; c < kDim / 2 + (kDim == 3 ? 1 : 0); ++c) {
        force[c] += weight * column->entries[c];
      }
    } else if (column->contact == kStart) {
      const UnitContact& unit = contacts_[contact];
      force += (weight * StartWeight(contact) * unit.axial) * unit.n;
    }
  }
  return force;
}

template <int kDim>
double WrenchSimplex<kDim>::TorqueOf(int contact) const {
  double torque = 0;
  if constexpr (kDim == 6) {
    const UnitContact& unit = contacts_[contact];
    if (unit.torsion == 0) return 0;
    for (int r = 0; r < kRows; ++r) {
      const Column* column = program_.column(r);
      if (column == nullptr || column->contact != contact) continue;
      const Eigen::Map<const Eigen::Vector3d> force(column->entries.data());
      const Eigen::Map<const Eigen::Vector3d> about_centre(column->entries.data() + 3);
      torque += program_.weights()[r] * unit.n.dot(about_centre - unit.q.cross(force));
    }
  }
  return torque;
}

template <int kDim>
typename WrenchSimplex<kDim>::Vector WrenchSimplex<kDim>::twist() const {
  const Dual dual = program_.dual();
  Vector twist;
  std::copy_n(dual.data(), kDim, twist.begin());
  return twist;
}

template <int kDim>
double WrenchSimplex<kDim>::unbalanced() const {
  double sum = program_.unbalanced();
  for (int r = 0; r < kRows; ++r) {
    const Column* column = program_.column(r);
    if (column != nullptr && column->contact == kUnbalanced) {
      sum += std::max(program_.weights()[r], 0.0);
    }
  }
  return sum;
}

template class WrenchSimplex<3>;
template class WrenchSimplex<6>;

}  // namespace regrasp::grasp
