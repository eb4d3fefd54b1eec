#include "render/frames/overview_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/frames/annotation.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

/// Minimum widths of images (pixels), also for an overview that would otherwise exceed the maximum
/// height. The overview is then wider than requested.
constexpr int kNarrowColumn = 190;
constexpr int kNarrowestImage = 100;
constexpr int kHighest = 12'000;
constexpr double kOverviewAspect = 4.0 / 3;

/// Font size of labels per image width, its minimum (pixels), and its maximum per width of the
/// overview.
constexpr double kOverviewFontSize = 0.05;
constexpr double kSmallestOverviewFont = 11;
constexpr double kLargestFont = 1.0 / 70;

/// Font size of texts in images per font size of labels, and the maximum of FrameText::size.
constexpr double kTextPerLabel = 0.8;
constexpr double kLargestText = 2.5;

constexpr double kGap = 0.04;         ///< gap between images per width of an image
constexpr double kLabelHeight = 1.5;  ///< height of a label per font size

constexpr double kBaseLine = 0.72;  ///< position of the baseline per height of a label
constexpr double kRule = 1;         ///< width of the border of each image, pixels
constexpr Color kRuleColor = {213, 218, 227};
/// Font size of a note, its distance from the corner of the image, and its halo, per font size of
/// labels.
constexpr double kNoteFont = 0.85;
constexpr double kNoteMargin = 0.6;
constexpr double kNoteHalo = 0.3;
constexpr double kThickRule = 0.012;  ///< width of a thick frame per width of an image
constexpr Color kEmpty = {238, 240, 244};
constexpr Color kEmptyText = {112, 120, 134};

/// Height of the heading per height of a label.
constexpr double kHeadingHeight = 1.7;
constexpr double kHeadingFont = 1.1;    ///< font size of the heading per font size of labels
constexpr double kSmallestShare = 0.6;  ///< minimum factor on the font size of a long heading

/// Truncate a text to the width `most`.
std::string Elide(cairo_t* cr, std::string text, double most) {
  if (TextWidth(cr, text) <= most) return text;
  const auto continues = [&] { return (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80; };
  while (!text.empty() && TextWidth(cr, text + "…") > most) {
    while (text.size() > 1 && continues()) text.pop_back();
    text.pop_back();
  }
  return text + "…";
}

/// Round up the number of columns, or down if that is nearer and leaves fewer empty cells. Several
/// images never have a single column.
int ChooseColumns(int count, double about) {
  const auto more = static_cast<int>(std::ceil(about));
  const int fewer = more - 1;
  const auto empty = [count](int columns) { return (columns - count % columns) % columns; };
  const bool nearer = about - fewer < more - about;
  return fewer > 1 && nearer && empty(fewer) < empty(more) ? fewer : more;
}

}  // namespace

OverviewGrid::OverviewGrid(int count, int image_width, int image_height, int total_width,
                           bool has_heading) {
  if (count < 1 || image_width < 1 || image_height < 1 || total_width < 1) {
    throw std::invalid_argument("OverviewImage: every number must be positive");
  }
  const double aspect = static_cast<double>(image_height) / image_width;
  const auto set_columns = [&](int number) {
    columns = std::clamp(number, 1, count);
    rows = (count + columns - 1) / columns;
    width = std::clamp(static_cast<int>(total_width / (columns + (columns + 1) * kGap)),
                       std::min(kNarrowestImage, image_width), image_width);
    height = std::max(1, static_cast<int>(std::lround(aspect * width)));
    gap = std::max(1, static_cast<int>(kGap * width));
    font = std::clamp(kOverviewFontSize * width, kSmallestOverviewFont,
                      std::max(kSmallestOverviewFont, kLargestFont * total_width));
    label = static_cast<int>(std::lround(kLabelHeight * font));
    if (has_heading) heading = static_cast<int>(std::lround(kHeadingHeight * label));
  };
  const int wished = ChooseColumns(count, std::sqrt(count * aspect * kOverviewAspect));
  set_columns(std::min(wished, std::max(1, total_width / kNarrowColumn)));
  while (total_height() > kHighest && columns < count) set_columns(columns + 1);
}

OverviewImage::OverviewImage(int count, int width, int height, int total_width,
                             const OverviewLabel& heading, const Ground& ground)
    : count_(count),
      width_(width),
      height_(height),
      grid_(count, width, height, total_width, !heading.title.empty()),
      ground_(ground),
      image_(std::make_unique<CairoImage>(MakeImage(grid_.total_width(), grid_.total_height()))) {
  SetBox(image_->context(), {0, 0}, {grid_.total_width(), grid_.total_height()});
  Fill(image_->context(), ground_.paper);
  DrawHeading(heading);
}

OverviewImage::~OverviewImage() = default;

Image OverviewImage::ToImage() const { return image_->ToImage(); }

