#include "planner/roadmap/vertex_quality.h"

#include <cmath>
#include <limits>

#include "planner/grasp/required_half_angle.h"

namespace regrasp::roadmap {

VertexQuality::VertexQuality(const Roadmap& roadmap, const object::WrenchFrame& frame,
                             const criteria::GraspCriteria& criteria)
    : roadmap_(roadmap),
      frame_(frame),
      criteria_(criteria),
      good_(roadmap.vertex_count(), Known::kNothing),
      margin_(roadmap.vertex_count(), std::numeric_limits<double>::quiet_NaN()) {}

bool VertexQuality::IsGood(int vertex) {
  if (good_[vertex] == Known::kNothing) {
    ++quality_count_;
    const bool good = criteria::MeetsCriteria(roadmap_.grasp(vertex), frame_, criteria_);
    good_[vertex] = good ? Known::kGood : Known::kBad;
  }
  return good_[vertex] == Known::kGood;
}

double VertexQuality::Margin(int vertex) {
  if (std::isnan(margin_[vertex])) {
    ++margin_count_;
    const auto required =
        grasp::ComputeRequiredHalfAngle(roadmap_.grasp(vertex), frame_, kMarginTolerance);
    // A vertex is force closure at the half-angle, so at worst its margin rounds to nothing.
    margin_[vertex] = required ? criteria_.half_angle - required->upper : 0;
  }
  return margin_[vertex];
}

}  // namespace regrasp::roadmap
