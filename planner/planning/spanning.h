#pragma once

namespace regrasp::planning {

/// Half-angle φ of the cones of concurrent grasps, θ being the friction's.
enum class Spanning {
  kAdaptive,  ///< φ = min(θ, φ*), φ* the supremum of angles for which the normals φ-positively span
  kUniform,  ///< φ = θ where the normals θ-positively span, no set where they don't
};

}  // namespace regrasp::planning
