#include "render/frames/canvas.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace regrasp::render {
namespace canvas_test {

using Eigen::Vector3d;

constexpr Color kRed = {200, 40, 40};
constexpr int kSide = 64;

/// Return a camera that looks down, with a length of 1 as half of the image.
Camera FromAbove() {
  Camera camera;
  camera.position = {0, 0, 10};
  camera.projection = Projection::kOrthographic;
  camera.half_height = 1;
  camera.width = camera.height = kSide;
  return camera;
}

/// Return the square [−h, h]² at height z, visible from above.
ShadedMesh Square(double h, double z) {
  ShadedMesh mesh;
  mesh.AddFlat({-h, -h, z}, {h, -h, z}, {h, h, z});
  mesh.AddFlat({-h, -h, z}, {h, h, z}, {-h, h, z});
  return mesh;
}

Image DrawOnce(const std::vector<ShadedMesh>& meshes, const Drawing& drawing,
               int supersampling = 1) {
  Canvas canvas(meshes, kSide, kSide, supersampling);
  return canvas.Draw(FromAbove(), drawing);
}

Color CentreOf(const Image& image) {
  const unsigned char* p =
      image.rgb.data() + 3 * (std::size_t(image.height / 2) * image.width + image.width / 2);
  return {p[0], p[1], p[2]};
}

int CountColored(const Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += image.rgb[i + 1] < 250 ? 1 : 0;
  return count;
}

TEST(CanvasTest, IsWhiteWhereNothingIsDrawn) {
  const Image image = DrawOnce({}, {});
  EXPECT_EQ(image.rgb, MakeImage(kSide, kSide).rgb);
}

TEST(CanvasTest, ASphereHasItsRadius) {
  Drawing drawing;
  drawing.shapes = {{Sphere{Vector3d::Zero(), 0.5}, kRed}};
  const double area = M_PI * std::pow(0.5 * kSide / 2, 2);
  EXPECT_NEAR(CountColored(DrawOnce({}, drawing)), area, 0.03 * area);
}

TEST(CanvasTest, TheUpperSideOfAnImageIsUp) {
  Drawing drawing;
  drawing.shapes = {{Sphere{Vector3d(0.5, 0.5, 0), 0.2}, kRed}};
  const Image image = DrawOnce({}, drawing);
  const auto green = [&](int x, int y) { return image.rgb[3 * (std::size_t(y) * kSide + x) + 1]; };
  EXPECT_LT(green(48, 16), 100);
  EXPECT_EQ(green(48, 48), 255);
  EXPECT_EQ(green(16, 16), 255);
}

/// Return the colour of a veil's square at a height, above or below a translucent layer at 0.5.
Color ThroughVeil(double height, std::vector<Window> windows = {}) {
  const std::vector<ShadedMesh> meshes = {Square(0.9, 0.5), Square(0.9, height)};
  Drawing drawing;
  drawing.layers = {{{{MeshInstance{0}, Color{0, 0, 255}}}, 0.5}};
  drawing.veil = Veil{{{MeshInstance{1}, Color{255, 0, 0}, 0.8}}, {}, {{0}}, std::move(windows)};
  return CentreOf(DrawOnce(meshes, drawing));
}

/// Return the colour at the centre of a blue solid at z = 0.5 and a red shape at `height`.
Color WithSolid(double height, double xray) {
  const std::vector<ShadedMesh> meshes = {Square(0.9, 0.5), Square(0.9, height)};
  Drawing drawing;
  drawing.shapes = {{MeshInstance{1}, Color{255, 0, 0}}};
  drawing.solid = Solid{{{MeshInstance{0}, Color{0, 0, 255}}}, xray};
  return CentreOf(DrawOnce(meshes, drawing));
}

TEST(CanvasTest, HiddenShapesShineThroughASolidFaintly) {
  const Color front = WithSolid(0.8, 0.25);
  EXPECT_GT(front.r, 150);
  EXPECT_EQ(front.b, 0);
  const Color behind = WithSolid(0.2, 0.25);
  EXPECT_NEAR(behind.r, 0.25 * front.r, 2);
  EXPECT_NEAR(behind.b, 0.75 * WithSolid(0.2, 0).b, 2);
  EXPECT_EQ(WithSolid(0.2, 0).r, 0) << "opaque";
}

/// Return the colour at the centre of a red veil at `height`, with a solid at z = 0.5.
Color VeilAndSolid(double height) {
  const std::vector<ShadedMesh> meshes = {Square(0.9, 0.5), Square(0.9, height)};
  Drawing drawing;
  drawing.solid = Solid{{{MeshInstance{0}, Color{0, 0, 255}}}, 0.5};
  drawing.veil = Veil{{{MeshInstance{1}, Color{255, 0, 0}, 0.8}}, {}, {}, {}};
  return CentreOf(DrawOnce(meshes, drawing));
}

TEST(CanvasTest, ASolidHidesAVeilButItsXrayRims) {
  const Color over = VeilAndSolid(0.8);
  EXPECT_GT(over.r, 150);
  EXPECT_GT(over.b, 20);
  const Color under = VeilAndSolid(0.2);
  EXPECT_EQ(under.r, 0);
  const std::vector<ShadedMesh> meshes = {Square(0.9, 0.5), Square(0.4, 0.1), Square(0.9, 0)};
  Drawing drawing;
  drawing.solid = Solid{{{MeshInstance{0}, Color{0, 0, 255}}}, 0.5};
  const std::vector<Shape> link = {{MeshInstance{1}, Color{255, 0, 0}, 0.8}};
  const std::vector<Shape> shell = {{MeshInstance{2}, Color{0, 255, 0}, 0.8}};
  const auto green_at_rim = [](const Image& image) {
    return image.rgb[3 * (std::size_t{kSide / 2} * kSide + 8) + 1];
  };
  drawing.veil = Veil{link, {}, {}, {}, shell};
  const Image xray = DrawOnce(meshes, drawing);
  EXPECT_EQ(CentreOf(xray).g, 0) << "behind the veil";
  EXPECT_GT(green_at_rim(xray), 30);
  drawing.veil = Veil{link, shell};
  EXPECT_EQ(green_at_rim(DrawOnce(meshes, drawing)), 0);
}

TEST(CanvasTest, AMeshCanHaveItsOwnColours) {
  ShadedMesh square = Square(0.9, 0.5);
  const Color green = {0, 255, 0};
  square.colors.assign(square.triangles.size(), {green, green, green});
  Drawing drawing;
  drawing.shapes = {{MeshInstance{0}, kRed}};
  const Color centre = CentreOf(DrawOnce({square}, drawing));
  EXPECT_GT(centre.g, 150);
  EXPECT_EQ(centre.r, 0);
}

TEST(CanvasTest, AVeilIsBehindItsCoversAndInFrontOfOtherShapes) {
  const Color over = ThroughVeil(0.8);
  const Color under = ThroughVeil(0.2);
  EXPECT_GT(over.r, over.b + 60);
  EXPECT_GT(under.b, over.b + 60);
  // The red square contributes 0.8, or half of that below the layer.
  EXPECT_NEAR(over.g, 0.2 * ThroughVeil(-20).g, 30);
}

TEST(CanvasTest, BesideAVeilALayerIsAsItIsWithoutOne) {
  const std::vector<ShadedMesh> meshes = {Square(0.9, 0.5), Square(0.1, 0.8)};
  Drawing drawing;
  drawing.layers = {{{{MeshInstance{0}, Color{0, 0, 255}}}, 0.5}};
  const Image without = DrawOnce(meshes, drawing);
  drawing.veil = Veil{{{MeshInstance{1}, Color{255, 0, 0}, 0.8}}, {}, {{0}}, {}};
  const Image with = DrawOnce(meshes, drawing);
  int changed = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const std::size_t at = 3 * (std::size_t(y) * kSide + x);
      const bool differs = std::abs(without.rgb[at] - with.rgb[at]) > 2;
      const bool inside = std::max(std::abs(x - kSide / 2), std::abs(y - kSide / 2)) <= 4;
      EXPECT_TRUE(inside || !differs) << x << ", " << y;
      changed += differs ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 20);
}

