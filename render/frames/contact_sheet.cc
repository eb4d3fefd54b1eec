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

/// Sides of the grid and of its cells, pixels.
struct Layout {
  int columns, rows, width, height, gap, label;

  Layout(int count, int picture_width, int picture_height)
      : columns(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))))),
        rows((count + columns - 1) / columns),
        width(std::clamp(kSheetWidth / columns, kNarrowest, kWidest)),
        height(Scaled(static_cast<double>(picture_height) / picture_width)),
        gap(Scaled(kGap)),
        label(Scaled(kLabelHeight)) {}

  [[nodiscard]] int sheet_width() const { return gap + columns * (width + gap); }
  [[nodiscard]] int sheet_height() const { return gap + rows * (label + height + gap); }

 private:
  [[nodiscard]] int Scaled(double share) const {
    return std::max(1, static_cast<int>(std::lround(share * width)));
  }
};

void CheckPositive(int count, int width, int height) {
  if (count < 1 || width < 1 || height < 1) {
    throw std::invalid_argument("ContactSheet: a number is not positive");
  }
}

}  // namespace

class ContactSheet::Impl {
 public:
  Impl(int count, int width, int height)
      : count_(count),
        width_(width),
        height_(height),
        layout_(count, width, height),
        sheet_(MakeImage(layout_.sheet_width(), layout_.sheet_height())) {}

  void Add(const Image& picture, const SheetLabel& label) {
    if (picture.width != width_ || picture.height != height_ || added_ == count_) {
      throw std::invalid_argument("ContactSheet: a picture that was not announced");
    }
    const int x = layout_.gap + added_ % layout_.columns * (layout_.width + layout_.gap);
    const int y =
        layout_.gap + added_ / layout_.columns * (layout_.label + layout_.height + layout_.gap);
    DrawLabel(x, y, label);
    DrawPicture(x, y + layout_.label, picture);
    ++added_;
  }

  [[nodiscard]] Image ToImage() const { return sheet_.ToImage(); }

 private:
  void DrawLabel(int x, int y, const SheetLabel& label) {
    cairo_t* cr = sheet_.context();
    const double base = y + kBaseLine * layout_.label;
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(cr, kFontSize * layout_.width);
    SetColor(cr, kInk);
    cairo_move_to(cr, x, base);
    cairo_show_text(cr, label.title.c_str());
    cairo_text_extents_t extents;
    cairo_text_extents(cr, label.verdict.c_str(), &extents);
    SetColor(cr, label.color);
    cairo_move_to(cr, x + layout_.width - extents.x_advance, base);
    cairo_show_text(cr, label.verdict.c_str());
  }

  void DrawPicture(int x, int y, const Image& picture) {
    cairo_t* cr = sheet_.context();
    const CairoImage image(picture);
    cairo_save(cr);
    cairo_translate(cr, x, y);
    cairo_rectangle(cr, 0, 0, layout_.width, layout_.height);
    cairo_clip(cr);
    cairo_scale(cr, static_cast<double>(layout_.width) / width_,
                static_cast<double>(layout_.height) / height_);
    cairo_set_source_surface(cr, image.surface(), 0, 0);
    // Averages pixels where a picture shrinks, and does not fade at its border.
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_GOOD);
    cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD);
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_rectangle(cr, x + kRule / 2, y + kRule / 2, layout_.width - kRule,
                    layout_.height - kRule);
    cairo_set_line_width(cr, kRule);
    SetColor(cr, kRuleColor);
    cairo_stroke(cr);
  }

  int count_, width_, height_;
  int added_ = 0;
  Layout layout_;
  CairoImage sheet_;
};

ContactSheet::ContactSheet(int count, int width, int height) {
  CheckPositive(count, width, height);
  impl_ = std::make_unique<Impl>(count, width, height);
}
ContactSheet::~ContactSheet() = default;

void ContactSheet::Add(const Image& picture, const SheetLabel& label) {
  impl_->Add(picture, label);
}
Image ContactSheet::ToImage() const { return impl_->ToImage(); }

}  // namespace regrasp::render
