#include "tests/render/figures/contact_space_scenes.h"

#include <algorithm>

#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

object::Polygon MakeRing(int edges) {
  return object::Polygon::FromRings({Circle(edges), Circle(edges, 0.5)}, "ring");
}

object::Polygon MakeFork() {
  return object::Polygon::FromRings(
      {{{0, 0}, {10, 0}, {10, 10}, {7, 10}, {7, 3}, {3, 3}, {3, 10}, {0, 10}}}, "fork");
}

plan::Plan MakeForkPlan() {
  const object::Polygon fork = MakeFork();
  const plan::FingerContact right = FingerAt(fork, 0, 1, 0.8);
  const plan::FingerContact left = FingerAt(fork, 1, 7, 0.2);
  const plan::FingerContact inner_right = FingerAt(fork, 2, 3, 2.0 / 7);
  const plan::FingerContact inner_left = FingerAt(fork, 1, 5, 5.0 / 7);
  return MakePlanarPlan({right, left}, {plan::Switch{{inner_right}, {FingerIndex(1)}},
                                        plan::Switch{{inner_left}, {FingerIndex(0)}}});
}

plan::Plan MakeDiscPlan(const object::Polygon& disc) {
  const int edges = disc.face_count();
  const auto at = [&](int edge, double u) {
    return plan::FingerGrasp{FingerAt(disc, 0, edge % edges, u),
                             FingerAt(disc, 1, (edge + edges / 2) % edges, u)};
  };
  return MakePlanarPlan(
      at(edges - 1, 0.5),
      {plan::Align{{at(edges - 1, 0.5), at(edges - 1, 1), at(0, 0), at(0, 0.5)}}});
}

plan::Plan MakeExchangePlan() {
  const object::Polygon square = MakeSquare();
  const auto at = [&](int finger, int edge) { return FingerAt(square, finger, edge, 0.5); };
  return MakePlanarPlan({at(0, 0), at(1, 2)},
                        {plan::Switch{{at(2, 1), at(3, 3)}, {FingerIndex(0), FingerIndex(1)}}});
}

bool Contains(const Outline& outline, const Vector2d& p, double margin) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
    if (Cross(side, p - outline[i]) <= -margin * side.norm()) return false;
  }
  return true;
}

int CountContaining(const std::vector<Outline>& outlines, const Vector2d& p) {
  return static_cast<int>(std::ranges::count_if(
      outlines, [&](const Outline& outline) { return Contains(outline, p); }));
}

double AreaOf(const std::vector<Outline>& outlines) {
  double area = 0;
  for (const Outline& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      area += Cross(outline[i], outline[(i + 1) % outline.size()]) / 2;
    }
  }
  return area;
}

}  // namespace regrasp::render