TEST(CanvasTest, AVeilIsClearerInAWindow) {
  const Color closed = ThroughVeil(0.8);
  const Color open = ThroughVeil(0.8, {{{kSide / 2.0, kSide / 2.0}, 10, 1}});
  const Color half = ThroughVeil(0.8, {{{kSide / 2.0, kSide / 2.0}, 10, 0.5}});
  EXPECT_GT(open.b, half.b + 20);
  EXPECT_GT(half.b, closed.b + 20);
  EXPECT_EQ(ThroughVeil(0.8, {{{5, 5}, 10, 1}}).b, closed.b) << "elsewhere";
}

TEST(CanvasTest, ALayerIsBlendedWithItsOpacity) {
  const std::vector<ShadedMesh> meshes = {Square(0.9, 0.5)};
  Drawing drawing;
  drawing.shapes = {{Line{{-0.5, 0, 0}, {0.5, 0, 0}, 0.2}, kRed}};
  const Color below = CentreOf(DrawOnce(meshes, drawing));
  EXPECT_EQ(below.r, kRed.r);  // lines have no lighting
  Layer cover = {{{MeshInstance{0}, Color{0, 0, 255}}}, 1};
  drawing.layers = {cover};
  const Color covered = CentreOf(DrawOnce(meshes, drawing));
  drawing.layers[0].opacity = 0.25;
  const Color seen_through = CentreOf(DrawOnce(meshes, drawing));
  EXPECT_NEAR(seen_through.r, 0.75 * below.r + 0.25 * covered.r, 1);
  EXPECT_NEAR(seen_through.b, 0.75 * below.b + 0.25 * covered.b, 1);
  EXPECT_GT(covered.b, 100);
  EXPECT_EQ(covered.r, 0);
}

