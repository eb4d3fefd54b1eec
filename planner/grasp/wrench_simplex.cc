#include "planner/grasp/wrench_simplex.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/cone_support.h"

namespace regrasp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A twist separates only if it does so by this much of |twist| · |wrench|: some thousand roundings
/// of a double, where evaluating the support function makes about twenty.
constexpr double kSeparation = 1e-12;

/// Entries below this (the tableau's are of the order of 1) are no pivots: the inverse would lose
/// more than half of its digits.
constexpr double kPivot = 1e-9;

/// Basic weights are allowed to be this much below zero in the ratio test (Harris 1973), so that a
/// larger pivot can be taken among nearly equal ratios.
constexpr double kRatioSlack = 1e-13;

/// A column improves only if its reduced cost exceeds this, relative to |twist| · |wrench|.
constexpr double kImprovement = 1e-14;

/// The distance to the hull is found to this part of itself: closer, neighbouring rim forces of one
/// contact become nearly the same column, and the inverse loses its digits.
constexpr double kNearestGap = 1e-6;

/// Grasps take 5 to 20 pivots, forces of full precision 30 to 60: what takes more is stalling.
constexpr int kMaxPivots = 200;

/// After so many pivots the inverse is computed afresh.
constexpr int kRefactorAfter = 24;

/// Multiples of the golden ratio, modulo 1, never repeat: no two contacts weigh the same.
double UnevenWeight(int i) {
  const double turns = i * 0.6180339887498949;
  return 1 + 0.5 * (turns - std::floor(turns));
}

}  // namespace

template <int kDim>
WrenchSimplex<kDim>::WrenchSimplex(std::span<const UnitContact> contacts, const Vector& target)
    : contacts_(contacts), target_(target) {
  target_size_ = 0;
  for (double value : target) target_size_ += std::abs(value);
  column_size_ = 0;
  const int count = static_cast<int>(contacts.size());
  for (int i = 0; i < count; ++i) start_weight_sum_ += UnevenWeight(i);
  for (int i = 0; i < count; ++i) {
    const UnitContact& contact = contacts[i];
    column_size_ = std::max(
        column_size_, (contact.axial + contact.tangential) * (1 + contact.q.template lpNorm<1>()));
    Vector wrench;
    WriteWrench<kDim>(contact, (StartWeight(i) * contact.axial) * contact.n, wrench.data());
    for (int r = 0; r < kDim; ++r) start_[r] += wrench[r];
  }
  Column& start = basis_[kDim];
  start.contact = kStart;
  std::copy(start_.begin(), start_.end(), start.entries.begin());
  start.entries[kDim] = 1;

  for (auto& row : tableau_) row.fill(0);
  auto& objective = tableau_[kRows];
  for (int r = 0; r < kDim; ++r) {
    const double missing = target[r] - start.entries[r];
    const double sign = missing < 0 ? -1 : 1;
    basis_[r].contact = kArtificial;
    basis_[r].entries.fill(0);
    basis_[r].entries[r] = sign;
    tableau_[r][r] = sign;
    tableau_[r][kDim] = -sign * start.entries[r];
    tableau_[r][kSolution] = sign * missing;
    for (int c = 0; c < kTableau; ++c) objective[c] += tableau_[r][c];
  }
  tableau_[kDim][kDim] = 1;
  tableau_[kDim][kSolution] = 1;
}

template <int kDim>
double WrenchSimplex<kDim>::StartWeight(int contact) const {
  return UnevenWeight(contact) / start_weight_sum_;
}

template <int kDim>
typename WrenchSimplex<kDim>::Column WrenchSimplex<kDim>::BestColumn() const {
  const double* twist = tableau_[kRows].data();
  double best = -kInfinity;
  Column column{};
  Eigen::Vector3d best_velocity = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Eigen::Vector3d u = Velocity<kDim>(contacts_[i], twist);
    const double value = ConeSupport(contacts_[i], u);
    if (value > best) {
      best = value;
      best_velocity = u;
      column.contact = static_cast<int>(i);
    }
  }
  const UnitContact& contact = contacts_[column.contact];
  WriteWrench<kDim>(contact, SupportForce<kDim>(contact, best_velocity), column.entries.data());
  column.entries[kDim] = 1;
  return column;
}

