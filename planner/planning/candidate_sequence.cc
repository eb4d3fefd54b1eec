#include "planner/planning/candidate_sequence.h"

namespace regrasp::planning {

CandidateSequence StartOf(const grasp::Grasp& grasp) {
  CandidateSequence candidate;
  candidate.initial = plan::FingersInOrder(grasp);
  candidate.rests = {{grasp, std::nullopt}};
  return candidate;
}

}  // namespace regrasp::planning
