#include "planner/base/number.h"
#include "planner/repair/repair.h"

namespace regrasp::repair {

std::string FormatSolid(const object::PolygonSoup& solid) {
  std::string text = "# a solid that was repaired\n";
  for (const auto& v : solid.vertices) {
    text +=
        "v " + FormatDouble(v.x()) + " " + FormatDouble(v.y()) + " " + FormatDouble(v.z()) + "\n";
  }
  for (const bool invented : {false, true}) {
    bool named = false;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      if ((!solid.invented.empty() && solid.invented[f]) != invented) continue;
      if (!named) text += invented ? "g invented\n" : "g original\n";
      named = true;
      text += "f";
      for (const int v : solid.facets[f]) text += " " + std::to_string(v + 1);
      text += "\n";
    }
  }
  return text;
}

}  // namespace regrasp::repair
