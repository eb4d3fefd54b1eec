#pragma once

#include <span>
#include <vector>

#include "planner/grasp/force_closure.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Non-owning arrays of N grasps with k contacts each.
/// Both arrays are N x k x 3 in row-major order: contact c of grasp g begins at (g · k + c) · 3.
struct GraspArrays {
  std::span<const double> points;
  std::span<const double> normals;  ///< unit vectors into the object
  int contacts = 0;                 ///< k, number of contacts per grasp
};

/// Optional computations of JudgeGrasps, and the number of threads.
struct JudgeOptions {
  double friction_angle = 0;  ///< friction angle, atan μ, radians in (0, π/2)
  object::WrenchFrame frame;
  /// Torsional friction length of all contacts (Contact::torsion), in the unit of the points.
  double torsion = 0;
  bool required_friction_angle = false;
  bool quality = false;
  int threads = 0;  ///< number of threads; 0: one per core of the machine
};

/// Results with one element per grasp, in input order; empty if not requested.
struct GraspVerdicts {
  std::vector<ForceClosure> force_closure;
  /// Smallest friction angle proved to be enough, radians; NaN if no angle below π/2 is enough.
  std::vector<double> required_friction_angle;
  std::vector<double> quality;        ///< lower bound of BoundQuality, dimensionless
  std::vector<double> quality_upper;  ///< upper bound of BoundQuality
};

/// Evaluate every grasp with TestForceClosure, ComputeRequiredFrictionAngle and BoundQuality.
///
/// Laws: each result is bit-identical to that of the function for a single grasp, for any number of
/// threads.
///
/// @throws std::invalid_argument  if an array does not have N x k x 3 values, the number of threads
///     is negative, the friction angle is invalid, or TestForceClosure rejects a grasp. The message
///     names the first such grasp, counted from 0.
[[nodiscard]] GraspVerdicts JudgeGrasps(const GraspArrays& grasps, const JudgeOptions& options);

}  // namespace regrasp::grasp
