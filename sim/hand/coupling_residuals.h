#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// Couplings of a hand's joints from its model and its file, independent of the planner's
/// kinematics.
/// They are equality constraints of joints and of fixed tendons, `<mimic>`, and the couplings of
/// the hand file.
class CouplingResiduals {
 public:
  explicit CouplingResiduals(const kinematics::HandFile& file);

  /// Deviation of a joint from the angle that a coupling requires.
  struct Residual {
    int joint = -1;      ///< joint of the model; -1 if nothing is coupled
    double radians = 0;  ///< absolute value
    std::string source;  ///< element that defines the coupling, for messages
  };
  /// Return the largest residual in the joint positions of `data`.
  [[nodiscard]] Residual Largest(const mjData_& data) const;

 private:
  /// Term of Σ coefficient · joint angle = constant; the first joint follows the others.
  struct Term {
    int joint;
    double coefficient;
  };
  struct Equation {
    std::vector<Term> terms;
    double constant = 0;
    std::string source;
  };
  void AddEqualities();
  void AddRelation(const std::string& joint, const std::string& leader, double ratio, double offset,
                   const std::string& source);
  void AddTendon(int tendon, double factor, Equation& equation) const;

  const mjModel_& model_;  ///< owned by the hand file
  std::vector<Equation> equations_;
};

}  // namespace regrasp::sim
