#pragma once

#include <span>
#include <vector>

#include "planner/grasp/force_closure.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Many grasps of equally many contacts, as plain numbers that somebody else owns: N x k x 3 values
/// in row-major order, so that contact c of grasp g begins at (g · k + c) · 3.
struct GraspArrays {
  std::span<const double> points;
  std::span<const double> normals;  ///< unit, into the object
  int contacts = 0;                 ///< k, of each grasp
};

/// What is asked of each grasp besides force closure, and by how many threads.
struct JudgeOptions {
  double half_angle = 0;  ///< of the friction cones, atan μ, radians in (0, π/2)
  object::WrenchFrame frame;
  double torsion = 0;  ///< of all contacts (Contact::torsion), the points' unit of length
  bool required_half_angle = false;
  bool quality = false;
  int threads = 0;  ///< 0: as many as the machine has cores
};

/// One entry a grasp, in the order given; what was not asked for is empty.
struct GraspVerdicts {
  std::vector<ForceClosure> force_closure;
  /// The smallest half-angle proved to be enough, radians; NaN where none below π/2 is.
  std::vector<double> required_half_angle;
  std::vector<double> quality;        ///< lower bound of BoundQuality, dimensionless
  std::vector<double> quality_upper;  ///< upper bound of BoundQuality
};

/// Judges every grasp by TestForceClosure, ComputeRequiredHalfAngle and BoundQuality.
///
/// Laws: each verdict has the bits that the function for a single grasp gives; they do not depend
/// on the number of threads.
///
/// @throws std::invalid_argument  the arrays do not hold N x k x 3 values each, fewer than 0
///                                threads, a bad half-angle, or a grasp that TestForceClosure
///                                refuses: the message names the first such grasp, counted from 0.
[[nodiscard]] GraspVerdicts JudgeGrasps(const GraspArrays& grasps, const JudgeOptions& options);

}  // namespace regrasp::grasp
