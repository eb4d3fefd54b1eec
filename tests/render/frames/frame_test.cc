#include "render/frames/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/polygon_soup.h"
#include "render/frames/fault_marks.h"
#include "render/picture/image.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace frame_test {

const double kFrictionAngle = Radians(20);

FrameOptions Small(int supersampling = 1) { return {320, 240, supersampling}; }
/// Return options for frames that are large enough for text.
FrameOptions Medium() { return {640, 480, 1}; }

Image Draw(const object::Object& object, const std::vector<plan::Snapshot>& snapshots,
           std::size_t index, const FrameOptions& options, const std::string& caption = "") {
  FrameRenderer renderer(object, 1, kFrictionAngle, snapshots, options);
  return renderer.Render(snapshots[index], {caption});
}

Color PixelAt(const Image& image, int x, int y) {
  const unsigned char* p = image.rgb.data() + 3 * (std::size_t(y) * image.width + x);
  return {p[0], p[1], p[2]};
}

bool IsWhite(Color c) { return c.r == 255 && c.g == 255 && c.b == 255; }

/// Count the pixels with the hue and about the saturation of `color`, lit or in shade.
int CountHue(const Image& image, Color color) {
  const auto normalised = [](Color c) {
    const double sum = c.r + c.g + c.b + 1e-9;
    return Eigen::Vector3d(c.r / sum, c.g / sum, c.b / sum);
  };
  constexpr double kClose = 0.05;
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Color c = PixelAt(image, x, y);
      count += (normalised(c) - normalised(color)).norm() < kClose ? 1 : 0;
    }
  }
  return count;
}

int CountDifferent(const Image& a, const Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) count += a.rgb[i] != b.rgb[i] ? 1 : 0;
  return count;
}

TEST(FrameTest, HasTheRequestedSize) {
  const object::Polyhedron cube = MakeCube(0.03);
  int checked = 0;
  for (const auto& [width, height] : {std::pair(64, 48), std::pair(48, 200), std::pair(801, 333)}) {
    const Image image = Draw(cube, MakeCubeSequence(), 0, {width, height, 2});
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.rgb.size(), std::size_t{3} * width * height);
    EXPECT_TRUE(IsWhite(PixelAt(image, 0, 0)));
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

TEST(FrameTest, DrawsTheLargestSizeInBandsWithoutSeams) {
  const object::Polyhedron cube = MakeCube(0.03);
  const Image image = Draw(cube, MakeCubeSequence(), 0, {4096, 4096, 2});
  EXPECT_EQ(image.width, 4096);
  EXPECT_TRUE(IsWhite(PixelAt(image, 4095, 4095)));
  // Bands that do not fit together would have no body at the centre or in a corner.
  const Image small = Draw(cube, MakeCubeSequence(), 0, {512, 512, 2});
  const Image shrunk = Shrink(image, 8);
  long difference = 0;
  for (std::size_t i = 0; i < small.rgb.size(); ++i) {
    difference += std::abs(int{small.rgb[i]} - int{shrunk.rgb[i]});
  }
  constexpr double kMeanDifference = 1.5;  // of 255: antialiasing differs along edges
  EXPECT_LT(static_cast<double>(difference) / small.rgb.size(), kMeanDifference);
}

/// Return a coarse and noisy sphere, like a scan, with a diameter of about 0.1 m.
object::Polyhedron MakeNoisySphere() {
  constexpr int kRings = 11, kSides = 24;
  object::PolygonSoup soup;
  const auto radius = [](int i) { return 0.05 * (1 + 0.012 * std::sin(12.9898 * i * i)); };
  for (int ring = 1; ring <= kRings; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      const double tilt = M_PI * ring / (kRings + 1), turn = 2 * M_PI * side / kSides;
      soup.vertices.push_back(radius(ring * kSides + side) *
                              Eigen::Vector3d(std::sin(tilt) * std::cos(turn),
                                              std::sin(tilt) * std::sin(turn), std::cos(tilt)));
    }
  }
  const int top = static_cast<int>(soup.vertices.size()), bottom = top + 1;
  soup.vertices.emplace_back(0, 0, 0.05);
  soup.vertices.emplace_back(0, 0, -0.05);
  for (int side = 0; side < kSides; ++side) {
    const int next = (side + 1) % kSides, last = (kRings - 1) * kSides;
    soup.facets.push_back({top, side, next});
    soup.facets.push_back({bottom, last + next, last + side});
    for (int ring = 0; ring + 1 < kRings; ++ring) {
      const int a = ring * kSides + side, b = ring * kSides + next;
      soup.facets.push_back({a, a + kSides, b});
      soup.facets.push_back({b, a + kSides, b + kSides});
    }
  }
  return object::Polyhedron::FromSoup(soup, "sphere");
}

