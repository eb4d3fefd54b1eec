#include "render/picture/palette.h"

#include <array>

namespace regrasp::render {

Color FingerColor(FingerIndex finger) {
  static constexpr std::array<Color, 5> kColors = {{
      {0, 101, 165},   // blue
      {240, 176, 0},   // amber
      {61, 179, 158},  // teal
      {136, 34, 85},   // wine
      {208, 88, 0},    // vermilion
  }};
  const int size = static_cast<int>(kColors.size());
  return kColors[((finger % size) + size) % size];
}

}  // namespace regrasp::render
