#pragma once

#include <memory>
#include <string>

#include "render/picture/color_table.h"
#include "render/picture/image.h"

namespace regrasp::render {

class CairoImage;

/// What stands above a picture of a contact sheet.
struct SheetLabel {
  std::string title;    ///< at the left: "3  switch"
  std::string verdict;  ///< at the right, in its colour: "pass"
  Color color = kInk;
  bool framed = false;  ///< the picture has a thick frame in that colour
};

/// Of a contact sheet, pixels.
inline constexpr int kSheetWidth = 1600;
inline constexpr int kMinSheetWidth = 200;
inline constexpr int kMaxSheetWidth = 10'000;

/// Sides of a contact sheet's grid and of its cells, pixels.
struct SheetGrid {
  int columns, rows, width, height, gap, label;
  int heading = 0;  ///< height of the line above all pictures
  double font;      ///< of labels

  /// @param sheet_width  the least that it is, where pictures are not enlarged.
  /// @throws std::invalid_argument  a number is not positive.
  SheetGrid(int count, int picture_width, int picture_height, int sheet_width,
            bool has_heading = false);
  [[nodiscard]] int sheet_width() const { return gap + columns * (width + gap); }
  [[nodiscard]] int sheet_height() const { return heading + gap + rows * (label + height + gap); }
  /// The top left corner of a cell.
  [[nodiscard]] int x(int cell) const { return gap + cell % columns * (width + gap); }
  [[nodiscard]] int y(int cell) const {
    return heading + gap + cell / columns * (label + height + gap);
  }
};

/// One image of many pictures in a grid, row by row, each with its label, below a
/// heading: a sequence at a glance.
///
/// The grid is about four thirds as wide as it is high. The more pictures, the smaller they are,
/// but not so small that their labels could not be read: then it is higher. Deterministic.
class ContactSheet {
 public:
  /// @param count          pictures to come, > 0.
  /// @param width, height  of the pictures, pixels.
  /// @param sheet_width    of the sheet, pixels; less where the pictures are smaller.
  /// @param heading        a line above all pictures, in the label's colour; none where empty.
  /// @throws std::invalid_argument  a number is not positive.
  ContactSheet(int count, int width, int height, int sheet_width = kSheetWidth,
               const SheetLabel& heading = {}, const Ground& ground = {});
  ~ContactSheet();

  /// @throws std::invalid_argument  another size than announced, or more pictures.
  void Add(const Image& picture, const SheetLabel& label);

  /// A grey cell with its text, where there is no picture.
  void AddEmpty(const SheetLabel& label, const std::string& text);

  [[nodiscard]] Image ToImage() const;

 private:
  void DrawHeading(const SheetLabel& heading);
  /// Labels the next cell. @returns its index.
  int TakeCell(const SheetLabel& label);
  void DrawPicture(int x, int y, const Image& picture, const SheetLabel& label);

  int count_, width_, height_;
  int added_ = 0;
  SheetGrid grid_;
  Ground ground_;
  std::unique_ptr<CairoImage> sheet_;
};

}  // namespace regrasp::render