TEST(FrameTest, AScanHasAnOutlineAndNoScratches) {
  const object::Polyhedron sphere = MakeNoisySphere();
  FrameOptions options{480, 480, 1};
  options.view.direction = ViewDirection{0, 0};
  const Image image = Draw(sphere, {{}}, 0, options);
  // Ink inside the outline: edges of the mesh of which one side faces the eye.
  double x_sum = 0, y_sum = 0;
  int body = 0;
  const auto is_dark = [](Color c) { return c.g < 90; };
  const auto is_body = [&](Color c) { return !IsWhite(c) && !is_dark(c); };
  constexpr int kAboveTexts = 400;
  for (int y = 0; y < kAboveTexts; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!is_body(PixelAt(image, x, y))) continue;
      x_sum += x;
      y_sum += y;
      ++body;
    }
  }
  const double radius = std::sqrt(body / M_PI);
  int rim = 0, scratches = 0;
  for (int y = 0; y < kAboveTexts; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!is_dark(PixelAt(image, x, y))) continue;
      const double away = std::hypot(x - x_sum / body, y - y_sum / body);
      ++(away < 0.93 * radius ? scratches : rim);
    }
  }
  EXPECT_GT(body, 10'000);
  EXPECT_GT(rim, 2 * radius);
  EXPECT_LT(scratches, 5);
}

/// A box ten times as long as wide, along x, with fingers at its ends.
struct LongScene {
  object::Polyhedron box = MakeBox({0.3, 0.03, 0.03});
  std::vector<plan::Snapshot> snapshots = {{}};
};

FrameOptions Cropped() {
  FrameOptions options = Medium();
  options.crop = true;
  options.view.direction = ViewDirection{0, 0};
  return options;
}

TEST(FrameTest, CroppedFramesShowTheSameWithoutTheWhiteAroundIt) {
  const LongScene scene;
  FrameOptions options = Cropped();
  options.view.direction = ViewDirection{Radians(-90), 0};  // along the side of the box
  FrameRenderer renderer(scene.box, 1, kFrictionAngle, scene.snapshots, options);
  const Image cropped = renderer.Render(scene.snapshots[0]);
  EXPECT_EQ(cropped.width, renderer.width());
  EXPECT_EQ(cropped.height, renderer.height());
  EXPECT_EQ(cropped.width, 640);
  EXPECT_LT(cropped.height, 480 / 2);
  EXPECT_EQ(cropped.height % 2, 0);
  options.crop = false;
  const Image whole = Draw(scene.box, scene.snapshots, 0, options);
  const int off = (480 - cropped.height) / 2;
  int ink = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const bool inside = y >= off && y < off + cropped.height;
      // Text is at the border.
      if (y >= 480 - 100) continue;
      const Color expected = PixelAt(whole, x, y);
      ink += !IsWhite(expected);
      if (!inside) {
        EXPECT_TRUE(IsWhite(expected)) << x << " " << y;
      }
    }
  }
  EXPECT_GT(ink, 1000);
}

TEST(FrameTest, AFullFrameIsNotCropped) {
  const object::Polyhedron cube = MakeCube(0.03);
  FrameRenderer renderer(cube, 1, kFrictionAngle, MakeCubeSequence(), Cropped());
  EXPECT_EQ(renderer.height(), 480);
  EXPECT_GE(renderer.width(), 480);
}

TEST(FrameTest, OnADarkGroundThereIsNoWhiteAndTextIsLight) {
  const object::Polyhedron cube = MakeCube(0.03);
  FrameOptions options = Medium();
  options.background = Background::kDark;
  const Image dark = Draw(cube, MakeCubeSequence(), 1, options, "caption");
  const Color paper = kDarkGround.paper;
  for (const int x : {0, 639}) {
    EXPECT_EQ(PixelAt(dark, x, 0).r, paper.r);
    EXPECT_EQ(PixelAt(dark, x, 0).b, paper.b);
  }
  int light = 0;
  for (int x = 10; x < 200; ++x) {
    for (int y = 440; y < 475; ++y) light += PixelAt(dark, x, y).g > 150;
  }
  EXPECT_GT(light, 20);
}

