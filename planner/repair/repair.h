#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"
#include "planner/repair/comparison.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

/// Executed stages of a repair.
struct Attempt {
  double diameter = 0;  ///< diameter of the original
  std::size_t facets_before = 0;
  std::vector<StageReport> stages;
};

/// Solid made from a surface by the last of the stages.
struct Repaired : Attempt {
  object::PolygonSoup solid;  ///< triangles, with marks of filled surface
  double volume = 0;
  Comparison comparison;
};

/// Error: no stage gives a solid that satisfies the limits.
/// `what()` names the file and the most informative cause: several solids, missing surface, or the
/// deviation of the best solid.
class NotRepaired : public InputError {
 public:
  NotRepaired(const std::string& name, Attempt attempt);
  [[nodiscard]] const Attempt& attempt() const { return attempt_; }

 private:
  Attempt attempt_;
};

/// Repair a surface so that it bounds a solid, with as little change as possible.
/// The stages run in order of increasing change. A solid is valid if the reader accepts it and it
/// satisfies the limits in `options`. The repair ends at the first valid solid that is close to the
/// original; without such a solid it returns the closest valid one.
///
/// A surface that already bounds a solid is returned unchanged (stage "read"). The deviation is
/// Comparison::seen_most over the diameter. Marks of filled surface from an earlier repair are
/// kept. Equal surfaces give equal bytes. `reading.shells` applies as follows: with Shells::kUnion
/// several separate solids are accepted; with Shells::kLargest the largest solid is taken unless
/// `options.part` selects another.
/// @param name  name of the surface in messages.
/// @throws NotRepaired  if no stage gives such a solid.
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] Repaired Repair(const object::PolygonSoup& soup, const std::string& name,
                              const object::RepairOptions& options,
                              const object::Reading& reading = {});

/// Largest accepted share of filled surface. Beyond it too little of the object was scanned.
inline constexpr double kMostFilled = 0.25;

/// Share of thin wall beyond which the solid is an open surface wrapped on both sides.
inline constexpr double kMostThin = 0.1;

/// Volume share beyond which the second largest solid is not dropped without `options.part`.
inline constexpr double kSmallPart = 0.01;

/// Read a file and repair its surface.
/// The result equals that of `repair` followed by ReadObject on its output file.
/// @param text  receives RepairText if not null.
/// @throws InputError, TimeUp  as Repair and object::ReadSoup.
[[nodiscard]] object::ObjectFile ReadRepaired(const std::filesystem::path& path,
                                              const object::RepairOptions& options,
                                              const object::Reading& reading,
                                              std::string* text = nullptr);

/// Describe what a repair of a rejected file gives, as a suffix of the error message.
[[nodiscard]] std::string RepairHint(const std::filesystem::path& path,
                                     const object::Reading& reading);

/// Summarize a repair in one line.
/// Example: "15728 facets, 34882 after the repair (clean, wrap); deviation 0.0718 % of the
/// diameter, …".
[[nodiscard]] std::string RepairText(const Repaired& repaired);

/// Return the report of a repair (docs/formats.md).
[[nodiscard]] Json RepairReport(const Repaired& repaired, const object::SoupFile& file,
                                const object::RepairOptions& options);

/// Return the report of a repair that gives no solid.
[[nodiscard]] Json RefusalReport(const NotRepaired& refusal, const object::SoupFile& file,
                                 const object::RepairOptions& options);

/// Format a solid as an OBJ file. Filled surface is in the group "invented".
[[nodiscard]] std::string FormatSolid(const object::PolygonSoup& solid);

}  // namespace regrasp::repair
