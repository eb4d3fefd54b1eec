// Plans of a hand, replayed on its own actuators.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>

#include "planner/base/angle.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/locate.h"
#include "planner/plan/plan_io.h"
#include "planner/base/file.h"
#include "planner/grasp/quality.h"
#include "sim/actuation/hand_replay.h"
using namespace regrasp;
int main(int argc, char** argv) {
  CLI::App app("x");
  std::string hand, object; std::vector<std::string> plans;
  sim::HandReplayOptions o; bool fixed=false, verbose=false; double density=1000;
  app.add_option("--hand", hand); app.add_option("--object", object);
  app.add_option("--friction", o.friction_factor); app.add_option("--massf", o.mass_factor);
  app.add_option("--force", o.force_factor); app.add_option("--squeeze", o.squeeze_N);
  app.add_option("--shake", o.shake); app.add_flag("--fixed", fixed); app.add_flag("-v", verbose);
  app.add_option("--density", density); double tol=1; app.add_option("--tol", tol);
  app.add_option("plans", plans); double mu = 0; app.add_option("--mu", mu);
  CLI11_PARSE(app, argc, argv);
  o.tolerance.length_m *= tol; o.tolerance.angle_rad *= tol;
  o.feedback = !fixed; if (mu > 0) o.half_angle = std::atan(mu);
  try {
  const auto file = kinematics::ReadHandFile(hand);
  const auto read = object::ReadObject(object);
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*read.object);
  int pass = 0;
  for (const auto& p : plans) {
    const plan::Plan plan = plan::LocatePlan(solid, plan::ParsePlan(ReadFile(p), p));
    const double s3 = plan.scale * plan.scale * plan.scale;
    o.mass_kg = density * solid.mass_properties().volume * s3;
    double eps = 1; { plan::FingerGrasp g = plan.initial; auto q=[&]{ eps = std::min(eps, grasp::ComputeQuality(plan::ContactsOf(g), solid.wrench_frame(), o.half_angle.value_or(plan.half_angle)).lower); }; q(); for (const auto& st : plan.steps) { g = plan::GraspAfter(g, st); q(); } }
    const std::clock_t t0 = std::clock();
    int n = 0;
    sim::HandReplayObserver ob; ob.on_step = [&](const sim::HandWorld& w) {
      if (verbose && n++ % 100 == 0) {
        std::printf("  t %.2f", w.time());
        for (FingerIndex f{0}; f < std::ssize(w.hand().fingers); ++f) {
          const auto t = w.touch(f);
          std::printf(" [%6.3f N %7.3f mm]", t.force.norm(), 1e3 * t.gap);
        }
        std::printf("\n");
      }
    };
    const auto r = sim::ReplayHand(file, solid, plan, o, ob);
    const double cpu = double(std::clock() - t0) / CLOCKS_PER_SEC;
    double sim_s = 0;
    for (const auto& st : r.steps) {
      sim_s += st.hand->simulated_s;
      const auto& m = *st.hand;
      if (verbose) std::printf(" step %d: off %.2f mm %.2f deg, rest %.2f mm %.2f deg, slip %.2f roll %.2f mm load %.2f, %.2f s %s\n",
        int(st.index), 1e3 * m.off_m, Degrees(m.off_rad), 1e3 * m.rest_off_m, Degrees(m.rest_off_rad), 1e3 * m.slip_m, 1e3 * m.roll_m, m.torque_share, m.simulated_s, st.detail.c_str());
    }
    const auto& last = r.steps.back();
    const bool bad = last.reason != plan::Reason::kNone; if (!bad) ++pass;
    std::printf("%s: eps %.3f %zu of %zu steps, squeeze %.2f N, %.0f g, end %.2f mm %.2f deg, sim %.1f s, cpu %.2f s (%.3f/s): %s\n", p.c_str(), eps, r.steps.size() - (bad ? 1 : 0), plan.steps.size() + 1,
      r.settings.squeeze_N, 1e3 * o.mass_kg, 1e3 * last.hand->rest_off_m, Degrees(last.hand->rest_off_rad), sim_s, cpu, cpu / sim_s, bad ? (std::to_string(int(last.index)) + " " + last.detail).c_str() : "pass");
  }
  std::printf("%d of %zu pass\n", pass, plans.size());
  } catch (const std::exception& e) { std::cerr << e.what() << "\n"; return 2; }
}
