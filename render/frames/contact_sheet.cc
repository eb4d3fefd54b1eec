#include "render/frames/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

/// The narrowest pictures (pixels), and those of a sheet that would be higher than this otherwise:
/// it is wider than asked for then.
constexpr int kNarrow = 190;
constexpr int kNarrowestSheet = 100;
constexpr int kHighest = 12'000;
constexpr double kSheetAspect = 4.0 / 3;

/// The font of labels: a share of the picture's width, but no smaller (pixels), and no larger than
/// this share of the sheet's width.
constexpr double kSheetFontSize = 0.05;
constexpr double kSmallestSheetFont = 11;
constexpr double kLargestFont = 1.0 / 70;

constexpr double kGap = 0.04;         ///< widths of a picture
constexpr double kLabelHeight = 1.5;  ///< font sizes

constexpr double kBaseLine = 0.72;  ///< of a label's height
constexpr double kRule = 1;         ///< pixels, around each picture
constexpr Color kRuleColor = {213, 218, 227};
constexpr double kThickRule = 0.012;  ///< widths of a picture, around one that is framed
constexpr Color kEmpty = {238, 240, 244};
constexpr Color kEmptyText = {112, 120, 134};

/// The heading, in label heights: the line and its font at most.
constexpr double kHeadingHeight = 1.7;
constexpr double kHeadingFont = 1.1;    ///< fonts of labels
constexpr double kSmallestShare = 0.6;  ///< of the font, for a heading that is too wide

/// The text, cut off where it is wider than `most`.
std::string Elide(cairo_t* cr, std::string text, double most) {
  if (TextWidth(cr, text) <= most) return text;
  const auto continues = [&] { return (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80; };
  while (!text.empty() && TextWidth(cr, text + "…") > most) {
    while (text.size() > 1 && continues()) text.pop_back();
    text.pop_back();
  }
  return text + "…";
}

/// The next number above, or that below where it is nearer and leaves fewer cells empty; not one
/// where there are several pictures.
int ChooseColumns(int count, double about) {
  const auto more = static_cast<int>(std::ceil(about));
  const int fewer = more - 1;
  const auto empty = [count](int columns) { return (columns - count % columns) % columns; };
  const bool nearer = about - fewer < more - about;
  return fewer > 1 && nearer && empty(fewer) < empty(more) ? fewer : more;
}

}  // namespace

SheetGrid::SheetGrid(int count, int picture_width, int picture_height, int sheet_width,
                     bool has_heading) {
  if (count < 1 || picture_width < 1 || picture_height < 1 || sheet_width < 1) {
    throw std::invalid_argument("ContactSheet: a number is not positive");
  }
  const double aspect = static_cast<double>(picture_height) / picture_width;
  const auto set_columns = [&](int number) {
    columns = std::clamp(number, 1, count);
    rows = (count + columns - 1) / columns;
    width = std::clamp(static_cast<int>(sheet_width / (columns + (columns + 1) * kGap)),
                       std::min(kNarrowestSheet, picture_width), picture_width);
    height = std::max(1, static_cast<int>(std::lround(aspect * width)));
    gap = std::max(1, static_cast<int>(kGap * width));
    font = std::clamp(kSheetFontSize * width, kSmallestSheetFont,
                      std::max(kSmallestSheetFont, kLargestFont * sheet_width));
    label = static_cast<int>(std::lround(kLabelHeight * font));
    if (has_heading) heading = static_cast<int>(std::lround(kHeadingHeight * label));
  };
  const int wished = ChooseColumns(count, std::sqrt(count * aspect * kSheetAspect));
  set_columns(std::min(wished, std::max(1, sheet_width / kNarrow)));
  while (sheet_height() > kHighest && columns < count) set_columns(columns + 1);
}

ContactSheet::ContactSheet(int count, int width, int height, int sheet_width,
                           const SheetLabel& heading, const Ground& ground)
    : count_(count),
      width_(width),
      height_(height),
      grid_(count, width, height, sheet_width, !heading.title.empty()),
      ground_(ground),
      sheet_(std::make_unique<CairoImage>(MakeImage(grid_.sheet_width(), grid_.sheet_height()))) {
  SetBox(sheet_->context(), {0, 0}, {grid_.sheet_width(), grid_.sheet_height()});
  Fill(sheet_->context(), ground_.paper);
  DrawHeading(heading);
}

ContactSheet::~ContactSheet() = default;

Image ContactSheet::ToImage() const { return sheet_->ToImage(); }

void ContactSheet::Add(const Image& picture, const SheetLabel& label) {
  if (picture.width != width_ || picture.height != height_) {
    throw std::invalid_argument("ContactSheet: a picture of another size");
  }
  const int cell = TakeCell(label);
  DrawPicture(grid_.x(cell), grid_.y(cell) + grid_.label, picture, label);
}

void ContactSheet::AddEmpty(const SheetLabel& label, const std::string& text) {
  const int cell = TakeCell(label);
  const Eigen::Vector2d corner(grid_.x(cell), grid_.y(cell) + grid_.label);
  const Eigen::Vector2d size(grid_.width, grid_.height);
  cairo_t* cr = sheet_->context();
  SetBox(cr, corner, size);
  Fill(cr, kEmpty);
  SelectFont(cr, grid_.font, /*bold=*/false);
  const Eigen::Vector2d begin = CentredText(cr, text, corner + size / 2);
  SetColor(cr, kEmptyText);
  cairo_move_to(cr, begin.x(), begin.y());
  cairo_show_text(cr, text.c_str());
}

void ContactSheet::DrawHeading(const SheetLabel& heading) {
  if (heading.title.empty()) return;
  cairo_t* cr = sheet_->context();
  const double most = grid_.sheet_width() - 2 * grid_.gap;
  const double font = kHeadingFont * grid_.font;
  SelectFont(cr, font, /*bold=*/true);
  const double fits = std::max(kSmallestShare, most / TextWidth(cr, heading.title));
  if (fits < 1) SelectFont(cr, fits * font, /*bold=*/true);
  const std::string title = Elide(cr, heading.title, most);
  SetColor(cr, heading.color);
  cairo_move_to(cr, grid_.gap, kBaseLine * (grid_.heading + grid_.gap));
  cairo_show_text(cr, title.c_str());
}

int ContactSheet::TakeCell(const SheetLabel& label) {
  if (added_ == count_) {
    throw std::invalid_argument("ContactSheet: a picture that was not announced");
  }
  const int x = grid_.x(added_);
  cairo_t* cr = sheet_->context();
  const double base = grid_.y(added_) + kBaseLine * grid_.label;
  SelectFont(cr, grid_.font, /*bold=*/true);
  SetColor(cr, ground_.ink);
  cairo_move_to(cr, x, base);
  cairo_show_text(cr, label.title.c_str());
  SetColor(cr, label.color);
  const double left = grid_.width - TextWidth(cr, label.title) - grid_.font;
  const std::string verdict = Elide(cr, label.verdict, left);
  cairo_move_to(cr, x + grid_.width - TextWidth(cr, verdict), base);
  cairo_show_text(cr, verdict.c_str());
  return added_++;
}

void ContactSheet::DrawPicture(int x, int y, const Image& picture, const SheetLabel& label) {
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
  const double rule = label.framed ? std::max(2.0, kThickRule * grid_.width) : kRule;
  cairo_rectangle(cr, x + rule / 2, y + rule / 2, grid_.width - rule, grid_.height - rule);
  Stroke(cr, label.framed ? label.color : kRuleColor, rule);
}

}  // namespace regrasp::render
