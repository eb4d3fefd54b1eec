#include "render/picture/cairo_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace regrasp::render {

CairoImage::CairoImage(const Image& image)
    : width_(image.width),
      height_(image.height),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_)),
      context_(cairo_create(surface_.get())) {
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(cairo_status_to_string(cairo_status(context_.get())));
  }
  const unsigned char* in = image.rgb.data();
  for (int y = 0; y < height_; ++y) {
    std::uint32_t* out = Row(y);
    for (int x = 0; x < width_; ++x, in += 3) {
      out[x] = std::uint32_t{in[0]} << 16 | std::uint32_t{in[1]} << 8 | in[2];
    }
  }
  cairo_surface_mark_dirty(surface_.get());
}

Image CairoImage::ToImage() const {
  cairo_surface_flush(surface_.get());
  Image image = MakeImage(width_, height_);
  unsigned char* out = image.rgb.data();
  for (int y = 0; y < height_; ++y) {
    const std::uint32_t* in = Row(y);
    for (int x = 0; x < width_; ++x) {
      for (const int shift : {16, 8, 0}) *out++ = static_cast<unsigned char>(in[x] >> shift);
    }
  }
  return image;
}

std::uint32_t* CairoImage::Row(int y) const {
  unsigned char* data = cairo_image_surface_get_data(surface_.get());
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface_.get());
  return reinterpret_cast<std::uint32_t*>(data + y * stride);
}

using Eigen::Vector2d;

namespace {

/// Ratio of half the width of an arrow head to its length.
constexpr double kHeadSlope = 0.42;

constexpr double kDotRim = 0.7;  ///< width of the rim of a dot, points

}  // namespace

void SetColor(cairo_t* cr, Color color, double opacity) {
  constexpr double kMax = 255;
  if (opacity < 1) {
    cairo_set_source_rgba(cr, color.r / kMax, color.g / kMax, color.b / kMax, opacity);
  } else {
    cairo_set_source_rgb(cr, color.r / kMax, color.g / kMax, color.b / kMax);
  }
}

void SetBox(cairo_t* cr, const Vector2d& corner, const Vector2d& size) {
  cairo_new_path(cr);
  cairo_rectangle(cr, corner.x(), corner.y(), size.x(), size.y());
}

void SetCircle(cairo_t* cr, const Vector2d& centre, double radius) {
  cairo_new_path(cr);
  cairo_arc(cr, centre.x(), centre.y(), radius, 0, 2 * std::numbers::pi);
}

void Fill(cairo_t* cr, Color color, double opacity) {
  SetColor(cr, color, opacity);
  cairo_fill(cr);
}

void Stroke(cairo_t* cr, Color color, double width) {
  SetColor(cr, color);
  cairo_set_line_width(cr, width);
  cairo_stroke(cr);
}

void FillAndStroke(cairo_t* cr, Color fill, Color border, double width) {
  SetColor(cr, fill);
  cairo_fill_preserve(cr);
  Stroke(cr, border, width);
}

void FillWithHalo(cairo_t* cr, Color color, double halo, Color halo_color) {
  SetColor(cr, halo_color);
  cairo_set_line_width(cr, halo);
  cairo_stroke_preserve(cr);
  Fill(cr, color);
}

void DrawDot(cairo_t* cr, const Vector2d& at, double radius) {
  SetCircle(cr, at, radius + kDotRim);
  Fill(cr, kWhite);
  SetCircle(cr, at, radius);
  Fill(cr, kInk);
}

void DrawHatch(cairo_t* cr, const Vector2d& corner, const Vector2d& size, const Hatch& hatch,
               Color color) {
  const Vector2d end = corner + size;
  const double run = (end.y() - corner.y()) / hatch.slope;
  cairo_new_path(cr);
  for (double x = corner.x() - run; x < end.x();
       x += hatch.spacing * std::hypot(1.0, 1 / hatch.slope)) {
    cairo_move_to(cr, x, end.y());
    cairo_line_to(cr, x + run, corner.y());
  }
  Stroke(cr, color, hatch.width);
}

void SelectFont(cairo_t* cr, double size, bool bold, const char* family) {
  cairo_select_font_face(cr, family, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
}

double TextWidth(cairo_t* cr, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

namespace {

/// Split a text at spaces, but not between a number and its unit.
std::vector<std::string> SplitWords(const std::string& text) {
  constexpr std::array<std::string_view, 9> kUnits = {"nm", "µm", "mm",  "cm", "m",
                                                      "km", "N",  "N·m", "%"};
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    const std::string bare = word.substr(0, word.find_first_of(",;:."));
    const bool is_unit = std::ranges::find(kUnits, bare) != kUnits.end();
    if (is_unit && !words.empty() && words.back().back() >= '0' && words.back().back() <= '9') {
      words.back() += " " + word;
    } else {
      words.push_back(word);
    }
  }
  return words;
}

}  // namespace

std::vector<std::string> BreakLines(cairo_t* cr, const std::string& text, double most) {
  std::vector<std::string> lines(1);
  for (const std::string& word : SplitWords(text)) {
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

Vector2d CentredText(cairo_t* cr, const std::string& text, const Vector2d& centre) {
  cairo_text_extents_t e;
  cairo_text_extents(cr, text.c_str(), &e);
  return {centre.x() - e.x_bearing - e.width / 2, centre.y() - e.y_bearing - e.height / 2};
}

void AddOutline(cairo_t* cr, std::span<const Vector2d> points) {
  cairo_new_sub_path(cr);
  for (const Vector2d& p : points) cairo_line_to(cr, p.x(), p.y());
  cairo_close_path(cr);
}

void StrokeLine(cairo_t* cr, const Vector2d& a, const Vector2d& b, double width) {
  cairo_new_path(cr);
  cairo_move_to(cr, a.x(), a.y());
  cairo_line_to(cr, b.x(), b.y());
  cairo_set_line_width(cr, width);
  cairo_stroke(cr);
}

void StrokeArrow(cairo_t* cr, std::span<const Vector2d> path, double width) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  if (!(length > 0)) return;
  const double head = std::min(kArrowHead, length);
  // The shaft ends inside the head, so path points within the head are omitted.
  const Vector2d& tip = path.back();
  std::size_t last = path.size() - 1;
  while (last > 0 && (path[last - 1] - tip).norm() < head) --last;
  const Vector2d& from = path[last == 0 ? 0 : last - 1];
  const Vector2d direction = (tip - from).normalized();
  const Vector2d base = tip - head * direction;
  cairo_new_path(cr);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(cr, width);
  for (std::size_t i = 0; i < last; ++i) cairo_line_to(cr, path[i].x(), path[i].y());
  cairo_line_to(cr, base.x(), base.y());
  cairo_stroke(cr);
  const Vector2d side = kHeadSlope * head * Vector2d(-direction.y(), direction.x());
  const std::vector<Vector2d> triangle = {tip, base + side, base - side};
  AddOutline(cr, triangle);
  cairo_fill(cr);
}

void DrawArrow(cairo_t* cr, std::span<const Vector2d> path, double width, Color color, Color halo) {
  constexpr double kHaloWidth = 1.9;
  // Arrow heads have a fixed size, so the coordinate system is scaled instead.
  std::vector<Vector2d> scaled(path.begin(), path.end());
  for (Vector2d& p : scaled) p /= width;
  cairo_save(cr);
  cairo_scale(cr, width, width);
  SetColor(cr, halo);
  StrokeArrow(cr, scaled, kHaloWidth);
  SetColor(cr, color);
  StrokeArrow(cr, scaled, 1);
  cairo_restore(cr);
}

}  // namespace regrasp::render
