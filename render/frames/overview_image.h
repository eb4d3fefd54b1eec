#pragma once

#include <memory>
#include <string>

#include "render/picture/image.h"

namespace regrasp::render {

class CairoImage;

/// The label above an image of the overview.
struct OverviewLabel {
  std::string title;    ///< text at the left, for example "3 switch"
  std::string verdict;  ///< text at the right in `color`, for example "pass"
  Color color = kInk;
  bool framed = false;  ///< whether the image has a thick frame in `color`
  /// Small text between title and verdict, or at the top left of the image if it does not fit
  /// there; empty for none.
  std::string note = {};
};

/// Default, minimum and maximum width of an overview, pixels.
inline constexpr int kOverviewWidth = 1600;
inline constexpr int kMinOverviewWidth = 200;
inline constexpr int kMaxOverviewWidth = 10'000;

/// Sizes of the grid of an overview and of its cells, pixels.
struct OverviewGrid {
  int columns, rows, width, height, gap, label;
  int heading = 0;  ///< height of the line above all images
  double font;      ///< font size of labels

  /// Compute the grid.
  /// @param total_width  minimum width of the overview, unless images would be enlarged.
  /// @throws std::invalid_argument  if a number is not positive.
  OverviewGrid(int count, int image_width, int image_height, int total_width,
               bool has_heading = false);
  [[nodiscard]] int total_width() const { return gap + columns * (width + gap); }
  [[nodiscard]] int total_height() const { return heading + gap + rows * (label + height + gap); }
  /// Coordinates of the top left corner of a cell.
  [[nodiscard]] int x(int cell) const { return gap + cell % columns * (width + gap); }
  [[nodiscard]] int y(int cell) const {
    return heading + gap + cell / columns * (label + height + gap);
  }
};

/// An overview: one image with many labelled images in a grid, row by row, below a heading.
///
/// The aspect ratio of the grid is about 4:3. Images shrink with their number only as long as
/// labels stay readable; beyond that the grid becomes higher. Deterministic.
class OverviewImage {
 public:
  /// Create an empty overview.
  /// @param count          number of images, > 0.
  /// @param width, height  size of the images, pixels.
  /// @param total_width    width of the overview, pixels; less if the images are smaller.
  /// @param heading        line above all images in the colour of the label; empty for none.
  /// @throws std::invalid_argument  if a number is not positive.
  OverviewImage(int count, int width, int height, int total_width = kOverviewWidth,
                const OverviewLabel& heading = {}, const Ground& ground = {});
  ~OverviewImage();

  /// Add an image in the next cell.
  /// @throws std::invalid_argument  if the size differs, or if there are more than `count` images.
  void Add(const Image& image, const OverviewLabel& label);

  /// Add a grey cell with a text instead of an image.
  void AddEmpty(const OverviewLabel& label, const std::string& text);

  [[nodiscard]] Image ToImage() const;

  /// Return the size of the texts of frames (FrameText::size) that are readable in this overview.
  [[nodiscard]] double TextSize() const;

 private:
  void DrawHeading(const OverviewLabel& heading);
  /// Draw the label of the next cell and return its index.
  /// @param label  its note becomes empty if it is drawn.
  int TakeCell(OverviewLabel& label);
  void DrawImage(int x, int y, const Image& image, const OverviewLabel& label);
  void DrawNote(int x, int y, const std::string& note);

  int count_, width_, height_;
  int added_ = 0;
  OverviewGrid grid_;
  Ground ground_;
  std::unique_ptr<CairoImage> image_;
};

}  // namespace regrasp::render
