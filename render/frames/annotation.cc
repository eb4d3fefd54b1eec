#include "render/frames/annotation.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;

/// Font size per square root of the image area: 23 pixels at 1280 × 960.
constexpr double kFontSize = 0.0208;
constexpr double kLongestBar = 0.20;  ///< maximum length of the scale bar per image width

// Lengths in multiples of the font size.
constexpr double kMargin = 1.33;
constexpr double kLineHeight = 1.25;
constexpr double kNumberSize = 1.2;
constexpr double kProgressSize = 1.25;
constexpr double kOrdinalSize = 0.85;
constexpr double kLabelRadius = 0.66;
/// Radius of a label per width of its text.
constexpr double kWideLabel = 0.45;
constexpr double kHalo = 0.32;
constexpr double kLeaderWidth = 0.08;
constexpr double kRingGap = 0.36;
constexpr double kRingWidth = 0.14;

/// Largest distance of a number from its finger without a line between them, in label radii.
constexpr double kBeside = 2.6;

/// Weights of obstacles. Covering a cone is preferable to covering a finger.
constexpr double kFingerWeight = 1;
constexpr double kConeWeight = 0.25;
constexpr double kTextWeight = 3;
/// Radius of the strip that represents a friction cone, per length of the cone.
constexpr double kConeStrip = 0.3;

/// Factor that darkens numbers and rings, because thin strokes look paler than areas.
constexpr double kShade = 0.82;
constexpr double kLighter = 0.55;  ///< factor for a dark background

Color NumberColor(Color color, const Ground& ground) {
  const bool dark = ground.paper.g < ground.ink.g;
  const auto shade = [dark](int channel) {
    return static_cast<unsigned char>(dark ? 255 - kLighter * (255 - channel) : kShade * channel);
  };
  return {shade(color.r), shade(color.g), shade(color.b)};
}

/// Text and rings on one frame.
class Writer {
 public:
  /// Create a writer. All arguments must outlive it.
  Writer(cairo_t* cr, const Camera& camera, const TextStyle& style)
      : cr_(cr), camera_(camera), ground_(style.ground), font_(style.font) {}

  /// Draw a ring just outside the fingertip, dark on white, so that it is visible on any
  /// background.
  void DrawRing(const FingerGlyph& glyph) const {
    const Vector2d centre = camera_.Project(glyph.fingertip);
    const double radius =
        glyph.fingertip_radius * camera_.PixelsPerUnit(glyph.fingertip) + kRingGap * font_;
    for (const bool halo : {true, false}) {
      SetCircle(cr_, centre, radius);
      Stroke(cr_, halo ? ground_.halo : NumberColor(glyph.color, ground_),
             (halo ? 2.2 : 1) * kRingWidth * font_);
    }
  }

  /// Draw the caption, in a smaller font if it needs more than two lines.
  /// @returns the covered areas.
  [[nodiscard]] std::vector<Obstacle> DrawCaption(const std::string& caption) const;
  [[nodiscard]] std::vector<Obstacle> DrawScaleBar(double metres_per_unit) const;
  [[nodiscard]] std::vector<Obstacle> DrawProgress(const std::string& progress) const;
  void DrawNumbers(std::span<const FingerGlyph> fingers, std::span<const std::string> names,
                   std::span<const Obstacle> covered) const;

 private:
  void DrawCentred(const std::string& text, const Vector2d& centre, Color color) const {
    const Vector2d begin = CentredText(cr_, text, centre);
    cairo_move_to(cr_, begin.x(), begin.y());
    cairo_text_path(cr_, text.c_str());
    FillWithHalo(cr_, color, kHalo * font_, ground_.halo);
  }
  void DrawLeader(const FingerGlyph& glyph, const Vector2d& number, double font) const;

  cairo_t* cr_;
  const Camera& camera_;
  const Ground& ground_;
  double font_;
};

/// Draw a line from a number to its fingertip unless the number is next to the finger.
void Writer::DrawLeader(const FingerGlyph& glyph, const Vector2d& number, double font) const {
  const Vector2d fingertip = camera_.Project(glyph.fingertip);
  if (DistanceToSegment(number, fingertip, camera_.Project(glyph.end)) <
      kBeside * kLabelRadius * font) {
    return;
  }
  const Vector2d along = (fingertip - number).normalized();
  const Vector2d from = number + kLabelRadius * font * along;
  for (const bool halo : {true, false}) {
    cairo_move_to(cr_, from.x(), from.y());
    cairo_line_to(cr_, fingertip.x(), fingertip.y());
    Stroke(cr_, halo ? ground_.halo : NumberColor(glyph.color, ground_),
           (halo ? 2.4 : 1) * kLeaderWidth * font);
  }
}

