#pragma once

#include <vector>

#include "planner/criteria/grasp_criteria.h"
#include "planner/object/wrench_frame.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// What a search asks of a roadmap's grasps, which are force closure: worked out when first asked
/// and then remembered by their vertices, of which there are millions.
class VertexQuality {
 public:
  /// @param roadmap  outlives this object.
  VertexQuality(const Roadmap& roadmap, const object::WrenchFrame& frame,
                const criteria::GraspCriteria& criteria);

  /// MeetsCriteria.
  [[nodiscard]] bool IsGood(int vertex);

  /// The half-angle less the required half-angle, radians, to `kMarginTolerance`.
  [[nodiscard]] double Margin(int vertex);

  /// How many grasps were asked for their quality, and for their margin.
  [[nodiscard]] int quality_count() const { return quality_count_; }
  [[nodiscard]] int margin_count() const { return margin_count_; }

 private:
  enum class Known : unsigned char { kNothing, kBad, kGood };

  const Roadmap& roadmap_;
  object::WrenchFrame frame_;
  criteria::GraspCriteria criteria_;
  std::vector<Known> good_;
  std::vector<double> margin_;  ///< NaN where not known yet
  int quality_count_ = 0;
  int margin_count_ = 0;
};

/// Radians: differences of margin that a plan does not care for (6e-6 degrees).
inline constexpr double kMarginTolerance = 1e-7;

}  // namespace regrasp::roadmap
