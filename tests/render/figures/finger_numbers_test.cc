#include <gtest/gtest.h>

#include "render/figures/figure_page.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {
namespace finger_numbers_test {

using Eigen::Vector2d;

/// Return the positions of the numbers of fingers on a vertical edge at distances of `gap` points.
std::vector<Vector2d> NumbersOf(int count, double gap) {
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext context(cairo_create(surface.get()));
  std::vector<std::string> names;
  std::vector<LabelAnchor> anchors;
  std::vector<Obstacle> obstacles;
  for (int i = 0; i < count; ++i) {
    const Vector2d contact(120, 100 + gap * i);
    names.push_back(std::to_string(i));
    anchors.push_back({contact, {1, 0}});
    obstacles.push_back({contact, contact, 2.7, 2});
  }
  return DrawNumbers(context.get(), names, anchors, obstacles, {240, 200});
}

double LeastDistance(const std::vector<Vector2d>& points) {
  double least = 1e9;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (points[i] - points[j]).norm());
  }
  return least;
}

TEST(FingerNumbers, OfContactsATenthOfAMillimetreApartDoNotOverlap) {
  // An object of 100 mm in a column of 85 mm.
  const double gap = 0.1 / 100 * kColumnWidth;
  for (const int count : {2, 3, 4}) {
    const auto centres = NumbersOf(count, gap);
    ASSERT_EQ(std::ssize(centres), count);
    EXPECT_GE(LeastDistance(centres), 2 * kNumberRadius) << count;
    for (const Vector2d& centre : centres) EXPECT_LT((centre - Vector2d(120, 100)).norm(), 60);
  }
  // Negative control: next to their contacts the numbers would overlap.
  EXPECT_LT(gap, kNumberRadius / 10);
}

}  // namespace finger_numbers_test
}  // namespace regrasp::render
