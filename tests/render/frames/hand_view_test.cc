#include "render/frames/hand_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/frames/frame.h"
#include "render/picture/image.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace hand_view_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kFinger = 2;

/// Return a palm below a cube of 2 m, and a finger at +x with a fingertip sphere of 0.3 m.
HandView Hand() {
  return {{{FingerIndex(), 0}, false, MakeCapsule({-1, 0, 0}, {1, 0, 0}, 0.4)},
          {{FingerIndex(kFinger), 1}, false, MakeCapsule({0, 0, -1}, {0, 0, 0}, 0.2)},
          {{FingerIndex(kFinger), 1}, true, MakeCapsule({0, 0, 0}, {0, 0, 0}, 0.3)}};
}

plan::Snapshot Holding(const Vector3d& palm = {0, 0, -3}) {
  plan::Snapshot snapshot;
  snapshot.fingers = {MakeFinger(kFinger, plan::FingerRole::kHolding, {1, 0, 0}, {-1, 0, 0}),
                      MakeFinger(0, plan::FingerRole::kHolding, {-1, 0, 0}, {1, 0, 0})};
  snapshot.X_WP = Isometry3d(Eigen::Translation3d(palm));
  snapshot.links_W = {*snapshot.X_WP, Isometry3d(Eigen::Translation3d(1.3, 0, 0)),
                      Isometry3d(Eigen::Translation3d(1.3, 0, 0))};
  return snapshot;
}

NormalizedFrame Frame() { return {MakeCube().diameter(), Vector3d::Zero()}; }

std::vector<Color> ColorsOf(const plan::Snapshot& snapshot,
                            const std::vector<plan::HandLink>& at_fault = {}) {
  std::vector<Color> colors;
  const std::vector<Shape> shapes = HandFigure(Hand(), Frame()).Shapes(snapshot, at_fault, 0);
  for (const Shape& shape : shapes) colors.push_back(shape.color);
  return colors;
}

bool IsReddish(Color c) { return c.r > 120 && c.g < 0.6 * c.r && c.b < 0.65 * c.r; }
bool IsGrey(Color c) { return std::abs(c.r - c.b) < 30 && std::abs(c.r - c.g) < 30; }

/// Return a cube of edge 2 in which each face has its own normals.
ShadedMesh FlatCube() {
  ShadedMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      const Vector3d n = sign * Vector3d::Unit(axis), u = Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = n.cross(u);
      mesh.AddFlat(n - u - v, n + u - v, n + u + v);
      mesh.AddFlat(n - u - v, n + u + v, n - u + v);
    }
  }
  return mesh;
}

TEST(MakeHandMeshes, OffsetSurfacesHaveNoGapsAtCreases) {
  // Links after joints are offset, and shells are larger than their links.
  const HandView hand = {{{FingerIndex(0), 3}, false, FlatCube()}};
  double before = 0;
  for (const ShadedMesh& mesh :
       MakeHandMeshes({{{FingerIndex(0), 0}, false, FlatCube()}}, Frame())) {
    before = mesh.triangles[0][0].norm();  // that of the link, which is not offset
  }
  for (const ShadedMesh& mesh : MakeHandMeshes(hand, Frame())) {
    std::vector<Vector3d> corners;
    for (const auto& triangle : mesh.triangles) {
      for (const Vector3d& p : triangle) {
        const auto same = [&p](const Vector3d& other) { return (p - other).norm() < 1e-9; };
        if (std::ranges::none_of(corners, same)) corners.push_back(p);
        EXPECT_GT(p.norm(), before + 1e-3);
      }
    }
    EXPECT_EQ(corners.size(), 8U);
  }
}

TEST(HandFigure, AFingertipInContactHasTheColourOfItsFinger) {
  const std::vector<Color> colors = ColorsOf(Holding());
  ASSERT_EQ(colors.size(), 3u);
  EXPECT_TRUE(IsGrey(colors[0]) && IsGrey(colors[1]));
  EXPECT_FALSE(IsGrey(colors[2]));
  plan::Snapshot gone = Holding();
  gone.fingers.front().role = plan::FingerRole::kReleased;
  EXPECT_TRUE(IsGrey(ColorsOf(gone)[2]));
}

TEST(HandFigure, OnlyRimsOfFingertipsInContactShineThroughTheObject) {
  const auto rims = [](const plan::Snapshot& snapshot, bool in_contact) {
    std::vector<int> meshes;
    for (const Shape& shape : HandFigure(Hand(), Frame()).Rims(snapshot, in_contact, 0)) {
      meshes.push_back(std::get<MeshInstance>(shape.form).mesh);
    }
    return meshes;
  };
  EXPECT_EQ(rims(Holding(), true), std::vector{4});
  EXPECT_EQ(rims(Holding(), false), (std::vector{0, 2}));
  plan::Snapshot gone = Holding();
  gone.fingers.front().role = plan::FingerRole::kReleased;
  EXPECT_TRUE(rims(gone, true).empty());
  EXPECT_EQ(rims(gone, false).size(), 3U);
}

TEST(HandFigure, LinksAtFaultAreRedAndNoOthers) {
  const auto red = [](const std::vector<plan::HandLink>& at_fault) {
    std::vector<bool> is_red;
    for (const Color color : ColorsOf(Holding(), at_fault)) is_red.push_back(IsReddish(color));
    return is_red;
  };
  EXPECT_EQ(red({}), (std::vector{false, false, false}));
  EXPECT_EQ(red({{FingerIndex(kFinger), 1}}), (std::vector{false, true, true}));
  EXPECT_EQ(red({{FingerIndex(), 0}}), (std::vector{true, false, false}));
}