TEST(FrameTest, ATransparentFrameEqualsTheWhiteOneOnWhite) {
  const object::Polyhedron cube = MakeCube(0.03);
  FrameOptions options = Medium();
  const Image white = Draw(cube, MakeCubeSequence(), 1, options, "caption");
  EXPECT_TRUE(white.alpha.empty());
  options.background = Background::kTransparent;
  const Image clear = Draw(cube, MakeCubeSequence(), 1, options, "caption");
  EXPECT_EQ(clear.rgb, white.rgb);
  ASSERT_EQ(clear.alpha.size(), std::size_t{640} * 480);
  EXPECT_EQ(clear.alpha[0], 0);
  EXPECT_EQ(std::ranges::count_if(clear.alpha, [](int a) { return a == 0; }) > 640 * 480 / 3, true);
  // An opaque object hides the background, a glass one does not.
  const auto half = [](const Image& image) {
    return std::ranges::count_if(image.alpha, [](int a) { return a > 60 && a < 200; });
  };
  EXPECT_GT(std::ranges::count(clear.alpha, 255), 20000);
  EXPECT_LT(half(clear), 5000);
  options.glass = true;
  EXPECT_GT(half(Draw(cube, MakeCubeSequence(), 1, options, "caption")), 20000);
}

TEST(FrameTest, RejectsSizesOutOfRange) {
  const object::Polyhedron cube = MakeCube(0.03);
  EXPECT_THROW(Draw(cube, MakeCubeSequence(), 0, {47, 480, 1}), std::invalid_argument);
  EXPECT_THROW(Draw(cube, MakeCubeSequence(), 0, {640, 4097, 1}), std::invalid_argument);
  EXPECT_THROW(Draw(cube, MakeCubeSequence(), 0, {640, 480, 0}), std::invalid_argument);
}

TEST(FrameTest, HasAWhiteBackgroundAtTheCorners) {
  const Image image = Draw(MakeCube(0.03), MakeCubeSequence(), 1, Small());
  for (const int x : {0, 319}) {
    for (const int y : {0, 239}) EXPECT_TRUE(IsWhite(PixelAt(image, x, y))) << x << " " << y;
  }
}

TEST(FrameTest, ShowsEveryHoldingFingerInItsColourAndNoFreeFinger) {
  const object::Polyhedron cube = MakeCube(0.03);
  std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  const Image all = Draw(cube, snapshots, 0, Medium());
  for (int free = 0; free < 4; ++free) {
    plan::Snapshot without = snapshots[0];
    without.fingers[free].role = plan::FingerRole::kFree;
    FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, Medium());
    const Color color = FingerColor(snapshots[0].fingers[free].finger);
    // Fingers behind the object are paler, but their numbers are not.
    constexpr int kClearlyThere = 20;  // pixels
    EXPECT_GT(CountHue(all, color), CountHue(renderer.Render(without), color) + kClearlyThere)
        << "finger " << free;
  }
}

TEST(FrameTest, GivesTheSameBytesTwice) {
  const object::Polyhedron block = MakeHoledBlock();
  const Image first = Draw(block, MakeHoledBlockSequence(), 0, Small(2), "caption");
  const Image second = Draw(block, MakeHoledBlockSequence(), 0, Small(2), "caption");
  EXPECT_EQ(first.rgb, second.rgb);
}

TEST(FrameTest, ACopyDrawsTheSameWithTheSameCamera) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, Small(2));
  FrameRenderer copy(renderer);
  for (const plan::Snapshot& snapshot : snapshots) {
    EXPECT_EQ(CountDifferent(copy.Render(snapshot, {"a"}), renderer.Render(snapshot, {"a"})), 0);
  }
}

TEST(FrameTest, FreeFingersOfAnAnimationDoNotChangeTheCamera) {
  const object::Polyhedron cube = MakeCube(0.03);
  std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  const auto different = [&] {
    FrameOptions animated = Medium();
    animated.animated = true;
    return CountDifferent(Draw(cube, snapshots, 0, Medium()), Draw(cube, snapshots, 0, animated));
  };
  EXPECT_EQ(different(), 0);
  plan::FingerState finger = snapshots[0].fingers[0];
  finger.finger = FingerIndex(6);
  finger.role = plan::FingerRole::kFree;
  finger.contact_W -= 0.01 * finger.normal_W;
  snapshots[0].fingers.push_back(finger);
  const int bytes = 3 * Medium().width * Medium().height;
  EXPECT_GT(different(), 100);
  EXPECT_LT(different(), bytes / 20);
}

