#include "render/figures/figure_page.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/svg_path.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

/// Resolution of a PNG: journals require at least this many dots per inch.
constexpr double kPixelsPerPoint = 300.0 / 72.0;
/// Maximum side, pixels. Half of Cairo's limit of 32767 keeps the memory below a gigabyte.
constexpr double kLongestSide = 16000;
/// Date of every PDF, so that files of the same figure are identical.
constexpr char kPdfDate[] = "2000-01-01T00:00:00Z";

cairo_status_t Append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void Require(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw EnvironmentError(std::string("the figure cannot be drawn: ") +
                         cairo_status_to_string(status));
}

/// Key of the font family of a context.
constexpr cairo_user_data_key_t kFamilyKey = {};

/// Default family. Frames have another name of the same font (SelectFont).
constexpr char kDefaultFamily[] = "sans";

void SetFamily(cairo_t* cr, const std::string& family) {
  const auto free = [](void* text) { delete static_cast<std::string*>(text); };
  auto kept = std::make_unique<std::string>(family.empty() ? kDefaultFamily : family);
  Require(cairo_set_user_data(cr, &kFamilyKey, kept.get(), free));
  static_cast<void>(kept.release());  // the context owns it
}

const char* FamilyOf(cairo_t* cr) {
  const auto* family = static_cast<std::string*>(cairo_get_user_data(cr, &kFamilyKey));
  return family != nullptr ? family->c_str() : kDefaultFamily;
}

/// Remove the surface name from an SVG. Cairo numbers surfaces over the life of the process.
void RemoveSurfaceName(std::string& svg) {
  static constexpr std::string_view kBegin = "<g";
  static constexpr std::string_view kName = " id=\"surface";
  const std::size_t group = svg.find(std::string(kBegin) + std::string(kName));
  if (group == std::string::npos) return;
  const std::size_t name = group + kBegin.size();
  svg.erase(name, svg.find('>', name) - name);
}

}  // namespace

cairo_surface_t* FigurePage::MakeSurface(double width, double height) {
  assert(width > 0 && height > 0);
  switch (format_) {
    case FigureFormat::kSvg: {
      cairo_surface_t* svg =
          cairo_svg_surface_create_for_stream(Append, bytes_.get(), width, height);
      cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PT);
      return svg;
    }
    case FigureFormat::kPdf: {
      cairo_surface_t* pdf =
          cairo_pdf_surface_create_for_stream(Append, bytes_.get(), width, height);
      cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, kPdfDate);
      cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATOR, kFigureMaker);
      return pdf;
    }
    case FigureFormat::kPng:
      break;
  }
  scale_ = std::min(kPixelsPerPoint, kLongestSide / std::max(width, height));
  const auto pixels = [&](double points) {
    return std::max(1, static_cast<int>(std::lround(points * scale_)));
  };
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height));
}

FigurePage::FigurePage(FigureFormat format, double width, double height, double magnification,
                       const std::string& family)
    : format_(format),
      bytes_(std::make_unique<std::string>()),
      surface_(MakeSurface(magnification * width, magnification * height)),
      context_(cairo_create(surface_.get())) {
  cairo_t* cr = context_.get();
  Require(cairo_status(cr));
  SetFamily(cr, family);
  cairo_scale(cr, scale_ * magnification, scale_ * magnification);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
}

std::string FigurePage::Finish() {
  Require(cairo_status(context_.get()));
  if (format_ == FigureFormat::kPng) {
    cairo_surface_flush(surface_.get());
    Require(cairo_surface_write_to_png_stream(surface_.get(), Append, bytes_.get()));
  } else {
    cairo_show_page(context_.get());
    cairo_surface_finish(surface_.get());
    Require(cairo_surface_status(surface_.get()));
  }
  if (format_ == FigureFormat::kSvg) {
    RemoveSurfaceName(*bytes_);
    *bytes_ = ShortenPaths(*bytes_);
  }
  MarkFigure(format_, *bytes_);
  return std::move(*bytes_);
}

