// Fuzz target: any bytes as a report of a small plan. Verification and summary must give a result
// or a one-line error.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "apps/batch/report_summary.h"
#include "apps/verify_report.h"
#include "hostile_input.h"
#include "planner/base/number.h"
#include "planner/object/polyhedron.h"
#include "small_objects.h"

namespace {

using namespace regrasp;

/// Digest in the reports of the corpus. Hashing is not part of the reader.
const std::string kObjectDigest(64, '0');
const std::string kPlanDigest(64, '1');

constexpr double kFrictionAngleDegrees = 30;

/// Return a plan in which six fingers hold the cube, one of them is released, and the others then
/// slide slightly.
plan::Plan MakePlan() {
  plan::Plan plan;
  plan.dimension = 3;
  plan.friction_angle = Radians(kFrictionAngleDegrees);
  plan.fingers = 6;
  plan::FingerGrasp held;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d p = side * Eigen::Vector3d::Unit(axis);
      held.push_back({FingerIndex(held.size()), {p, -p, {}}});
    }
  }
  plan.initial = held;
  plan.steps.push_back(plan::Switch{{}, {FingerIndex(5)}});
  held.pop_back();
  plan::FingerGrasp moved = held;
  moved[0].contact.p.y() = moved[1].contact.p.y() = 0.1;
  plan.steps.push_back(plan::Align{{held, moved}});
  for (const plan::FingerContact& finger : moved) plan.goal.push_back(finger.contact);
  return plan;
}

void ReadAndVerify(std::string_view text) {
  static const plan::Plan plan = MakePlan();
  const apps::ReportVerification found =
      apps::VerifyReport(text, kHostileName, {SmallSolid(), kObjectDigest, plan, kPlanDigest});
  if (found.text.empty()) ReportFinding("a report was verified without a word");
}

void Summarize(std::string_view text) {
  const apps::ReportSummary summary =
      apps::SummarizeReport(ParseJson(text, kHostileName), kHostileName);
  if (summary.entries.empty()) ReportFinding("a report without entries");
  const auto count = static_cast<int>(summary.entries.size());
  if (summary.weakest_step.value_or(0) >= count) ReportFinding("a weakest step outside the plan");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ReadHostileInput([&] { ReadAndVerify(text); });
  ReadHostileInput([&] { Summarize(text); });
  return 0;
}
