#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// The couplings of a hand's joints as its model and its file state them, without the planner's
/// kinematics: equality constraints of joints and of fixed tendons, `<mimic>`, and the couplings of
/// the hand's file.
class CouplingResiduals {
 public:
  explicit CouplingResiduals(const kinematics::HandFile& file);

  /// How far a joint is from the angle that a coupling demands.
  struct Residual {
    int joint = -1;      ///< joint of the model; -1 if nothing is coupled
    double radians = 0;  ///< absolute value
    std::string source;  ///< element that states the coupling, for messages
  };
  /// Return the largest residual in the joint positions of `data`.
  [[nodiscard]] Residual Largest(const mjData_& data) const;

 private:
  /// Σ coefficient · angle of joint = constant; the first joint follows the others.
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

  const mjModel_& model_;  ///< kept by the hand's file
  std::vector<Equation> equations_;
};

}  // namespace regrasp::sim
