#include "planner/planning/candidate_sequence.h"

namespace regrasp::planning {

CandidateSequence StartOf(const grasp::Grasp& grasp) {
  CandidateSequence candidate;
  for (const grasp::Contact& contact : grasp) {
    candidate.initial.push_back({static_cast<int>(candidate.initial.size()), contact});
  }
  candidate.rests = {{grasp, std::nullopt}};
  return candidate;
}

}  // namespace regrasp::planning
