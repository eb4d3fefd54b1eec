#pragma once

#include <memory>
#include <string>

#include "render/picture/image.h"
#include "render/picture/palette.h"

namespace regrasp::render {

/// What stands above a picture of a contact sheet.
struct SheetLabel {
  std::string title;    ///< at the left: "3  switch"
  std::string verdict;  ///< at the right, in its colour: "pass"
  Color color = kInk;
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
  ContactSheet(const ContactSheet&) = delete;
  ContactSheet& operator=(const ContactSheet&) = delete;

  /// @throws std::invalid_argument  another size than announced, or more pictures.
  void Add(const Image& picture, const SheetLabel& label);

  [[nodiscard]] Image ToImage() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::render