namespace {

// Lengths in points.
constexpr double kInset = 5;  ///< distance from the right border of the panel
constexpr double kWidth = 0.6;
constexpr double kBarTick = 1.5;
constexpr double kTextAbove = 2.5;

constexpr double kLongest = 0.25;  ///< maximum length of a scale bar per width of the panel

}  // namespace

double ScaleBarLength(double width, double points_per_metre) {
  return RoundLength(kLongest * width / points_per_metre);
}

void DrawScaleBar(cairo_t* cr, const Eigen::Vector2d& panel, double points_per_metre) {
  const double metres = ScaleBarLength(panel.x(), points_per_metre);
  const double right = panel.x() - kInset;
  const double left = right - metres * points_per_metre;
  const double y = panel.y() - kWidth;
  SetColor(cr, kInk);
  StrokeLine(cr, {left, y}, {right, y}, kWidth);
  for (const double x : {left, right}) StrokeLine(cr, {x, y - kBarTick}, {x, y}, kWidth);
  DrawLabel(cr, FormatLength(metres), {(left + right) / 2, y - kTextAbove}, TextAlign::kCentre);
}

using Eigen::Vector2d;

namespace {

/// Distance from its anchor up to which a name needs no leader line, in radii.
constexpr double kBeside = 3.2;
constexpr double kLeaderWidth = 0.4;  ///< width of a leader line, points
constexpr double kLeaderHalo = 0.8;   ///< width of its halo on each side, points
constexpr double kLeaderStart =
    0.75;  ///< distance of its start from the centre of the name, in radii
constexpr double kLeaderEnd =
    3.6;  ///< distance of its end from the contact, outside the marker, points

/// Radius of a name per width of its text.
constexpr double kWideName = 0.45;

/// @param width  width of the name, points.
void DrawLeader(cairo_t* cr, const Vector2d& name, double width, const Vector2d& owner) {
  const Vector2d direction = owner - name;
  // Names are wider than high.
  const double across = std::abs(direction.x()) / std::max(direction.norm(), kNumberRadius);
  const double radius = std::max(kNumberRadius, across * width / 2);
  if (direction.norm() < radius + (kBeside - 1) * kNumberRadius) return;
  const Vector2d from = name + kLeaderStart * radius * direction.normalized();
  const Vector2d to = owner - kLeaderEnd * direction.normalized();
  SetColor(cr, kWhite);
  StrokeLine(cr, from, to, kLeaderWidth + 2 * kLeaderHalo);
  SetColor(cr, kInk);
  StrokeLine(cr, from, to, kLeaderWidth);
}

}  // namespace

std::vector<Vector2d> DrawNumbers(cairo_t* cr, std::span<const std::string> names,
                                  std::span<const LabelAnchor> anchors,
                                  std::span<const Obstacle> obstacles, const Vector2d& panel) {
  std::vector<double> widths;
  double radius = kNumberRadius;
  for (const std::string& name : names) {
    widths.push_back(MarkWidth(cr, name));
    radius = std::max(radius, kWideName * widths.back());
  }
  std::vector<Vector2d> centres = PlaceLabels(
      anchors, obstacles, radius, static_cast<int>(panel.x()), static_cast<int>(panel.y()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    DrawLeader(cr, centres[i], widths[i], anchors[i].Owner());
  }
  for (std::size_t i = 0; i < names.size(); ++i) DrawMark(cr, names[i], centres[i]);
  return centres;
}

namespace {

constexpr double kHalo = 1.6;  ///< width of the halo of a mark, points
constexpr char kClauseEnd = ';';

/// Set the font of all pages. It is unhinted, so that SVG, PDF and PNG have the same layout.
void SetFont(cairo_t* cr, double size, bool bold) {
  SelectFont(cr, size, bold, FamilyOf(cr));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cr, options);
  cairo_font_options_destroy(options);
}

/// Split a text after each separator and trim the parts.
std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size() - 1) + 1;
    std::string part = text.substr(begin, end - begin);
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    if (!part.empty()) parts.push_back(part);
    begin = end;
  }
  return parts;
}

