#include "planner/roadmap/vertex_quality.h"

#include <cmath>
#include <limits>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp {

VertexQuality::VertexQuality(const Roadmap& roadmap, const WrenchFrame& frame, double half_angle,
                             double min_quality)
    : roadmap_(roadmap),
      frame_(frame),
      half_angle_(half_angle),
      min_quality_(min_quality),
      good_(roadmap.vertex_count(), Known::kNothing),
      margin_(roadmap.vertex_count(), std::numeric_limits<double>::quiet_NaN()) {}

bool VertexQuality::IsGood(int vertex) {
  if (good_[vertex] == Known::kNothing) {
    ++quality_count_;
    const bool good = QualityAtLeast(roadmap_.grasp(vertex), frame_, half_angle_, min_quality_);
    good_[vertex] = good ? Known::kGood : Known::kBad;
  }
  return good_[vertex] == Known::kGood;
}

double VertexQuality::Margin(int vertex) {
  if (std::isnan(margin_[vertex])) {
    ++margin_count_;
    const auto required =
        ComputeRequiredHalfAngle(roadmap_.grasp(vertex), frame_, kMarginTolerance);
    // A vertex is force closure at the half-angle, so at worst its margin rounds to nothing.
    margin_[vertex] = required ? half_angle_ - required->upper : 0;
  }
  return margin_[vertex];
}

}  // namespace regrasp