TEST(FrameTest, ChangesWithTheObjectPoseAndTheRoleOfAFinger) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, Small());
  const Image still = renderer.Render(snapshots[1]);
  EXPECT_EQ(CountDifferent(still, renderer.Render(snapshots[1])), 0);
  plan::Snapshot turned = snapshots[1];
  turned.X_WO.rotate(Eigen::AngleAxisd(Radians(5), Eigen::Vector3d::UnitZ()));
  EXPECT_GT(CountDifferent(still, renderer.Render(turned)), 500);
  plan::Snapshot held = snapshots[1];
  for (plan::FingerState& finger : held.fingers) finger.role = plan::FingerRole::kHolding;
  EXPECT_GT(CountDifferent(still, renderer.Render(held)), 100);
}

TEST(FrameTest, WritesTheProgressAtTheTopRight) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, Medium());
  const Image without = renderer.Render(snapshots[0]);
  const Image with = renderer.Render(snapshots[0], {"", "36.7° of 90°"});
  int inside = 0, outside = 0;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      const bool differs = PixelAt(with, x, y).g != PixelAt(without, x, y).g;
      (x > with.width / 2 && y < with.height / 8 ? inside : outside) += differs ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_EQ(outside, 0);
}

TEST(FrameTest, ALengthTowardsTheEyeGetsItsOwnView) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = {MakeCubeSequence()[0], MakeCubeSequence()[0]};
  int with_own_view = 0;
  for (int axis = 0; axis < 12; ++axis) {
    const double turn = axis * M_PI / 6;
    FrameOptions options = Small();
    options.shown_lengths = {{std::cos(turn), std::sin(turn), 0}};
    const FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, options);
    EXPECT_FALSE(renderer.HasOwnView(0));
    with_own_view += renderer.HasOwnView(1) ? 1 : 0;
    options.view.direction = ViewDirection{0, 0};
    const FrameRenderer given(cube, 1, kFrictionAngle, snapshots, options);
    EXPECT_FALSE(given.HasOwnView(1));
  }
  EXPECT_GE(with_own_view, 2);
  EXPECT_LE(with_own_view, 6);
}

TEST(FrameTest, FingersHaveTheirNamesIfTheyHaveSome) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameOptions named = Medium();
  named.finger_names = {"", "index"};
  const Image image = Draw(cube, snapshots, 0, named);
  const Image numbers = Draw(cube, snapshots, 0, Medium());
  EXPECT_GT(CountDifferent(image, numbers), 100);
  named.finger_names[1] = "a_name_that_is_too_long";
  EXPECT_EQ(CountDifferent(Draw(cube, snapshots, 0, named), numbers), 0);
}

TEST(FrameTest, WritesTheCaptionAtTheBottomLeft) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, Medium());
  const Image without = renderer.Render(snapshots[0]);
  const Image with = renderer.Render(snapshots[0], {"step 1/2"});
  int left = 0;
  int elsewhere = 0;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      const bool same = IsWhite(PixelAt(with, x, y)) == IsWhite(PixelAt(without, x, y));
      const bool in_corner = x < with.width / 2 && y > with.height * 3 / 4;
      (in_corner ? left : elsewhere) += same ? 0 : 1;
    }
  }
  EXPECT_GT(left, 50);
  EXPECT_EQ(elsewhere, 0);
}

TEST(FrameTest, IsIndependentOfTheObjectsSize) {
  // The same scene in metres and, scaled, in millimetres gives the same image, with the same scale
  // bar.
  const object::Polyhedron cube = MakeCube(0.03);
  object::PolygonSoup soup;
  for (const Eigen::Vector3d& p : cube.vertices()) soup.vertices.push_back(1024 * p);
  for (const auto& t : cube.triangles()) soup.facets.push_back({t[0], t[1], t[2]});
  const object::Polyhedron large = object::Polyhedron::FromSoup(soup, "large cube");
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameRenderer a(cube, 1, kFrictionAngle, snapshots, Small());
  FrameRenderer b(large, 1.0 / 1024, kFrictionAngle, snapshots, Small());
  const int bytes = 3 * 320 * 240;
  EXPECT_LT(CountDifferent(a.Render(snapshots[0]), b.Render(snapshots[0])), bytes / 100);
}