/// Return the words of a clause. Numbers stay with the preceding word.
std::vector<std::string> Words(const std::string& clause) {
  std::vector<std::string> words;
  for (const std::string& word : Split(clause, ' ')) {
    const bool number = std::isdigit(static_cast<unsigned char>(word.front())) != 0;
    if (number && !words.empty()) {
      words.back() += " " + word;
    } else {
      words.push_back(word);
    }
  }
  return words;
}

}  // namespace

bool IsInstalledFamily(const std::string& family) {
  constexpr std::array<std::string_view, 8> kGeneric = {
      "sans", "sans-serif", "serif", "monospace", "cursive", "fantasy", "system-ui", "emoji"};
  std::string name = family;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (std::ranges::find(kGeneric, name) != kGeneric.end()) return true;
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext context(cairo_create(surface.get()));
  SetFamily(context.get(), family);
  SetFont(context.get(), kCaptionFont, /*bold=*/false);
  cairo_scaled_font_t* font = cairo_get_scaled_font(context.get());
  const auto* face = cairo_ft_scaled_font_lock_face(font);
  // Another family replaces one that is not installed.
  std::string found = face != nullptr && face->family_name != nullptr ? face->family_name : "";
  cairo_ft_scaled_font_unlock_face(font);
  std::ranges::transform(found, found.begin(), [](unsigned char c) { return std::tolower(c); });
  return name == found;
}

std::vector<std::string> WrapCaption(const std::string& caption, double width,
                                     const std::string& family) {
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext context(cairo_create(surface.get()));
  SetFamily(context.get(), family);
  SetFont(context.get(), kCaptionFont, /*bold=*/false);
  const auto fits = [&](const std::string& text) {
    return TextWidth(context.get(), text) <= width;
  };
  std::vector<std::string> lines;
  const auto add = [&](const std::string& text) {
    if (!lines.empty() && fits(lines.back() + " " + text)) {
      lines.back() += " " + text;
    } else {
      lines.push_back(text);
    }
  };
  for (const std::string& clause : Split(caption, kClauseEnd)) {
    if (fits(clause)) {
      add(clause);
    } else {
      for (const std::string& word : Words(clause)) add(word);
    }
  }
  return lines;
}

void DrawCaption(cairo_t* cr, const std::vector<std::string>& lines, double x, double top) {
  SetFont(cr, kCaptionFont, /*bold=*/false);
  SetColor(cr, kInk);
  double base = top;
  for (const std::string& line : lines) {
    base += kLineHeight;
    cairo_move_to(cr, x - TextWidth(cr, line) / 2, base);
    cairo_show_text(cr, line.c_str());
  }
}

std::string DrawWithCaption(const FigureStyle& style, const Eigen::Vector2d& size,
                            const std::string& caption, const std::function<void(cairo_t*)>& draw,
                            double magnification) {
  const std::vector<std::string> lines =
      style.captions ? WrapCaption(caption, size.x(), style.family) : std::vector<std::string>();
  FigurePage page(style.format, size.x(), size.y() + CaptionHeight(lines.size()), magnification,
                  style.family);
  draw(page.context());
  DrawCaption(page.context(), lines, size.x() / 2, size.y());
  return page.Finish();
}

double LabelWidth(cairo_t* cr, const std::string& text) {
  SetFont(cr, kLabelFont, /*bold=*/false);
  return TextWidth(cr, text);
}

void DrawLabel(cairo_t* cr, const std::string& text, const Eigen::Vector2d& base, TextAlign align) {
  const double width = LabelWidth(cr, text);
  SetColor(cr, kInk);
  double left = base.x();
  if (align == TextAlign::kCentre) left -= width / 2;
  if (align == TextAlign::kRight) left -= width;
  cairo_move_to(cr, left, base.y());
  cairo_show_text(cr, text.c_str());
  cairo_new_path(cr);
}