template <int kDim>
double WrenchSimplex<kDim>::Support(std::span<const UnitContact> contacts, const Vector& twist) {
  double best = -kInfinity;
  for (const UnitContact& contact : contacts) {
    best = std::max(best, ConeSupport(contact, Velocity<kDim>(contact, twist.data())));
  }
  return best;
}

template <int kDim>
double WrenchSimplex<kDim>::ReducedCost(const Column& column) const {
  double value = 0;
  for (int r = 0; r < kRows; ++r) value += tableau_[kRows][r] * column.entries[r];
  return value;
}

template <int kDim>
double WrenchSimplex<kDim>::TwistSize() const {
  double size = 0;
  for (int r = 0; r < kDim; ++r) size += std::abs(tableau_[kRows][r]);
  return size;
}

template <int kDim>
bool WrenchSimplex<kDim>::Separates(double reduced_cost) const {
  // y·w ≤ reduced_cost − y_last for all columns w; the target must lie beyond that.
  double beyond = tableau_[kRows][kDim] - reduced_cost;
  for (int r = 0; r < kDim; ++r) beyond += tableau_[kRows][r] * target_[r];
  return beyond > kSeparation * TwistSize() * (column_size_ + target_size_);
}

template <int kDim>
int WrenchSimplex<kDim>::ChooseLeaving(const std::array<double, kTableau>& alpha) const {
  std::array<double, kRows> ratios;
  double bound = kInfinity;
  for (int r = 0; r < kRows; ++r) {
    const bool artificial = basis_[r].contact == kArtificial;
    // While maximising, artificial columns weigh nothing and must stay so: whichever way the
    // entering column would move them, they leave.
    if (maximising_ && artificial && std::abs(alpha[r]) > kPivot) return r;
    ratios[r] = kInfinity;
    if (!(alpha[r] > kPivot) || basis_[r].contact == kExtra) continue;
    const double inverse = 1 / alpha[r];
    ratios[r] = std::max(tableau_[r][kSolution], 0.0) * inverse;
    bound = std::min(bound, ratios[r] + kRatioSlack * inverse);
  }
  int leaving = -1;
  double largest = 0;
  for (int r = 0; r < kRows; ++r) {
    if (!(ratios[r] <= bound) || ratios[r] == kInfinity) continue;
    const double preference = basis_[r].contact == kArtificial ? 2 * alpha[r] : alpha[r];
    if (preference > largest) {
      largest = preference;
      leaving = r;
    }
  }
  return leaving;
}

template <int kDim>
bool WrenchSimplex<kDim>::Enter(const Column& column) {
  std::array<double, kTableau> alpha;
  for (int r = 0; r < kTableau; ++r) {
    double sum = 0;
    for (int c = 0; c < kRows; ++c) sum += tableau_[r][c] * column.entries[c];
    alpha[r] = sum;
  }
  const int leaving = ChooseLeaving(alpha);
  if (leaving < 0) return false;
  if (basis_[leaving].contact == kArtificial) --artificial_count_;
  Pivot(leaving, alpha);
  basis_[leaving] = column;
  if (++pivots_since_refactor_ >= kRefactorAfter) Refactor();
  return true;
}

template <int kDim>
void WrenchSimplex<kDim>::Pivot(int leaving, const std::array<double, kTableau>& alpha) {
  auto& pivot_row = tableau_[leaving];
  const double scale = 1 / alpha[leaving];
  for (double& value : pivot_row) value *= scale;
  for (int r = 0; r < kTableau; ++r) {
    if (r == leaving) continue;
    for (int c = 0; c < kTableau; ++c) tableau_[r][c] -= alpha[r] * pivot_row[c];
  }
}

template <int kDim>
void WrenchSimplex<kDim>::Refactor() {
  Eigen::Matrix<double, kRows, kRows> matrix;
  for (int c = 0; c < kRows; ++c) {
    for (int r = 0; r < kRows; ++r) matrix(r, c) = basis_[c].entries[r];
  }
  const Eigen::Matrix<double, kRows, kRows> inverse = matrix.inverse();
  tableau_[kRows].fill(0);
  for (int r = 0; r < kRows; ++r) {
    double weight = inverse(r, kDim);
    for (int c = 0; c < kRows; ++c) tableau_[r][c] = inverse(r, c);
    for (int c = 0; c < kDim; ++c) weight += inverse(r, c) * target_[c];
    tableau_[r][kSolution] = weight;
    const double cost = maximising_ ? (basis_[r].contact == kExtra ? -1 : 0)
                                    : (basis_[r].contact == kArtificial ? 1 : 0);
    for (int c = 0; c < kTableau; ++c) tableau_[kRows][c] += cost * tableau_[r][c];
  }
  pivots_since_refactor_ = 0;
}