TEST(FrameTest, DrawsFingersThatFarAwayObjectsLeftBehind) {
  // After a failed step the object can be outside the image.
  const object::Polyhedron cube = MakeCube(0.03);
  std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  snapshots.back().X_WO.translation() = Eigen::Vector3d(0, 0, -50);
  const Image image = Draw(cube, snapshots, 2, Small());
  EXPECT_GT(CountHue(image, FingerColor(FingerIndex(3))), 20);
}

object::Polygon MakePolygon() {
  return object::Polygon::FromWkt(
      "POLYGON((0 0, 0.06 0, 0.06 0.04, 0 0.04, 0 0), "
      "(0.02 0.015, 0.03 0.015, 0.03 0.025, 0.02 0.015))",
      "polygon");
}

/// Return a snapshot with one finger at the left and one at the bottom.
plan::Snapshot MakePlanarSnapshot() {
  plan::Snapshot snapshot;
  snapshot.fingertip_radius_m = 0.002;
  snapshot.fingers = {
      MakeFinger(0, plan::FingerRole::kHolding, {0.0, 0.02, 0}, Eigen::Vector3d::UnitX()),
      MakeFinger(1, plan::FingerRole::kHolding, {0.04, 0.0, 0}, Eigen::Vector3d::UnitY())};
  return snapshot;
}

TEST(FrameTest, DrawsPolygonsAsPrismsOfTheRequestedThickness) {
  const object::Polygon polygon = MakePolygon();
  FrameOptions thin = Small(), thick = Small();
  thin.body.thickness = 0.02;
  thick.body.thickness = 0.25;
  const ViewDirection tilted = {Radians(270), Radians(60)};
  thin.view.direction = thick.view.direction = tilted;
  FrameOptions standard = Small();
  standard.view.direction = tilted;
  const Image a = Draw(polygon, {MakePlanarSnapshot()}, 0, thin);
  const Image b = Draw(polygon, {MakePlanarSnapshot()}, 0, thick);
  for (const int finger : {0, 1}) EXPECT_GT(CountHue(a, FingerColor(FingerIndex(finger))), 40);
  EXPECT_GT(CountDifferent(a, b), 1000);
  EXPECT_EQ(CountDifferent(b, Draw(polygon, {MakePlanarSnapshot()}, 0, standard)), 0);
}

/// Minimum empty border of frames, pixels: less than their margins, and more than the width of a
/// mark's line.
constexpr int kFreeBorder = 5;

/// Count the non-white pixels within kFreeBorder of the border.
int CountAtBorder(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool inside = x >= kFreeBorder && y >= kFreeBorder && x < image.width - kFreeBorder &&
                          y < image.height - kFreeBorder;
      count += inside || IsWhite(PixelAt(image, x, y)) ? 0 : 1;
    }
  }
  return count;
}

