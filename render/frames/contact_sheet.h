#pragma once

#include <memory>
#include <string>

#include "render/picture/image.h"
#include "render/picture/palette.h"

namespace regrasp::render {

class CairoImage;

/// What stands above a picture of a contact sheet.
struct SheetLabel {
  std::string title;    ///< at the left: "3  switch"
  std::string verdict;  ///< at the right, in its colour: "pass"
  Color color = kInk;
};

/// Sides of a contact sheet's grid and of its cells, pixels.
struct SheetGrid {
  int columns, rows, width, height, gap, label;

  /// @throws std::invalid_argument  a number is not positive.
  SheetGrid(int count, int picture_width, int picture_height);
  [[nodiscard]] int sheet_width() const { return gap + columns * (width + gap); }
  [[nodiscard]] int sheet_height() const { return gap + rows * (label + height + gap); }
};

/// One image of many pictures in a grid, row by row, each with its label: a sequence at a glance.
///
/// The grid is about as wide as it is high; the more pictures, the smaller they are. Deterministic.
class ContactSheet {
 public:
  /// @param count          pictures to come, > 0.
  /// @param width, height  of the pictures, pixels.
  /// @throws std::invalid_argument  a number is not positive.
  ContactSheet(int count, int width, int height);
  ~ContactSheet();

  /// @throws std::invalid_argument  another size than announced, or more pictures.
  void Add(const Image& picture, const SheetLabel& label);

  [[nodiscard]] Image ToImage() const;

 private:
  void DrawLabel(int x, int y, const SheetLabel& label);
  void DrawPicture(int x, int y, const Image& picture);

  int count_, width_, height_;
  int added_ = 0;
  SheetGrid grid_;
  std::unique_ptr<CairoImage> sheet_;
};

}  // namespace regrasp::render
