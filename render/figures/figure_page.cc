#include "render/figures/figure_page.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using namespace std::literals;

/// Length of the signature and the header chunk (PNG specification, 5.2 and 5.3).
constexpr std::size_t kEndOfPngHeader = 8 + 4 + 4 + 13 + 4;

std::string SvgMark() { return "<!-- Creator: " + std::string(kFigureMaker) + " -->\n"; }

std::string PdfMark() { return "/Creator (" + std::string(kFigureMaker) + ")"; }

/// A text chunk contains a registered keyword, a zero byte and the text.
std::string PngMark() { return PngChunk("tEXt", "Software"s + '\0' + kFigureMaker); }

}  // namespace

void MarkFigure(FigureFormat format, std::string& bytes) {
  switch (format) {
    case FigureFormat::kSvg:
      bytes.insert(bytes.find('\n') + 1, SvgMark());
      break;
    case FigureFormat::kPng:
      assert(bytes.size() > kEndOfPngHeader);
      bytes.insert(kEndOfPngHeader, PngMark());
      break;
    case FigureFormat::kPdf:
      break;
  }
}

bool IsMarkedFigure(const std::string& bytes) {
  const auto holds = [&](std::string_view beginning, const std::string& mark) {
    return bytes.starts_with(beginning) && bytes.find(mark) != std::string::npos;
  };
  return holds("<?xml"sv, SvgMark()) || holds("%PDF-"sv, PdfMark()) ||
         holds("\x89PNG"sv, PngMark()) ||
         holds("glTF"sv, "\"name\":\"" + std::string(kFigureMaker) + "\"");
}

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

FigurePage::FigurePage(FigureFormat format, double width, double height, double magnification)
    : format_(format),
      bytes_(std::make_unique<std::string>()),
      surface_(MakeSurface(magnification * width, magnification * height)),
      context_(cairo_create(surface_.get())) {
  cairo_t* cr = context_.get();
  Require(cairo_status(cr));
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
  if (format_ == FigureFormat::kSvg) RemoveSurfaceName(*bytes_);
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

void DrawLeader(cairo_t* cr, const Vector2d& name, const Vector2d& owner) {
  const Vector2d direction = owner - name;
  if (direction.norm() < kBeside * kNumberRadius) return;
  const Vector2d from = name + kLeaderStart * kNumberRadius * direction.normalized();
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
  std::vector<Vector2d> centres = PlaceLabels(
      anchors, obstacles, kNumberRadius, static_cast<int>(panel.x()), static_cast<int>(panel.y()));
  for (std::size_t i = 0; i < names.size(); ++i) DrawLeader(cr, centres[i], anchors[i].Owner());
  for (std::size_t i = 0; i < names.size(); ++i) DrawMark(cr, names[i], centres[i]);
  return centres;
}

namespace {

constexpr double kHalo = 1.6;  ///< width of the halo of a mark, points
constexpr char kClauseEnd = ';';

/// Set the font of all pages. It is unhinted, so that SVG, PDF and PNG have the same layout.
void SetFont(cairo_t* cr, double size, bool bold) {
  SelectFont(cr, size, bold, "sans");
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

std::vector<std::string> WrapCaption(const std::string& caption, double width) {
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext context(cairo_create(surface.get()));
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

std::string DrawWithCaption(FigureFormat format, const Eigen::Vector2d& size,
                            const std::string& caption, const std::function<void(cairo_t*)>& draw,
                            double magnification) {
  const std::vector<std::string> lines = WrapCaption(caption, size.x());
  FigurePage page(format, size.x(), size.y() + CaptionHeight(lines.size()), magnification);
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

}  // namespace regrasp::render
