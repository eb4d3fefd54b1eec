#pragma once

#include <string>
#include <vector>

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// The couplings of revolute joints that a model keeps as constraints.
/// They are equalities of joints, and of tendons that are sums of joint angles.
class JointCouplings {
 public:
  explicit JointCouplings(const mjModel_& model);

  /// Deviation of joints from a coupling.
  struct Residual {
    int equality = -1;  ///< index of the equality in the model; −1 if there is no coupling
    double rad = 0;
  };
  /// Return the largest residual in a state.
  /// @param data  data of the model with the lengths of tendons.
  [[nodiscard]] Residual Largest(const mjModel_& model, const mjData_& data) const;

  /// Return the first joint of an equality of this object.
  [[nodiscard]] int JointOf(const mjModel_& model, int equality) const;
  /// Return "joint ffj1, which the model couples to ffj2".
  [[nodiscard]] std::string TextOf(const mjModel_& model, int equality) const;

 private:
  std::vector<int> joints_;   ///< equalities of joints
  std::vector<int> tendons_;  ///< equalities of tendons
};

}  // namespace regrasp::sim
