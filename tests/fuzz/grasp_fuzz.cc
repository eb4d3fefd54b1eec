// Fuzz target: any bytes as a grasp file of a tetrahedron and of a square. The result must be
// contacts on the surface or a one-line error.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/plan/grasp_io.h"
#include "small_objects.h"

namespace {

using namespace regrasp;

/// The contacts are on the object, so the written file is read back as the same bytes.
void ReadTwice(std::string_view text, const object::Object& object) {
  const grasp::Grasp grasp = plan::ParseGrasp(text, kHostileName, object);
  for (const grasp::Contact& contact : grasp) {
    if (contact.face < 0 || contact.face >= object.face_count()) ReportFinding("a contact off");
    if (!contact.p.allFinite()) ReportFinding("a contact at no finite point");
  }
  const std::string written = plan::FormatGrasp(grasp, object.dimension());
  if (plan::FormatGrasp(plan::ParseGrasp(written, kHostileName, object), object.dimension()) !=
      written) {
    ReportFinding("a grasp that was written reads back as another");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ReadHostileInput([&] { ReadTwice(text, SmallSolid()); });
  ReadHostileInput([&] { ReadTwice(text, SmallPolygon()); });
  return 0;
}
