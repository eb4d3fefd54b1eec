#include "render/frames/annotation.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include "planner/base/number.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;

/// Of the root of the area: 23 pixels at 1280 × 960.
constexpr double kFontSize = 0.0208;
constexpr double kLongestBar = 0.20;  ///< of the image's width

// In font sizes.
constexpr double kMargin = 1.33;
constexpr double kLineHeight = 1.25;
constexpr double kNumberSize = 1.2;
constexpr double kOrdinalSize = 0.85;
constexpr double kLabelRadius = 0.66;
constexpr double kHalo = 0.32;
constexpr double kLeaderWidth = 0.08;
constexpr double kRingGap = 0.36;
constexpr double kRingWidth = 0.14;

/// A number this near to its finger needs no line to it, in radii of a label.
constexpr double kBeside = 2.6;

/// Labels should not cover these; to cover a cone is a lesser evil.
constexpr double kFingerWeight = 1;
constexpr double kConeWeight = 0.25;
constexpr double kTextWeight = 3;
/// The friction cone counts as a strip of this share of its length.
constexpr double kConeStrip = 0.3;

/// Numbers and rings are nearer to the ink than their finger's colour: thin strokes look paler.
constexpr double kShade = 0.82;
constexpr double kLighter = 0.55;  ///< on a dark ground

Color NumberColor(Color color, const Ground& ground) {
  const bool dark = ground.paper.g < ground.ink.g;
  const auto shade = [dark](int channel) {
    return static_cast<unsigned char>(dark ? 255 - kLighter * (255 - channel) : kShade * channel);
  };
  return {shade(color.r), shade(color.g), shade(color.b)};
}

/// Writes on one picture.
class Writer {
 public:
  /// All arguments outlive this object.
  Writer(cairo_t* cr, const Camera& camera, const TextStyle& style)
      : cr_(cr), camera_(camera), ground_(style.ground), font_(style.font) {}

  /// A ring just outside the ball, dark within white, so that it shows on any ground.
  void DrawRing(const FingerGlyph& glyph) const {
    const Vector2d centre = camera_.Project(glyph.ball);
    const double radius = glyph.ball_radius * camera_.PixelsPerUnit(glyph.ball) + kRingGap * font_;
    for (const bool halo : {true, false}) {
      SetCircle(cr_, centre, radius);
      Stroke(cr_, halo ? ground_.halo : NumberColor(glyph.color, ground_),
             (halo ? 2.2 : 1) * kRingWidth * font_);
    }
  }

  /// Writes the caption, in a smaller font where it would need more than two lines, and returns
  /// what it covers.
  [[nodiscard]] std::vector<Obstacle> DrawCaption(const std::string& caption) const;
  [[nodiscard]] std::vector<Obstacle> DrawScaleBar(double metres_per_unit) const;
  void DrawNumbers(std::span<const FingerGlyph> fingers, std::span<const Obstacle> covered) const;

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

/// A line from a number to its finger's ball, where it does not stand beside the finger.
void Writer::DrawLeader(const FingerGlyph& glyph, const Vector2d& number, double font) const {
  const Vector2d ball = camera_.Project(glyph.ball);
  if (DistanceToSegment(number, ball, camera_.Project(glyph.end)) < kBeside * kLabelRadius * font) {
    return;
  }
  const Vector2d along = (ball - number).normalized();
  const Vector2d from = number + kLabelRadius * font * along;
  for (const bool halo : {true, false}) {
    cairo_move_to(cr_, from.x(), from.y());
    cairo_line_to(cr_, ball.x(), ball.y());
    Stroke(cr_, halo ? ground_.halo : NumberColor(glyph.color, ground_),
           (halo ? 2.4 : 1) * kLeaderWidth * font);
  }
}

/// "1st", … of each finger that aligns, where they do not begin together; empty otherwise.
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

void Writer::DrawNumbers(std::span<const FingerGlyph> fingers,
                         std::span<const Obstacle> covered) const {
  const double font = std::max(font_, kSmallestFont);
  std::vector<LabelAnchor> anchors;
  std::vector<std::string> texts;
  std::vector<Color> colors;
  for (const FingerGlyph& glyph : fingers) {
    const Vector2d anchor = camera_.Project(glyph.end);
    anchors.push_back(
        {anchor, anchor - camera_.Project(glyph.contact), camera_.Project(glyph.ball)});
    texts.push_back(std::to_string(glyph.finger));
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
  const std::vector<Vector2d> centres =
      PlaceLabels(anchors, obstacles, kLabelRadius * font, camera_.width, camera_.height);
  SelectFont(cr_, kNumberSize * font, /*bold=*/true);
  for (std::size_t i = 0; i < fingers.size(); ++i) DrawLeader(fingers[i], centres[i], font);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i == fingers.size()) SelectFont(cr_, kOrdinalSize * font, /*bold=*/true);
    DrawCentred(texts[i], centres[i], colors[i]);
  }
}

