#include "render/frames/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/picture/cairo_image.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

/// Pictures are as wide as lets the sheet be about this wide, within these bounds (pixels).
constexpr int kSheetWidth = 2400;
constexpr int kNarrowest = 120;
constexpr int kWidest = 480;

/// In widths of a picture.
constexpr double kGap = 0.04;
constexpr double kLabelHeight = 0.075;
constexpr double kFontSize = 0.05;

constexpr double kBaseLine = 0.72;  ///< of a label's height
constexpr double kRule = 1;         ///< pixels, around each picture
constexpr Color kRuleColor = {213, 218, 227};

}  // namespace

SheetGrid::SheetGrid(int count, int picture_width, int picture_height) {
  if (count < 1 || picture_width < 1 || picture_height < 1) {
    throw std::invalid_argument("ContactSheet: a number is not positive");
  }
  columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  rows = (count + columns - 1) / columns;
  width = std::clamp(kSheetWidth / columns, kNarrowest, kWidest);
  const auto scaled = [&](double share) {
    return std::max(1, static_cast<int>(std::lround(share * width)));
  };
  height = scaled(static_cast<double>(picture_height) / picture_width);
  gap = scaled(kGap);
  label = scaled(kLabelHeight);
}

ContactSheet::ContactSheet(int count, int width, int height)
    : count_(count),
      width_(width),
      height_(height),
      grid_(count, width, height),
      sheet_(std::make_unique<CairoImage>(MakeImage(grid_.sheet_width(), grid_.sheet_height()))) {}

ContactSheet::~ContactSheet() = default;

Image ContactSheet::ToImage() const { return sheet_->ToImage(); }

void ContactSheet::Add(const Image& picture, const SheetLabel& label) {
  if (picture.width != width_ || picture.height != height_ || added_ == count_) {
    throw std::invalid_argument("ContactSheet: a picture that was not announced");
  }
  const int x = grid_.gap + added_ % grid_.columns * (grid_.width + grid_.gap);
  const int y = grid_.gap + added_ / grid_.columns * (grid_.label + grid_.height + grid_.gap);
  DrawLabel(x, y, label);
  DrawPicture(x, y + grid_.label, picture);
  ++added_;
}

void ContactSheet::DrawLabel(int x, int y, const SheetLabel& label) {
  cairo_t* cr = sheet_->context();
  const double base = y + kBaseLine * grid_.label;
  SelectFont(cr, kFontSize * grid_.width, /*bold=*/true);
  SetColor(cr, kInk);
  cairo_move_to(cr, x, base);
  cairo_show_text(cr, label.title.c_str());
  SetColor(cr, label.color);
  cairo_move_to(cr, x + grid_.width - TextWidth(cr, label.verdict), base);
  cairo_show_text(cr, label.verdict.c_str());
}

void ContactSheet::DrawPicture(int x, int y, const Image& picture) {
  cairo_t* cr = sheet_->context();
  const CairoImage image(picture);
  cairo_save(cr);
  cairo_translate(cr, x, y);
  cairo_rectangle(cr, 0, 0, grid_.width, grid_.height);
  cairo_clip(cr);
  cairo_scale(cr, static_cast<double>(grid_.width) / width_,
              static_cast<double>(grid_.height) / height_);
  cairo_set_source_surface(cr, image.surface(), 0, 0);
  // Averages pixels where a picture shrinks, and does not fade at its border.
  cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_GOOD);
  cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD);
  cairo_paint(cr);
  cairo_restore(cr);
  cairo_rectangle(cr, x + kRule / 2, y + kRule / 2, grid_.width - kRule, grid_.height - kRule);
  cairo_set_line_width(cr, kRule);
  SetColor(cr, kRuleColor);
  cairo_stroke(cr);
}

}  // namespace regrasp::render