/// Return "1st" and so on for each sliding finger. Empty if all start together.
std::vector<std::string> OrdinalsOf(std::span<const FingerGlyph> fingers) {
  constexpr std::array<const char*, 5> kOrdinals = {"1st", "2nd", "3rd", "4th", "5th"};
  std::set<int> starts;
  for (const FingerGlyph& glyph : fingers) {
    if (const auto leg = FirstLeg(glyph)) starts.insert(*leg);
  }
  std::vector<std::string> ordinals(fingers.size());
  if (starts.size() < 2 || starts.size() > kOrdinals.size()) return ordinals;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const auto leg = FirstLeg(fingers[i]);
    if (leg) ordinals[i] = kOrdinals[std::distance(starts.begin(), starts.find(*leg))];
  }
  return ordinals;
}

/// Return the text next to a finger: its name unless that is long, or its number.
std::string LabelOf(FingerIndex finger, std::span<const std::string> names) {
  constexpr std::size_t kLongest = 10;
  const std::string label = FingerLabel(finger, names);
  return label.size() <= kLongest ? label : std::to_string(finger);
}

void Writer::DrawNumbers(std::span<const FingerGlyph> fingers, std::span<const std::string> names,
                         std::span<const Obstacle> covered) const {
  const double font = std::max(font_, kSmallestFont);
  std::vector<LabelAnchor> anchors;
  std::vector<std::string> texts;
  std::vector<Color> colors;
  for (const FingerGlyph& glyph : fingers) {
    const Vector2d anchor = camera_.Project(glyph.end);
    anchors.push_back(
        {anchor, anchor - camera_.Project(glyph.contact), camera_.Project(glyph.fingertip)});
    texts.push_back(LabelOf(glyph.finger, names));
    colors.push_back(NumberColor(glyph.color, ground_));
  }
  const std::vector<std::string> ordinals = OrdinalsOf(fingers);
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    if (ordinals[i].empty()) continue;
    const Vector2d ghost = camera_.Project(fingers[i].path.front());
    anchors.push_back({ghost, ghost - camera_.Project(fingers[i].contact)});
    texts.push_back(ordinals[i]);
    colors.push_back(colors[i]);
  }
  std::vector<Obstacle> obstacles = ObstaclesOf(camera_, fingers);
  obstacles.insert(obstacles.end(), covered.begin(), covered.end());
  SelectFont(cr_, kNumberSize * font, /*bold=*/true);
  double radius = kLabelRadius * font;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    radius = std::max(radius, kWideLabel * TextWidth(cr_, texts[i]));
  }
  const std::vector<Vector2d> centres =
      PlaceLabels(anchors, obstacles, radius, camera_.width, camera_.height);
  for (std::size_t i = 0; i < fingers.size(); ++i) DrawLeader(fingers[i], centres[i], font);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i == fingers.size()) SelectFont(cr_, kOrdinalSize * font, /*bold=*/true);
    DrawCentred(texts[i], centres[i], colors[i]);
  }
}

std::vector<Obstacle> Writer::DrawCaption(const std::string& caption) const {
  if (caption.empty()) return {};
  constexpr double kSmaller = 0.95;
  const double margin = kMargin * font_;
  const double most = camera_.width * (1 - kLongestBar) - 3 * margin;
  std::vector<std::string> lines;
  double size = font_;
  const auto fits = [&] {
    SelectFont(cr_, size, /*bold=*/false);
    lines = BreakLines(cr_, caption, most);
    return lines.size() <= 2 && std::ranges::all_of(lines, [&](const std::string& line) {
             return TextWidth(cr_, line) <= most;
           });
  };
  while (size >= kSmallestFont && !fits()) size *= kSmaller;
  if (size < kSmallestFont) return {};
  std::vector<Obstacle> covered;
  double base = camera_.height - margin - (std::ssize(lines) - 1) * kLineHeight * size;
  for (const std::string& line : lines) {
    cairo_move_to(cr_, margin, base);
    cairo_text_path(cr_, line.c_str());
    FillWithHalo(cr_, ground_.ink, kHalo * font_, ground_.halo);
    const double middle = base - size / 3;
    covered.push_back(
        {{margin, middle}, {margin + TextWidth(cr_, line), middle}, size / 2, kTextWeight});
    base += kLineHeight * size;
  }
  return covered;
}

std::vector<Obstacle> Writer::DrawProgress(const std::string& progress) const {
  if (progress.empty() || font_ < kSmallestFont) return {};
  const double size = kProgressSize * font_;
  SelectFont(cr_, size, /*bold=*/true);
  const double width = TextWidth(cr_, progress);
  const double margin = kMargin * font_;
  const Vector2d centre(camera_.width - margin - width / 2, margin + size / 2);
  DrawCentred(progress, centre, ground_.rotation);
  const Vector2d half(width / 2, 0);
  return {{centre - half, centre + half, size / 2, kTextWeight}};
}

