#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"
#include "planner/object/reading.h"
#include "planner/repair/comparison.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

/// The stages of a repair, as they were tried.
struct Attempt {
  double diameter = 0;  ///< of the original
  std::size_t facets_before = 0;
  std::vector<StageReport> stages;
};

/// A solid made from a surface; the last stage made it.
struct Repaired : Attempt {
  object::PolygonSoup solid;  ///< triangles; those that were invented are marked
  double volume = 0;
  Comparison comparison;
};

/// No stage gave a solid that keeps to the limits. `what()` names the file and the cause of which
/// most can be learnt: that there are several solids, what is missing, how far the best was off.
class NotRepaired : public InputError {
 public:
  NotRepaired(const std::string& name, Attempt attempt);
  [[nodiscard]] const Attempt& attempt() const { return attempt_; }

 private:
  Attempt attempt_;
};

/// Makes a solid of a surface that is none, changing it as little as it can: a ladder of stages,
/// each harsher than the one before, until what comes out is a solid that the reader takes and that
/// keeps to the options' limits.
///
/// A surface that is a solid already comes out as it is (stage "read"). Deviation is
/// Comparison::seen_most over the diameter. What an earlier repair marked as invented stays so. The
/// same surface gives the same bytes. With Reading::shells the union of solids beside each other is
/// a solid too, and of several that are left the largest is the part that is taken.
/// @param name  how messages call it.
/// @throws NotRepaired  no stage gives such a solid.
/// @throws TimeUp  the deadline came.
[[nodiscard]] Repaired Repair(const object::PolygonSoup& soup, const std::string& name,
                              const object::RepairOptions& options,
                              const object::Reading& reading = {});

/// A solid of which more than this share of the area was invented is mostly not what was scanned.
inline constexpr double kMostInvented = 0.25;

/// More than this share of thin wall, and a surface was wrapped on both sides.
inline constexpr double kMostThin = 0.1;

/// A part beside another with more than this share of the volume is not dropped unasked.
inline constexpr double kSmallPart = 0.01;

/// Reads a file and repairs what it holds: `repair` and then ReadObject, without the file between.
/// @param text  if not null, RepairText.
/// @throws InputError, TimeUp  as Repair and object::ReadSoup.
[[nodiscard]] object::ObjectFile ReadRepaired(const std::filesystem::path& path,
                                              const object::RepairOptions& options,
                                              const object::Reading& reading,
                                              std::string* text = nullptr);

/// Of a file that is refused, what a repair would make of it: for the end of the message.
[[nodiscard]] std::string RepairHint(const std::filesystem::path& path,
                                     const object::Reading& reading);

/// "15728 facets, 34882 after the repair (clean, wrap); deviation 0.0718 % of the diameter, …".
[[nodiscard]] std::string RepairText(const Repaired& repaired);

/// The report of a repair (docs/formats.md).
[[nodiscard]] Json RepairReport(const Repaired& repaired, const object::SoupFile& file,
                                const object::RepairOptions& options);

/// The report of one that found no solid.
[[nodiscard]] Json RefusalReport(const NotRepaired& refusal, const object::SoupFile& file,
                                 const object::RepairOptions& options);

/// The solid as an OBJ file; invented facets are in the group "invented".
[[nodiscard]] std::string FormatSolid(const object::PolygonSoup& solid);

}  // namespace regrasp::repair
