// Benchmark of the grasp quality ε of four contacts.
// It compares certified bounds with circular cones and the hull of friction pyramids with 8 and 16
// sides, on the same grasps in the same run. It prints times, and as error the deficit of the
// pyramids' quality from the certified one.
//
// usage: quality_bench [GRASPS]

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench/processor_clock.h"
#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_hull.h"
#include "planner/grasp/quality.h"

namespace {

using namespace regrasp;

constexpr double kFrictionAngle = Radians(25);
constexpr int kContacts = 4;
/// Qhull takes tens of milliseconds per grasp.
constexpr int kMostForPyramids = 100;
const object::WrenchFrame kFrame{Eigen::Vector3d::Zero(), 1, 3};

grasp::Contact RandomContact(std::mt19937_64& engine, bool box) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
  };
  if (!box) {
    const Eigen::Vector3d p = direction();
    return {p, (-p + 0.3 * direction()).normalized()};
  }
  std::uniform_real_distribution<double> uniform(-1, 1);
  grasp::Contact contact{{uniform(engine), uniform(engine), uniform(engine)}, {0, 0, 0}};
  const int axis = std::uniform_int_distribution<int>(0, 2)(engine);
  const double side = uniform(engine) < 0 ? -1 : 1;
  contact.p[axis] = side;
  contact.n[axis] = -side;
  return contact;
}

/// Return force-closure grasps, half on a sphere with normals up to 17° off, half on a box.
std::vector<grasp::Grasp> RandomGraspsHeld(int count) {
  std::mt19937_64 engine(2026);
  std::vector<grasp::Grasp> held;
  while (static_cast<int>(held.size()) < count) {
    grasp::Grasp grasp;
    for (int i = 0; i < kContacts; ++i) {
      grasp.push_back(RandomContact(engine, held.size() % 2 == 0));
    }
    if (grasp::IsForceClosure(grasp, kFrame, kFrictionAngle)) held.push_back(grasp);
  }
  return held;
}

/// Return contacts at the points, with normals towards the origin.
grasp::Grasp Towards(const std::vector<Eigen::Vector3d>& points) {
  grasp::Grasp grasp;
  for (const Eigen::Vector3d& p : points) grasp.push_back({p.normalized(), -p.normalized()});
  return grasp;
}

double QualityOfPyramids(const grasp::Grasp& grasp, int sides) {
  Eigen::MatrixXd wrenches(6, 1 + sides * static_cast<int>(grasp.size()));
  wrenches.col(0).setZero();
  int column = 1;
  for (const grasp::Contact& contact : grasp) {
    const Eigen::Vector3d first = contact.n.unitOrthogonal();
    const Eigen::Vector3d second = contact.n.cross(first);
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * std::numbers::pi * side / sides;
      const Eigen::Vector3d force =
          contact.n +
          std::tan(kFrictionAngle) * (std::cos(angle) * first + std::sin(angle) * second);
      wrenches.col(column++) << force, contact.p.cross(force);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const grasp::HullFacet& facet : grasp::ComputeConvexHull(wrenches).facets) {
    least = std::min(least, facet.offset);
  }
  return std::max(least, 0.0);
}

double Quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

/// Processor time and error of a method over grasps whose quality is known to 0.1 %.
struct Method {
  std::string name;
  std::function<double(const grasp::Grasp&)> quality;
  std::size_t most;  ///< maximum number of grasps
};

void Compare(const char* title, const std::vector<grasp::Grasp>& grasps,
             const std::vector<Method>& methods) {
  std::vector<double> known;
  for (const grasp::Grasp& grasp : grasps) {
    known.push_back(grasp::BoundQuality(grasp, kFrame, kFrictionAngle, 1e-3).lower);
  }
  std::printf("%s, %zu grasps\n%-36s %10s %10s %10s %12s %12s\n", title, grasps.size(), "",
              "median us", "90 % us", "most us", "error, med.", "error, most");
  for (const Method& method : methods) {
    std::vector<double> times, errors;
    for (std::size_t i = 0; i < std::min(grasps.size(), method.most); ++i) {
      // untimed first call, to warm up caches and memory
      double quality = method.quality(grasps[i]);
      const double start = ProcessorSeconds();
      quality = method.quality(grasps[i]);
      times.push_back(1e6 * (ProcessorSeconds() - start));
      errors.push_back(1 - quality / known[i]);
    }
    std::printf("%-36s %10.1f %10.1f %10.1f %11.2f%% %11.2f%%\n", method.name.c_str(),
                Quantile(times, 0.5), Quantile(times, 0.9), Quantile(times, 1),
                100 * Quantile(errors, 0.5), 100 * Quantile(errors, 1));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
  if (count < 2) {
    std::fprintf(stderr, "quality_bench: error: GRASPS must be 2 or more, found %s\n", argv[1]);
    return 2;
  }
  const auto bounds = [](double gap) {
    return [gap](const grasp::Grasp& grasp) {
      return grasp::BoundQuality(grasp, kFrame, kFrictionAngle, gap).lower;
    };
  };
  const std::vector<Method> methods = {
      {"BoundQuality, 1 %", bounds(0.01), std::numeric_limits<std::size_t>::max()},
      {"BoundQuality, 0.1 %", bounds(0.001), std::numeric_limits<std::size_t>::max()},
      {"ComputeQuality, 1 % (Qhull, rounds)",
       [](const grasp::Grasp& grasp) {
         return grasp::ComputeQuality(grasp, kFrame, kFrictionAngle).lower;
       },
       kMostForPyramids},
      {"Qhull, 8 sides", [](const grasp::Grasp& grasp) { return QualityOfPyramids(grasp, 8); },
       kMostForPyramids},
      {"Qhull, 16 sides", [](const grasp::Grasp& grasp) { return QualityOfPyramids(grasp, 16); },
       kMostForPyramids}};
  Compare("random", RandomGraspsHeld(count), methods);
  Compare("square", {Towards({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}})}, methods);
  Compare("tetrahedron", {Towards({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}})}, methods);
  return 0;
}