double OverviewImage::TextSize() const {
  const double shown = FontSize(width_, height_) * grid_.width / width_;
  return std::clamp(kTextPerLabel * grid_.font / shown, 1.0, kLargestText);
}

void OverviewImage::Add(const Image& image, const OverviewLabel& label) {
  if (image.width != width_ || image.height != height_) {
    throw std::invalid_argument("OverviewImage: all images must have the announced size");
  }
  OverviewLabel left = label;
  const int cell = TakeCell(left);
  DrawImage(grid_.x(cell), grid_.y(cell) + grid_.label, image, left);
}

void OverviewImage::AddEmpty(const OverviewLabel& label, const std::string& text) {
  OverviewLabel left = label;
  const int cell = TakeCell(left);
  const Eigen::Vector2d corner(grid_.x(cell), grid_.y(cell) + grid_.label);
  const Eigen::Vector2d size(grid_.width, grid_.height);
  cairo_t* cr = image_->context();
  SetBox(cr, corner, size);
  Fill(cr, kEmpty);
  SelectFont(cr, grid_.font, /*bold=*/false);
  const Eigen::Vector2d begin = CentredText(cr, text, corner + size / 2);
  SetColor(cr, kEmptyText);
  cairo_move_to(cr, begin.x(), begin.y());
  cairo_show_text(cr, text.c_str());
}

void OverviewImage::DrawHeading(const OverviewLabel& heading) {
  if (heading.title.empty()) return;
  cairo_t* cr = image_->context();
  const double most = grid_.total_width() - 2 * grid_.gap;
  const double font = kHeadingFont * grid_.font;
  SelectFont(cr, font, /*bold=*/true);
  const double fits = std::max(kSmallestShare, most / TextWidth(cr, heading.title));
  if (fits < 1) SelectFont(cr, fits * font, /*bold=*/true);
  const std::string title = Elide(cr, heading.title, most);
  SetColor(cr, heading.color);
  cairo_move_to(cr, grid_.gap, kBaseLine * (grid_.heading + grid_.gap));
  cairo_show_text(cr, title.c_str());
}

int OverviewImage::TakeCell(OverviewLabel& label) {
  if (added_ == count_) {
    throw std::invalid_argument("OverviewImage: more images than the announced number");
  }
  const int x = grid_.x(added_);
  cairo_t* cr = image_->context();
  const double base = grid_.y(added_) + kBaseLine * grid_.label;
  SelectFont(cr, grid_.font, /*bold=*/true);
  SetColor(cr, ground_.ink);
  cairo_move_to(cr, x, base);
  cairo_show_text(cr, label.title.c_str());
  SetColor(cr, label.color);
  const double begin = TextWidth(cr, label.title) + grid_.font;
  const std::string verdict = Elide(cr, label.verdict, grid_.width - begin);
  const double end = grid_.width - TextWidth(cr, verdict);
  cairo_move_to(cr, x + end, base);
  cairo_show_text(cr, verdict.c_str());
  SelectFont(cr, kNoteFont * grid_.font, /*bold=*/false);
  if (!label.note.empty() && begin + TextWidth(cr, label.note) + grid_.font < end) {
    SetColor(cr, ground_.ink);
    cairo_move_to(cr, x + begin, base);
    cairo_show_text(cr, label.note.c_str());
    label.note.clear();
  }
  return added_++;
}

void OverviewImage::DrawImage(int x, int y, const Image& image, const OverviewLabel& label) {
  cairo_t* cr = image_->context();
  const CairoImage source(image);
  cairo_save(cr);
  cairo_translate(cr, x, y);
  cairo_rectangle(cr, 0, 0, grid_.width, grid_.height);
  cairo_clip(cr);
  cairo_scale(cr, static_cast<double>(grid_.width) / width_,
              static_cast<double>(grid_.height) / height_);
  cairo_set_source_surface(cr, source.surface(), 0, 0);
  // Averages pixels when images shrink, without fading at their borders.
  cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_GOOD);
  cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD);
  cairo_paint(cr);
  cairo_restore(cr);
  const double rule = label.framed ? std::max(2.0, kThickRule * grid_.width) : kRule;
  cairo_rectangle(cr, x + rule / 2, y + rule / 2, grid_.width - rule, grid_.height - rule);
  Stroke(cr, label.framed ? label.color : kRuleColor, rule);
  DrawNote(x, y, label.note);
}

void OverviewImage::DrawNote(int x, int y, const std::string& note) {
  if (note.empty()) return;
  cairo_t* cr = image_->context();
  const double margin = kNoteMargin * grid_.font;
  SelectFont(cr, kNoteFont * grid_.font, /*bold=*/false);
  cairo_move_to(cr, x + margin, y + margin + kNoteFont * grid_.font);
  cairo_text_path(cr, Elide(cr, note, grid_.width - 2 * margin).c_str());
  FillWithHalo(cr, ground_.ink, kNoteHalo * grid_.font, ground_.halo);
}

}  // namespace regrasp::render
