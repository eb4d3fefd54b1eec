#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/plan.h"
#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// Return the head of a column.
/// @param style  class, "number" (aligned right) or none.
[[nodiscard]] Element HeadCell(std::string_view name, std::string_view style = "number");

/// Return the heads of columns of numbers.
[[nodiscard]] std::vector<Element> HeadCells(const std::vector<std::string_view>& names);

[[nodiscard]] Element NumberCell(std::string_view text);

/// Return a cell with the name of its column, which cards of narrow screens show.
[[nodiscard]] Element NamedCell(std::string_view name, std::string_view text);

/// Return a table that scrolls by itself if it is wider than the page.
/// @param head  cells of the first row.
/// @param rows   elements tr.
/// @param style  classes of the table; may be empty. On narrow screens, "cards" (for the table of
///     steps) and "pairs" (for tables of NamedCell) show a card per row. With "narrow" the table is
///     only as wide as its content.
[[nodiscard]] Element ScrolledTable(const std::vector<Element>& head,
                                    const std::vector<Element>& rows, std::string_view style = "");

/// Return an image with its caption, which starts with a name in bold.
[[nodiscard]] Element Figure(const Attributes& attributes, const Element& picture,
                             std::string_view name, const std::string& text);

/// Return a note for readers of a table or of images.
[[nodiscard]] Element Note(std::string_view text);

/// Return a number with three significant digits: "0.364", "2120", "4.7 × 10⁻⁶".
/// Trailing zeros after the decimal point are omitted. A value that is not finite is "–".
[[nodiscard]] std::string NumberText(double value);

/// Return a length in a suitable unit (FormatLength) on one line: "4.1 µm", "10.4 cm".
/// It is "0" below a tenth of a nanometre and "–" if it is not finite.
[[nodiscard]] std::string LengthText(double metres);

/// Measures of each entry of a report, for plots and tables; none if an entry has none.
struct StepMeasures {
  /// Largest |Δx| + R |Δrotation| of the object, metres, which the tolerance limits.
  std::optional<double> moved_m;
  std::optional<double> slip_m;  ///< largest slip of a holding finger
  /// Deviation of the object and slip in percent of their limits, in a replay by a hand. The object
  /// has the largest percentage of its displacement and rotation, also in the static grasp.
  std::optional<double> deviation_percent, slip_percent;
  /// Friction margin: friction angle minus the required one, degrees; negative if it is too small.
  std::optional<double> margin_deg;
  /// Force margin in the static grasp after the step, degrees: friction angle minus the largest
  /// angle between the force of a holding finger and its normal.
  std::optional<double> static_margin_deg;
};

[[nodiscard]] std::vector<StepMeasures> MeasureSteps(const Report& report);

/// Return the title of an entry with an upper-case first letter: "Switch: place 4, release 0".
[[nodiscard]] std::string StepTitle(const plan::Plan& plan, plan::EntryIndex index,
                                    std::span<const std::string> finger_names = {});

/// Return the name of an entry in a sentence: "the hold", "step 3".
[[nodiscard]] std::string StepName(plan::EntryIndex index);

/// Return the sentences on cause and remedy of a failure, each on a new line; empty without them.
[[nodiscard]] std::string CauseAndFix(const std::string& why, const std::string& suggested_fix);

/// Return the text with an upper-case first letter if that is an ASCII letter.
[[nodiscard]] std::string Capitalized(std::string text);

/// Return a table with one line per entry of a report, and a note that explains its columns.
/// A line has the description, required friction and friction margin, displacement and slip in the
/// replay, and the verdict.
/// @param measures  measures of each entry (MeasureSteps).
/// @param anchors   id of the image of each entry in the page; empty if there is none.
/// @param finger_names  names of fingers by index; other fingers have their number.
[[nodiscard]] std::vector<Element> MakeStepTable(const Report& report, const plan::Plan& plan,
                                                 const std::vector<StepMeasures>& measures,
                                                 const std::vector<std::string>& anchors,
                                                 std::span<const std::string> finger_names = {});

/// Return a table of the friction that each finger of a single grasp requires; empty if unknown.
[[nodiscard]] std::vector<Element> MakeFingerTable(const Report& report);

}  // namespace regrasp::report