std::vector<Obstacle> Writer::DrawScaleBar(double metres_per_unit) const {
  if (font_ < kSmallestFont) return {};
  const double pixels_per_metre = camera_.PixelsPerUnit(Eigen::Vector3d::Zero()) / metres_per_unit;
  const double metres = RoundLength(kLongestBar * camera_.width / pixels_per_metre);
  const double length = metres * pixels_per_metre;
  const double margin = kMargin * font_;
  const double y = camera_.height - margin;
  const double right = camera_.width - margin;
  const double left = right - length;
  const double tick = font_ / 4;
  for (const double x : {left, right}) {
    cairo_move_to(cr_, x, y - tick);
    cairo_line_to(cr_, x, y + tick);
  }
  cairo_move_to(cr_, left, y);
  cairo_line_to(cr_, right, y);
  Stroke(cr_, ground_.ink, std::max(1.0, font_ / 10));
  SelectFont(cr_, font_, /*bold=*/false);
  DrawCentred(FormatLength(metres), {(left + right) / 2, y - 0.8 * font_}, ground_.ink);
  return {{{left, y - font_ / 2}, {right, y - font_ / 2}, font_, kTextWeight}};
}

}  // namespace

double FontSize(int width, int height) {
  return kFontSize * std::sqrt(static_cast<double>(width) * height);
}

void DrawRings(const CairoImage& image, const Camera& camera, std::span<const FingerGlyph> fingers,
               const TextStyle& style) {
  const Writer writer(image.context(), camera, style);
  for (const FingerGlyph& glyph : fingers) {
    if (glyph.role == plan::FingerRole::kPlaced) writer.DrawRing(glyph);
  }
}

std::vector<Obstacle> DrawCaption(const CairoImage& image, const Camera& camera,
                                  const std::string& caption, double metres_per_unit,
                                  const TextStyle& style) {
  const Writer writer(image.context(), camera, style);
  cairo_set_line_join(image.context(), CAIRO_LINE_JOIN_ROUND);
  std::vector<Obstacle> covered = writer.DrawCaption(caption);
  for (const Obstacle& bar : writer.DrawScaleBar(metres_per_unit)) covered.push_back(bar);
  return covered;
}

std::vector<Obstacle> DrawProgress(const CairoImage& image, const Camera& camera,
                                   const std::string& progress, const TextStyle& style) {
  cairo_set_line_join(image.context(), CAIRO_LINE_JOIN_ROUND);
  return Writer(image.context(), camera, style).DrawProgress(progress);
}

std::vector<Obstacle> ObstaclesOf(const Camera& camera, std::span<const FingerGlyph> fingers) {
  std::vector<Obstacle> obstacles;
  for (const FingerGlyph& glyph : fingers) {
    const double pixels = camera.PixelsPerUnit(glyph.fingertip);
    const Vector2d fingertip = camera.Project(glyph.fingertip);
    obstacles.push_back({fingertip, fingertip, glyph.fingertip_radius * pixels, kFingerWeight});
    obstacles.push_back(
        {fingertip, camera.Project(glyph.end), glyph.fingertip_radius / 2 * pixels, kFingerWeight});
    obstacles.push_back({camera.Project(glyph.contact),
                         camera.Project(glyph.contact - glyph.outward * kConeLength),
                         kConeStrip * kConeLength * pixels, kConeWeight});
    if (FirstLeg(glyph)) {
      const Vector2d ghost = camera.Project(glyph.path.front());
      obstacles.push_back({ghost, ghost, glyph.fingertip_radius * pixels, kFingerWeight});
    }
    for (std::size_t i = 1; i < glyph.path.size(); ++i) {
      obstacles.push_back(
          {camera.Project(glyph.path[i - 1]), camera.Project(glyph.path[i]), 0, kFingerWeight});
    }
  }
  return obstacles;
}

void DrawNumbers(const CairoImage& image, const Camera& camera,
                 std::span<const FingerGlyph> fingers, std::span<const std::string> names,
                 std::span<const Obstacle> covered, const TextStyle& style) {
  cairo_set_line_join(image.context(), CAIRO_LINE_JOIN_ROUND);
  Writer(image.context(), camera, style).DrawNumbers(fingers, names, covered);
}