TEST(HandFigure, InvertedMeshesAreFlipped) {
  HandView hand = Hand();
  for (HandLinkView& link : hand) link.mesh = TurnInsideOut(link.mesh);
  const std::vector<ShadedMesh> turned = MakeHandMeshes(hand, Frame());
  const std::vector<ShadedMesh> standard = MakeHandMeshes(Hand(), Frame());
  ASSERT_EQ(turned.size(), 6u);
  for (int i : {1, 3, 5}) {
    EXPECT_GT(Volume(turned[i]), 0);
    EXPECT_NEAR(Volume(turned[i]), Volume(standard[i]), 1e-12);
    EXPECT_LT(Volume(turned[i - 1]), -Volume(standard[i])) << "a larger shell";
  }
}

std::vector<Window> WindowsFrom(const Vector3d& back) {
  const plan::Snapshot snapshot = Holding();
  Camera camera;
  camera.axes = CameraAxes(back);
  camera.position = 10 * camera.axes.col(2);
  camera.projection = Projection::kOrthographic;
  camera.width = camera.height = 100;
  const NormalizedFrame frame = Frame();
  const std::vector<FingerGlyph> fingers = MakeFingerGlyphs(snapshot, frame, RayTree());
  return HandFigure(Hand(), frame).Windows(snapshot, fingers, camera);
}

TEST(HandFigure, AHandHasWindowsExactlyForHiddenContacts) {
  // Seen from +x, the fingertip hides its contact and everything behind it. Seen from −x, it does
  // not hide finger 0, which has no links, and its own contact is visible through the object.
  const std::vector<Window> before = WindowsFrom(Vector3d::UnitX());
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0].strength, 1);
  for (const Window& window : WindowsFrom(-Vector3d::UnitX())) EXPECT_LT(window.strength, 1);
  const std::vector<Window> above = WindowsFrom(Vector3d::UnitY());
  for (const Window& window : above) EXPECT_LT(window.strength, 1);
}

TEST(HandFrames, AllFramesShareTheViewpointAndTheScale) {
  const object::Polyhedron cube = MakeCube();
  std::vector<plan::Snapshot> snapshots = {Holding(), Holding()};
  // The other finger is hidden: without a hand this frame would have its own view.
  for (int i = 0; i < 6; ++i) {
    snapshots[1].fingers.push_back(
        MakeFinger(3 + i, plan::FingerRole::kHolding, {1, 0.01 * i, 0}, {-1, 0, 0}));
  }
  const auto make = [&](HandView hand) {
    FrameOptions options{320, 240, 1};
    options.hand = hand.empty() ? nullptr : std::make_shared<const HandView>(std::move(hand));
    return FrameRenderer(cube, 1, 0.3, snapshots, options);
  };
  FrameRenderer renderer = make(Hand());
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(renderer.HasOwnView(i));
  // The image contains the whole hand.
  EXPECT_NE(renderer.Render(snapshots[0]).rgb, make({}).Render(snapshots[0]).rgb);
}

/// A link inside the object shows at most as faint lines, and the object keeps its colours.
TEST(HandFrames, TheObjectIsOpaque) {
  plan::Snapshot snapshot = Holding({0, 0, 0});
  snapshot.links_W = {*snapshot.X_WP};
  const auto draw = [&](double radius) {
    FrameOptions options{320, 240, 1};
    options.hand = std::make_shared<const HandView>(
        HandView{{{FingerIndex(), 0}, false, MakeCapsule({0, 0, 0}, {0, 0, 0}, radius)}});
    return FrameRenderer(MakeCube(), 1, 0.3, {snapshot}, options).Render(snapshot);
  };
  const Image large = draw(0.9);
  const Image small = draw(0.01);
  ASSERT_EQ(large.rgb.size(), small.rgb.size());
  constexpr int kFaint = 64;
  int colored = 0;
  int different = 0;
  for (std::size_t i = 0; i < large.rgb.size(); i += 3) {
    const auto [least, most] = std::minmax({large.rgb[i], large.rgb[i + 1], large.rgb[i + 2]});
    if (least > 90 && most - least > 12) ++colored;
    for (std::size_t k = i; k < i + 3; ++k) {
      if (std::abs(large.rgb[k] - small.rgb[k]) > kFaint) ++different;
    }
  }
  const int pixels = large.width * large.height;
  EXPECT_GT(colored, pixels / 10);
  EXPECT_LT(different, pixels / 200);
}

TEST(HandFrames, AnInHandMotionShowsTheFormerPose) {
  const object::Polyhedron cube = MakeCube();
  std::vector<plan::Snapshot> snapshots = {Holding(), Holding()};
  snapshots[1].X_WO_before = Isometry3d(Eigen::AngleAxisd(0.6, Vector3d::UnitZ()));
  FrameOptions options{320, 240, 1};
  options.hand = std::make_shared<const HandView>(Hand());
  FrameRenderer renderer(cube, 1, 0.3, snapshots, options);
  const Image still = renderer.Render(snapshots[0]);
  const Image moved = renderer.Render(snapshots[1]);
  EXPECT_NE(still.rgb, moved.rgb);
  // If a fault has its own ghost, this one is omitted.
  FaultMarks marks{.heading = "", .fingers = {}};
  marks.X_WO_before = Isometry3d::Identity();
  EXPECT_EQ(renderer.Render(snapshots[0], {}, &marks).rgb,
            renderer.Render(snapshots[1], {}, &marks).rgb);
}

}  // namespace hand_view_test
}  // namespace regrasp::render
