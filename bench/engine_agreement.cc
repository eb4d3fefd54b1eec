// Whether two engines say the same: random grasps and switches of seven bodies at 0.7 to 1.5 times
// their critical friction, each replayed in MuJoCo and in ODE, the analytic check bypassed. Writes
// how often they agree by friction and by quality, every sample as CSV, and prints each case on
// which they differ with its likely cause.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bench/random_grasps.h"
#include "bench/sample_table.h"
#include "bench/table_file.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/largest_load.h"
#include "planner/grasp/quality.h"
#include "sim/measure/push.h"
#include "sim/replay/disagreement.h"
#include "sim/replay/replay.h"

namespace {

using namespace regrasp;

/// What both engines say of one case.
struct Comparison {
  std::string body, kind;
  int number = 0;  ///< in the draw
  double ratio = 0, quality = 0;
  std::string mujoco, ode;                 ///< reasons, empty for a pass
  double mujoco_moved = 0, ode_moved = 0;  ///< over the diameter
  double resisted = 0;  ///< least push that forces inside the cones balance, over the shake
  std::string cause;

  [[nodiscard]] bool agree() const { return mujoco.empty() == ode.empty(); }
};

/// The least push of the shake's directions that forces inside the true cones balance beside the
/// weight, over the shake: below 1 no hold can stand the shake.
double Resisted(const GraspedBody& body, const RandomCase& drawn,
                const sim::ReplaySettings& settings) {
  const object::WrenchFrame frame = body.object().wrench_frame();
  const double share = settings.mass_kg * settings.gravity_m_s2 / settings.squeeze_N;
  const grasp::Wrench weight{-share * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  double least = std::numeric_limits<double>::infinity();
  for (const sim::Push& push : sim::PushDirections(frame.dimension)) {
    const auto largest = grasp::ComputeLargestLoad(drawn.examined, frame, drawn.plan.half_angle,
                                                   weight, sim::PushWrench(push, 1), 1);
    least = std::min(least, largest ? largest->lower : 0);
  }
  return least / settings.shake;
}

Comparison Compare(const GraspedBody& body, const RandomCase& drawn) {
  sim::ReplayOptions options;
  options.engine = sim::EngineChoice::kBoth;
  const sim::ReplayResult result = sim::ReplayPlan(body.object(), drawn.plan, options);
  Comparison found;
  found.body = body.name();
  found.kind = drawn.plan.steps.empty() ? "hold" : "switch";
  found.ratio = drawn.ratio;
  found.quality =
      grasp::ComputeQuality(drawn.examined, body.object().wrench_frame(), drawn.plan.half_angle)
          .lower;
  found.resisted = Resisted(body, drawn, result.settings);
  for (const sim::StepReplay& step : result.steps) {
    if (!step.ode) break;
    found.mujoco = plan::ReasonName(step.reason);
    found.ode = plan::ReasonName(step.ode->reason);
    found.mujoco_moved = step.moved_m / result.settings.diameter_m;
    found.ode_moved = step.ode->moved_m / result.settings.diameter_m;
    plan::StepCheck check;
    check.index = step.index;
    if (static_cast<std::size_t>(step.index) == drawn.plan.steps.size()) {
      check.required = drawn.required;
    }
    const auto why = sim::ExplainEngines({body.object(), drawn.plan, check, step, result.settings});
    if (why) found.cause = sim::LikelyCauseText(*why);
  }
  return found;
}

std::string Share(const std::vector<Comparison>& all,
                  const std::function<bool(const Comparison&)>& in,
                  const std::function<bool(const Comparison&)>& has) {
  const auto count = std::count_if(all.begin(), all.end(), in);
  const auto both =
      std::count_if(all.begin(), all.end(), [&](const Comparison& c) { return in(c) && has(c); });
  return count == 0 ? "–" : std::to_string(both) + " of " + std::to_string(count);
}

TableFile AgreementTable(const std::string& name, const std::string& column,
                         const std::vector<Range>& ranges, const std::vector<Comparison>& all,
                         const std::function<std::optional<double>(const Comparison&)>& value) {
  TableFile table{name,
                  "Random grasps and switches by two engines",
                  {column, "agree", "MuJoCo passes", "ODE passes", "only MuJoCo", "only ODE"},
                  {}};
  for (const Range& range : ranges) {
    const auto in = [&](const Comparison& c) {
      const auto x = value(c);
      return x && *x >= range.from && *x < range.to;
    };
    const auto share = [&](const auto& has) { return Share(all, in, has); };
    table.rows.push_back(
        {range.name, share([](const Comparison& c) { return c.agree(); }),
         share([](const Comparison& c) { return c.mujoco.empty(); }),
         share([](const Comparison& c) { return c.ode.empty(); }),
         share([](const Comparison& c) { return c.mujoco.empty() && !c.ode.empty(); }),
         share([](const Comparison& c) { return !c.mujoco.empty() && c.ode.empty(); })});
  }
  return table;
}

TableFile SampleTable(const std::vector<Comparison>& all) {
  TableFile table{"samples",
                  "Every case",
                  {"body", "kind", "number", "ratio", "quality", "resisted", "mujoco", "ode",
                   "mujoco_moved", "ode_moved", "cause"},
                  {}};
  for (const Comparison& c : all) {
    std::string cause = c.cause;
    std::ranges::replace(cause, ',', ';');
    table.rows.push_back({c.body, c.kind, std::to_string(c.number), FormatShort(c.ratio, 5),
                          FormatShort(c.quality, 4), FormatShort(c.resisted, 4), c.mujoco, c.ode,
                          FormatShort(c.mujoco_moved), FormatShort(c.ode_moved), cause});
  }
  return table;
}

/// Outside the band about the critical friction; of force-closure grasps those above the shake.
bool Clear(const Comparison& c) {
  const double shake = sim::ReplayOptions().shake;
  return std::abs(c.ratio - 1) > sim::kNearCriticalOfTwo && (c.ratio < 1 || c.quality > shake);
}

int Run(const std::filesystem::path& models, const std::filesystem::path& folder, int count) {
  constexpr std::uint64_t kSeed = 2323;
  std::filesystem::create_directories(folder);
  std::vector<Comparison> all;
  for (const char* name : kGraspedBodies) {
    const GraspedBody body(models / name);
    for (const auto& cases : {DrawHolds(body, count, kSeed), DrawSwitches(body, count, kSeed)}) {
      for (std::size_t i = 0; i < cases.size(); ++i) {
        Comparison& found = all.emplace_back(Compare(body, cases[i]));
        found.number = static_cast<int>(i);
        if (found.agree()) continue;
        std::printf(
            "%s %s %d, %.4f of the critical friction, quality %.4f, resists %.3f of the shake: "
            "%s, %s; %s\n",
            found.body.c_str(), found.kind.c_str(), found.number, found.ratio, found.quality,
            found.resisted, found.mujoco.empty() ? "MuJoCo passes" : "ODE passes",
            (found.mujoco.empty() ? found.ode : found.mujoco).c_str(), found.cause.c_str());
        std::fflush(stdout);
      }
    }
  }
  const auto friction = [](const Comparison& c) { return std::optional(c.ratio); };
  const auto quality = [](const Comparison& c) {
    return c.ratio < 1 ? std::nullopt : std::optional(c.quality);
  };
  WriteTable(AgreementTable("agreement_by_friction", "friction", kRatios, all, friction), folder);
  WriteTable(AgreementTable("agreement_by_quality", "quality", kQualities, all, quality), folder);
  WriteTable(SampleTable(all), folder);
  const auto clear = std::count_if(all.begin(), all.end(), Clear);
  const auto agree = std::count_if(all.begin(), all.end(),
                                   [](const Comparison& c) { return Clear(c) && c.agree(); });
  std::printf(
      "%zu grasps and switches; of %d outside the band and above the shake the engines "
      "agree on %d\n",
      all.size(), static_cast<int>(clear), static_cast<int>(agree));
  constexpr double kLeastShare = 0.99;
  return static_cast<double>(agree) >= kLeastShare * static_cast<double>(clear) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = argc == 4 ? ParseDouble(argv[3]) : std::optional<double>();
  if (!count || *count < 1 || *count > 1e6) {
    std::fprintf(stderr, "usage: engine_agreement MODELS_FOLDER OUTPUT_FOLDER GRASPS_PER_BODY\n");
    return 2;
  }
  try {
    return Run(argv[1], argv[2], static_cast<int>(*count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "engine_agreement: %s\n", error.what());
    return 2;
  }
}