/// Breaks a text at spaces into lines that are no wider than `most` in the current font, where
/// words allow it.
std::vector<std::string> BreakLines(cairo_t* cr, const std::string& text, double most) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? word : line + " " + word;
    if (line.empty() || TextWidth(cr, longer) <= most) {
      line = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
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

void DrawRings(const CairoImage& page, const Camera& camera, std::span<const FingerGlyph> fingers,
               const TextStyle& style) {
  const Writer writer(page.context(), camera, style);
  for (const FingerGlyph& glyph : fingers) {
    if (glyph.role == plan::FingerRole::kPlaced) writer.DrawRing(glyph);
  }
}

std::vector<Obstacle> DrawCaption(const CairoImage& page, const Camera& camera,
                                  const std::string& caption, double metres_per_unit,
                                  const TextStyle& style) {
  const Writer writer(page.context(), camera, style);
  cairo_set_line_join(page.context(), CAIRO_LINE_JOIN_ROUND);
  std::vector<Obstacle> covered = writer.DrawCaption(caption);
  for (const Obstacle& bar : writer.DrawScaleBar(metres_per_unit)) covered.push_back(bar);
  return covered;
}

std::vector<Obstacle> ObstaclesOf(const Camera& camera, std::span<const FingerGlyph> fingers) {
  std::vector<Obstacle> obstacles;
  for (const FingerGlyph& glyph : fingers) {
    const double pixels = camera.PixelsPerUnit(glyph.ball);
    const Vector2d ball = camera.Project(glyph.ball);
    obstacles.push_back({ball, ball, glyph.ball_radius * pixels, kFingerWeight});
    obstacles.push_back(
        {ball, camera.Project(glyph.end), glyph.ball_radius / 2 * pixels, kFingerWeight});
    obstacles.push_back({camera.Project(glyph.contact),
                         camera.Project(glyph.contact - glyph.outward * kConeLength),
                         kConeStrip * kConeLength * pixels, kConeWeight});
    if (FirstLeg(glyph)) {
      const Vector2d ghost = camera.Project(glyph.path.front());
      obstacles.push_back({ghost, ghost, glyph.ball_radius * pixels, kFingerWeight});
    }
    for (std::size_t i = 1; i < glyph.path.size(); ++i) {
      obstacles.push_back(
          {camera.Project(glyph.path[i - 1]), camera.Project(glyph.path[i]), 0, kFingerWeight});
    }
  }
  return obstacles;
}

void DrawNumbers(const CairoImage& page, const Camera& camera, std::span<const FingerGlyph> fingers,
                 std::span<const Obstacle> covered, const TextStyle& style) {
  cairo_set_line_join(page.context(), CAIRO_LINE_JOIN_ROUND);
  Writer(page.context(), camera, style).DrawNumbers(fingers, covered);
}

}  // namespace regrasp::render
