#pragma once

namespace regrasp {

/// A unit that lengths are told in.
struct LengthUnit {
  double metres;
  const char* name;  ///< "mm"
};

/// The unit that suits a length of `metres`, told with so many significant digits: the one that
/// FormatLength (quantity_text.h) tells it in.
[[nodiscard]] LengthUnit UnitOfLength(double metres, int digits = 3);

}  // namespace regrasp
