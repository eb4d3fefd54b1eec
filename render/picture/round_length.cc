#include "render/picture/round_length.h"

#include <cmath>
#include <initializer_list>

namespace regrasp::render {

double RoundLength(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

}  // namespace regrasp::render