template <int kDim>
typename WrenchSimplex<kDim>::Status WrenchSimplex<kDim>::FindWeights(bool stop_early) {
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    const Column column = BestColumn();
    const double reduced_cost = ReducedCost(column);
    if (stop_early && Separates(reduced_cost)) return Status::kInfeasible;
    if (!(reduced_cost > kImprovement * TwistSize() * column_size_)) break;
    if (reduced_cost <= kNearestGap * unbalanced()) break;
    if (!Enter(column)) break;
    if (artificial_count_ == 0) return Status::kFeasible;
  }
  Refactor();
  if (unbalanced() <= kSeparation * column_size_) return Status::kFeasible;
  return Separates(ReducedCost(BestColumn())) ? Status::kInfeasible : Status::kStalled;
}

template <int kDim>
typename WrenchSimplex<kDim>::Maximum WrenchSimplex<kDim>::Maximise(const Vector& column,
                                                                    double share,
                                                                    const Goal& goal) {
  Column extra;
  extra.contact = kExtra;
  std::copy(column.begin(), column.end(), extra.entries.begin());
  extra.entries[kDim] = share;
  maximising_ = true;
  if (!Enter(extra)) return {kInfinity, kInfinity};
  Refactor();
  const auto is_extra = [](const Column& basic) { return basic.contact == kExtra; };
  const auto row = std::find_if(basis_.begin(), basis_.end(), is_extra) - basis_.begin();
  Maximum maximum{0, kInfinity};
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    const Column best = BestColumn();
    const double reduced_cost = ReducedCost(best);
    maximum.lower = tableau_[row][kSolution];
    maximum.upper = std::min(maximum.upper, maximum.lower + std::max(reduced_cost, 0.0));
    if (maximum.upper - maximum.lower <= goal.gap) break;
    if (maximum.lower > goal.enough) break;
    if (!Enter(best)) return {kInfinity, kInfinity};
  }
  Refactor();
  maximum.lower = tableau_[row][kSolution];
  return maximum;
}

template <int kDim>
double WrenchSimplex<kDim>::BallRadius() const {
  double radius = kInfinity;
  for (int r = 0; r < kRows; ++r) {
    if (basis_[r].contact == kArtificial) return 0;
    double squared = 0;
    for (int c = 0; c < kDim; ++c) squared += tableau_[r][c] * tableau_[r][c];
    // The gradient of the weight vanishes only where the column alone fills its facet's side.
    radius = std::min(radius, tableau_[r][kSolution] / std::sqrt(squared));
  }
  return radius;
}

template <int kDim>
double WrenchSimplex<kDim>::Reach(const Vector& direction) const {
  double reach = kInfinity;
  for (int r = 0; r < kRows; ++r) {
    double rate = 0;
    for (int c = 0; c < kDim; ++c) rate -= tableau_[r][c] * direction[c];
    if (rate > 0) reach = std::min(reach, tableau_[r][kSolution] / rate);
  }
  return reach;
}

template <int kDim>
Eigen::Vector3d WrenchSimplex<kDim>::ForceOf(int contact) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int r = 0; r < kRows; ++r) {
    const double weight = tableau_[r][kSolution];
    if (basis_[r].contact == contact) {
      for (int c = 0; c < kDim / 2 + (kDim == 3 ? 1 : 0); ++c) {
        force[c] += weight * basis_[r].entries[c];
      }
    } else if (basis_[r].contact == kStart) {
      const UnitContact& unit = contacts_[contact];
      force += (weight * StartWeight(contact) * unit.axial) * unit.n;
    }
  }
  return force;
}

template <int kDim>
typename WrenchSimplex<kDim>::Vector WrenchSimplex<kDim>::twist() const {
  Vector twist;
  std::copy_n(tableau_[kRows].begin(), kDim, twist.begin());
  return twist;
}

template <int kDim>
double WrenchSimplex<kDim>::unbalanced() const {
  double sum = 0;
  for (int r = 0; r < kRows; ++r) {
    if (basis_[r].contact == kArtificial) sum += std::max(tableau_[r][kSolution], 0.0);
  }
  return sum;
}

template class WrenchSimplex<3>;
template class WrenchSimplex<6>;

}  // namespace regrasp