double MarkWidth(cairo_t* cr, const std::string& text) {
  SetFont(cr, kNumberFont, /*bold=*/true);
  return TextWidth(cr, text);
}

void DrawMark(cairo_t* cr, const std::string& text, const Eigen::Vector2d& centre) {
  SetFont(cr, kNumberFont, /*bold=*/true);
  const Eigen::Vector2d begin = CentredText(cr, text, centre);
  cairo_new_path(cr);
  cairo_move_to(cr, begin.x(), begin.y());
  cairo_text_path(cr, text.c_str());
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  Stroke(cr, kWhite, kHalo);
  cairo_move_to(cr, begin.x(), begin.y());
  SetColor(cr, kInk);
  cairo_show_text(cr, text.c_str());
  cairo_new_path(cr);
}

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWhiteRim = 0.5;  ///< width of the rim around a filled marker and its ring, points
constexpr double kOutlineWidth = 0.9;  ///< line width of a hollow marker, points
constexpr double kRingDistance = 1.9;  ///< distance from a marker to its ring, points
constexpr double kRingWidth = 0.8;     ///< line width of a ring, points

/// Visible width of a marker around another one on top, points. A triangle extends to 1.5 radii.
constexpr double kNestedRim = 1.6;

/// A regular polygon with the area of the disc.
struct MarkerShape {
  int corners;   ///< number of corners; 0 for a disc
  double start;  ///< angle of the first corner, radians
};
constexpr std::array<MarkerShape, 5> kShapes = {
    {{0, 0}, {4, kPi / 4}, {3, -kPi / 2}, {4, 0}, {5, -kPi / 2}}};

void AddMarkerPath(cairo_t* cr, const MarkerShape& shape, const Eigen::Vector2d& centre,
                   double radius) {
  if (shape.corners == 0) return SetCircle(cr, centre, radius);
  cairo_new_path(cr);
  const double step = 2 * kPi / shape.corners;
  const double reach = radius * std::sqrt(2 * kPi / (shape.corners * std::sin(step)));
  for (int k = 0; k < shape.corners; ++k) {
    const double angle = shape.start + k * step;
    cairo_line_to(cr, centre.x() + reach * std::cos(angle), centre.y() + reach * std::sin(angle));
  }
  cairo_close_path(cr);
}

}  // namespace

double FingerMarker::reach() const {
  return radius + (ring ? kRingDistance + kRingWidth / 2 + kWhiteRim : 0);
}

void EnlargeCovered(std::span<FingerMarker> markers) {
  for (std::size_t i = markers.size(); i-- > 0;) {
    FingerMarker& below = markers[i];
    for (const FingerMarker& above : markers.subspan(i + 1)) {
      const double distance = (above.centre - below.centre).norm();
      if (distance >= above.reach()) continue;
      below.radius = std::max(below.radius, above.reach() + kNestedRim - distance);
    }
  }
}

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker) {
  const Color own = FingerColor(marker.finger);
  const Color color = marker.style == MarkerStyle::kPale ? Paler(own, kBehindShare) : own;
  if (marker.ring) {
    SetCircle(cr, marker.centre, marker.radius + kRingDistance);
    Stroke(cr, kWhite, kRingWidth + 2 * kWhiteRim);
    SetCircle(cr, marker.centre, marker.radius + kRingDistance);
    Stroke(cr, color, kRingWidth);
  }
  const int count = static_cast<int>(kShapes.size());
  const MarkerShape& shape = kShapes[((marker.finger % count) + count) % count];
  AddMarkerPath(cr, shape, marker.centre, marker.radius);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
  if (marker.style == MarkerStyle::kHollow) {
    FillAndStroke(cr, kWhite, color, kOutlineWidth);
  } else {
    FillWithHalo(cr, color, 2 * kWhiteRim);
  }
}

Color Paler(Color color, double share) {
  const auto mix = [share](unsigned char c) {
    return static_cast<unsigned char>(std::lround(255 - share * (255 - c)));
  };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace regrasp::render
