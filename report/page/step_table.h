#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/plan.h"
#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// A column's head; numbers stand to the right.
/// @param style  classes, "number" or "number minor"; may be empty.
[[nodiscard]] Element HeadCell(std::string_view name, std::string_view style = "number");

/// Heads of columns of numbers.
[[nodiscard]] std::vector<Element> HeadCells(const std::vector<std::string_view>& names);

[[nodiscard]] Element NumberCell(std::string_view text);

/// A table that is scrolled by itself where it is wider than the page.
/// @param head  cells of the first row.
/// @param rows  elements tr.
[[nodiscard]] Element ScrolledTable(const std::vector<Element>& head,
                                    const std::vector<Element>& rows);

/// A picture with its caption, which begins with a name in bold.
[[nodiscard]] Element Figure(const Attributes& attributes, const Element& picture,
                             std::string_view name, const std::string& text);

/// What a reader of a table or of pictures has to know.
[[nodiscard]] Element Note(std::string_view text);

/// A number for people, three significant digits: "0.364", "2120", "4.7 × 10⁻⁶". Trailing zeros
/// behind the point are left out. What is not finite is "–".
[[nodiscard]] std::string NumberText(double value);

/// A length in the unit that suits it (FormatLength), on one line: "4.1 µm", "10.4 cm"; "0" below a
/// tenth of a nanometre, "–" where it is not finite.
[[nodiscard]] std::string LengthText(double metres);

/// Numbers of each entry of a report, none where it has none; what plots and tables show.
struct StepMeasures {
  /// Largest |Δx| + R |Δrotation| of the object, metres: what the tolerance is about.
  std::optional<double> moved_m;
  std::optional<double> slip_m;  ///< the largest of a holding finger
  /// Friction half-angle minus the required one, degrees; negative where the step fails for it.
  std::optional<double> margin_deg;
  /// Friction half-angle minus the largest angle between the force of a holding finger and its
  /// normal at rest after the step, degrees.
  std::optional<double> rest_margin_deg;
};

[[nodiscard]] std::vector<StepMeasures> MeasureSteps(const Report& report);

/// The title of an entry with an upper-case first letter: "Switch: place 4, release 0".
[[nodiscard]] std::string StepTitle(const plan::Plan& plan, plan::EntryIndex index);

/// "the hold", "step 3".
[[nodiscard]] std::string StepName(plan::EntryIndex index);

/// Two sentences that go on after what failed, each with a space before it; none where both are
/// empty.
[[nodiscard]] std::string WhyAndMend(const std::string& why, const std::string& mend);

/// The text with an upper-case first letter, if that is an ASCII one.
[[nodiscard]] std::string Capitalized(std::string text);

/// A line per entry of a report: what happens, what friction it needs and has left, how far things
/// moved in the replay, and the verdict; with a note that says what the columns are.
/// @param measures  of each entry (MeasureSteps).
/// @param anchors   of each entry: the id of its picture in the page, empty where there is none.
[[nodiscard]] std::vector<Element> MakeStepTable(const Report& report, const plan::Plan& plan,
                                                 const std::vector<StepMeasures>& measures,
                                                 const std::vector<std::string>& anchors);

/// Of a single grasp: what friction each finger needs; empty where that is not told.
[[nodiscard]] std::vector<Element> MakeFingerTable(const Report& report);

}  // namespace regrasp::report