namespace {

using Eigen::Vector3d;

// Lengths in multiples of the font size.
constexpr double kRadius = 3.6;
constexpr double kSpace = 1.1;   ///< occupied radius per radius of the inset
constexpr double kTravel = 3.6;  ///< length of the magnified path
constexpr double kDisc = 0.8;    ///< radius of a finger's start and end disc
constexpr double kArrow = 0.22;
constexpr double kInsetRim = 0.09;
constexpr double kText = 0.8;

/// Limits of the magnification: below, the inset shows no more than the frame.
constexpr double kLeastMagnified = 2;
constexpr double kMostMagnified = 200;
constexpr double kPale = 0.35;
constexpr double kWeight = 3;  ///< weight of an inset as an obstacle

double LengthOf(const std::vector<Vector3d>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

Vector3d MiddleOf(const FingerGlyph& glyph) { return (glyph.path.front() + glyph.contact) / 2; }

/// Return the camera with a longer focal length, shifted so that `point` is projected to `place`.
Camera Magnify(Camera camera, double magnification, const Vector3d& point, const Vector2d& place) {
  camera.half_height /= magnification;
  const Vector2d off = (place - camera.Project(point)) / camera.PixelsPerUnit(point);
  camera.position -= camera.axes.leftCols<2>() * Vector2d(off.x(), -off.y());
  return camera;
}

}  // namespace

std::vector<AlignInset> PlaceInsets(const Camera& camera, std::span<const FingerGlyph> fingers,
                                    std::span<const Obstacle> covered, const TextStyle& style) {
  std::vector<AlignInset> insets;
  if (style.font < kSmallestFont) return insets;
  std::vector<LabelAnchor> anchors;
  for (const FingerGlyph& glyph : fingers) {
    const double length = LengthOf(glyph.path);
    if (!FirstLeg(glyph) || !(length < 2 * glyph.fingertip_radius)) continue;
    const double pixels = length * camera.PixelsPerUnit(glyph.contact);
    const double magnification = kTravel * style.font / pixels;
    if (magnification < kLeastMagnified || magnification > kMostMagnified) continue;
    const Vector2d fingertip = camera.Project(glyph.fingertip);
    AlignInset& inset = insets.emplace_back();
    inset.glyph = glyph;
    inset.fingertip = fingertip;
    inset.radius = kRadius * style.font;
    inset.magnification = magnification;
    anchors.push_back({fingertip, fingertip - camera.Project(Vector3d::Zero())});
  }
  std::vector<Obstacle> obstacles = ObstaclesOf(camera, fingers);
  obstacles.insert(obstacles.end(), covered.begin(), covered.end());
  const std::vector<Vector2d> centres =
      PlaceLabels(anchors, obstacles, kSpace * kRadius * style.font, camera.width, camera.height);
  for (std::size_t i = 0; i < insets.size(); ++i) {
    insets[i].centre = centres[i];
    insets[i].camera =
        Magnify(camera, insets[i].magnification, MiddleOf(insets[i].glyph), centres[i]);
  }
  return insets;
}

std::vector<Obstacle> DrawInset(const CairoImage& image, const AlignInset& inset, const Image& body,
                                const TextStyle& style) {
  cairo_t* cr = image.context();
  const FingerGlyph& glyph = inset.glyph;
  const Ground& ground = style.ground;
  const double font = style.font;
  const Camera& camera = inset.camera;
  SetColor(cr, ground.ink);
  StrokeLine(cr, inset.centre, inset.fingertip, kInsetRim * font);
  cairo_save(cr);
  SetCircle(cr, inset.centre, inset.radius);
  cairo_clip(cr);
  const CairoImage background(body);
  cairo_set_source_surface(cr, background.surface(), 0, 0);
  cairo_paint(cr);
  std::vector<Vector2d> path;
  for (const Vector3d& p : glyph.path) path.push_back(camera.Project(p));
  SetCircle(cr, path.front(), kDisc * font);
  Fill(cr, glyph.color, kPale);
  SetCircle(cr, path.back(), kDisc * font);
  Fill(cr, glyph.color);
  DrawArrow(cr, path, kArrow * font, ground.ink, ground.halo);
  DrawDot(cr, path.front(), kArrow * font);
  SelectFont(cr, kText * font, /*bold=*/false);
  constexpr int kDigits = 2;
  const std::string text = "× " + FormatPlain(inset.magnification, kDigits);
  const Vector2d low(0, 0.72 * inset.radius);
  const Vector2d at = CentredText(cr, text, inset.centre + low);
  cairo_move_to(cr, at.x(), at.y());
  cairo_text_path(cr, text.c_str());
  FillWithHalo(cr, ground.ink, 0.3 * font, ground.halo);
  cairo_restore(cr);
  SetCircle(cr, inset.centre, inset.radius);
  Stroke(cr, ground.ink, kInsetRim * font);
  return {{inset.centre, inset.centre, inset.radius, kWeight}};
}

}  // namespace regrasp::render
