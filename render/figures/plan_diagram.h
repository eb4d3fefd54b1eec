#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "planner/plan/snapshot.h"
#include "render/figures/grasp_diagram.h"

namespace regrasp::render {

/// A place on the polygon's border and the unit normal that points out of the material there.
struct BorderPoint {
  Eigen::Vector2d p;
  Eigen::Vector2d outward;
};

/// One finger in a figure.
struct DiagramFinger {
  FingerIndex finger = {};
  plan::FingerRole role = plan::FingerRole::kHolding;
  BorderPoint contact;
  /// The path of a moved finger, its start first and its contact last; empty for the others.
  std::vector<BorderPoint> path;
};

/// What a figure shows of one entry of a plan: the grasp after it, and what the fingers did.
struct StepDiagram {
  std::string kind;     ///< "hold", or as StepKind
  std::string caption;  ///< "(a) hold: fingers 0, 1, 2; concurrent grasp"
  GraspDiagram grasp;   ///< its cones belong to the first of `fingers`, in their order
  std::vector<DiagramFinger> fingers;  ///< those that hold after the step, then released ones
};

/// The figures of a plan: the hold of the initial grasp, then one for each step.
///
/// The caption says what happens, the type of the grasp after it, and the cones' half-angle φ where
/// it is smaller than the friction's θ.
/// @param plan  of this polygon, located (LocatePlan), and legal (CheckPlan).
[[nodiscard]] std::vector<StepDiagram> DescribePlan(const object::Polygon& polygon,
                                                    const plan::Plan& plan);

/// "(a)" … "(z)", "(aa)", "(ab)" …
[[nodiscard]] std::string PanelLabel(int index);

}  // namespace regrasp::render