TEST(CanvasTest, ALayerBehindAShapeDoesNotPaleIt) {
  Drawing drawing;
  drawing.shapes = {{Line{{-0.5, 0, 0}, {0.5, 0, 0}, 0.2}, kRed}};
  drawing.layers = {{{{MeshInstance{0}, Color{0, 0, 255}}}, 0.5}};
  EXPECT_EQ(CentreOf(DrawOnce({Square(0.9, -0.5)}, drawing)).r, kRed.r);
}

TEST(CanvasTest, ATranslucentShapeIsBlendedOnce) {
  Drawing drawing;
  drawing.shapes = {{Line{{-0.5, 0, 0}, {0.5, 0, 0}, 0.2}, Color{0, 0, 0}, 0.5}};
  EXPECT_NEAR(CentreOf(DrawOnce({}, drawing)).g, 128, 1);
}

TEST(CanvasTest, ShapesInFrontHideOutlines) {
  Drawing drawing;
  drawing.outline = {{Line{{-0.5, 0, 0}, {0.5, 0, 0}, 0.1}, kRed}};
  for (const double height : {-0.5, 0.5}) {
    drawing.hiding = {{0}};
    const Color centre = CentreOf(DrawOnce({Square(0.9, height)}, drawing));
    EXPECT_EQ(centre.g, height < 0 ? kRed.g : 255) << height;
  }
}

TEST(CanvasTest, SupersamplingAveragesEdgesAndKeepsAreas) {
  Drawing drawing;
  drawing.shapes = {{Sphere{Vector3d::Zero(), 0.5}, kRed}};
  const auto tones = [](const Image& image) {
    std::vector<unsigned char> green;
    for (std::size_t i = 1; i < image.rgb.size(); i += 3) green.push_back(image.rgb[i]);
    std::ranges::sort(green);
    return std::ranges::unique(green).begin() - green.begin();
  };
  const Image rough = DrawOnce({}, drawing, 1), fine = DrawOnce({}, drawing, 4);
  EXPECT_GT(tones(fine), tones(rough));
  EXPECT_NEAR(CountColored(fine), CountColored(rough), 150);
}

TEST(CanvasTest, PerspectiveShrinksDistantShapes) {
  Camera camera = FromAbove();
  const auto pixels = [&](double z) {
    Drawing drawing;
    drawing.shapes = {{Sphere{Vector3d(0, 0, z), 0.3}, kRed}};
    Canvas canvas({}, kSide, kSide, 1);
    return CountColored(canvas.Draw(camera, drawing));
  };
  EXPECT_NEAR(pixels(-2), pixels(2), 3);
  camera.projection = Projection::kPerspective;
  camera.half_height = 0.1;
  EXPECT_NEAR(pixels(-2) * 144.0 / 64, pixels(2), 0.1 * pixels(2));
}

}  // namespace canvas_test
}  // namespace regrasp::render