TEST(FrameTest, EverythingDrawnIsInsideTheFrame) {
  const object::Polyhedron cube = MakeCube(0.03), block = MakeThinLBlock(),
                           holed = MakeHoledBlock();
  const object::Polygon polygon = MakePolygon();
  struct Scene {
    const object::Object& object;
    std::vector<plan::Snapshot> snapshots;
  };
  const std::vector<Scene> scenes = {{cube, MakeCubeSequence()},
                                     {block, MakeLBlockSequence()},
                                     {holed, MakeHoledBlockSequence()},
                                     {polygon, {MakePlanarSnapshot()}}};
  int drawn = 0, cut_off = 0;
  for (const auto& [object, snapshots] : scenes) {
    for (const auto& [width, height] : {std::pair(640, 480), std::pair(640, 240)}) {
      for (const double zoom : {1.0, 3.0}) {
        FrameOptions options = {width, height, 1};
        options.view.zoom = zoom;
        FrameRenderer renderer(object, 1, kFrictionAngle, snapshots, options);
        for (const plan::Snapshot& snapshot : snapshots) {
          const int at_border = CountAtBorder(renderer.Render(snapshot, {"caption"}));
          if (zoom == 1) {
            EXPECT_EQ(at_border, 0);
            ++drawn;
          } else {
            cut_off += at_border > 0 ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_EQ(cut_off, drawn);  // every mark is cut off if it is three times as large
}

/// Return two fingers inside a ring. From one of 36 azimuths the first finger is in front of the
/// second.
std::vector<plan::Snapshot> MakePairsInsideARing() {
  std::vector<plan::Snapshot> snapshots;
  for (const double elevation : {20, 28, 38, 48}) {
    for (int i = 0; i < 36; ++i) {
      const Eigen::Vector3d along =
          0.01 * ViewDirection{Radians(10.0 * i + 3), Radians(elevation)}.ToCamera();
      plan::Snapshot& snapshot = snapshots.emplace_back();
      for (const int finger : {0, 1}) {
        snapshot.fingers.push_back(MakeFinger(finger, plan::FingerRole::kHolding,
                                              finger == 0 ? along : -along,
                                              -Eigen::Vector3d::UnitZ()));
      }
    }
  }
  return snapshots;
}

TEST(FrameTest, AFingerHiddenInOneViewHasAnotherViewOfTheSameSize) {
  const object::Polyhedron ring = MakeHoledBlock();
  const std::vector<plan::Snapshot> snapshots = MakePairsInsideARing();
  FrameOptions options = Medium();
  options.crop = true;
  FrameRenderer renderer(ring, 1, kFrictionAngle, snapshots, options);
  int own = 0;
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!renderer.HasOwnView(index)) continue;
    const Image common = renderer.Render(snapshots[i]);
    const Image image = renderer.Render(snapshots[i], {}, nullptr, index);
    EXPECT_EQ(image.width, common.width);
    EXPECT_EQ(image.height, common.height);
    EXPECT_EQ(CountAtBorder(image), 0);
    EXPECT_GT(CountDifferent(image, common), 10000);
    ++own;
  }
  EXPECT_GT(own, 0);
  EXPECT_LT(own, 36);

  options.view.direction = ViewDirection{Radians(30), Radians(28)};
  const FrameRenderer given(ring, 1, kFrictionAngle, snapshots, options);
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    EXPECT_FALSE(given.HasOwnView(static_cast<int>(i)));
  }
}

TEST(FrameTest, AForceIsInsideTheFrameForEveryFingerDirection) {
  // The only long force of the sequence points out of the opposite side of the object.
  const object::Polyhedron plate = object::Polyhedron::FromSoup(
      Extrude({{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}, 0, 0.004), "plate");
  plan::Snapshot snapshot;
  snapshot.fingertip_radius_m = 0.002;
  snapshot.fingers = {
      MakeFinger(0, plan::FingerRole::kHolding, {0.05, 0.05, 0.004}, -Eigen::Vector3d::UnitZ()),
      MakeFinger(1, plan::FingerRole::kHolding, {0.0, 0.05, 0.002}, Eigen::Vector3d::UnitX())};
  snapshot.fingers[0].force_W *= 10;
  FrameOptions options = Medium();
  options.view.direction = ViewDirection{0, 0};
  FrameRenderer renderer(plate, 1, kFrictionAngle, {snapshot}, options);
  EXPECT_EQ(CountAtBorder(renderer.Render(snapshot)), 0);
}

TEST(FrameTest, FaultMarksAreInsideTheFrame) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FaultMarks marks;
  marks.dimensions = {{{0.03, 0, 0}, {0.09, 0, 0}, "a text that goes beyond its line"}};
  marks.places = {{{0, 0, 0.08}, -Eigen::Vector3d::UnitZ(), "was here"}};
  marks.fingertips = {{{0, -0.07, 0}, 0.01}};
  FrameOptions options = Medium();
  options.view.direction = ViewDirection{Radians(60), Radians(20)};
  const auto at_border = [&] {
    FrameRenderer renderer(cube, 1, kFrictionAngle, snapshots, options);
    return CountAtBorder(renderer.Render(snapshots[0], {}, &marks));
  };
  EXPECT_GT(at_border(), 0);
  options.also_seen = ExtentOf(marks, cube.diameter());
  EXPECT_EQ(at_border(), 0);
}

TEST(FrameTest, ShowsPlanarFrictionConesFromTheirFlatSide) {
  // A flat cone seen from its edge would not show its angle, in any direction.
  const object::Polygon polygon = MakePolygon();
  for (const int finger : {0, 1}) {
    plan::Snapshot alone = MakePlanarSnapshot();
    alone.fingers = {alone.fingers[finger]};
    const auto draw = [&](double degrees) {
      FrameRenderer renderer(polygon, 1, Radians(degrees), {alone}, Medium());
      return renderer.Render(alone);
    };
    // Bytes: 9400 for a cone seen from above, 3000 from its edge.
    constexpr int kClearlyWider = 6000;
    EXPECT_GT(CountDifferent(draw(10), draw(40)), kClearlyWider) << "finger " << finger;
  }
}

}  // namespace frame_test
}  // namespace regrasp::render
