#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/report.h"

namespace regrasp::report {

/// Escape text for HTML, XML, SVG and quoted attributes.
/// The characters & < > " ' are escaped. Bytes that are not UTF-8, and invisible characters
/// (IsInvisible) other than tab and line feed, become U+FFFD. The result has only characters that
/// XML 1.0 allows (its production Char).
[[nodiscard]] std::string EscapeMarkup(std::string_view text);

/// Names and values, in output order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// An element of HTML, SVG or XML: its tag, its attributes and its content.
///
/// Text and values are escaped when they are added, so that no input becomes markup. The output is
/// well-formed XML and valid HTML: void elements of HTML (meta, img, …) are closed in their own
/// tag, all other elements by an end tag.
class Element {
 public:
  /// @param tag, attributes  tag and attributes; names are not escaped.
  /// @param children         children in output order, of any type that Add accepts.
  template <typename... Children>
  explicit Element(std::string_view tag, const Attributes& attributes = {},
                   const Children&... children)
      : tag_(tag), attributes_(FormatAttributes(attributes)) {
    (Add(children), ...);
  }

  void Add(std::string_view text);
  void Add(const Element& child);
  /// Add elements, each on its own line.
  void Add(const std::vector<Element>& children);
  /// Add text without escaping, such as a style sheet; never text from input.
  void AddVerbatim(std::string_view text);

  [[nodiscard]] std::string Format() const;

 private:
  static std::string FormatAttributes(const Attributes& attributes);

  std::string tag_, attributes_, content_;
};

enum class JunitOutcome { kPassed, kFailed, kError, kSkipped };

struct JunitCase {
  std::string name;
  JunitOutcome outcome = JunitOutcome::kPassed;
  std::string message;       ///< message of a failure or an error, a word or a line
  std::string text;          ///< readable text of a failure
  double seconds = 0;        ///< duration; 0 if the case was not executed
  std::string picture = {};  ///< path of the image of a failure, for the CI server
};

/// The test cases of one plan.
struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
  double seconds = 0;  ///< total duration, images and files included
};

/// Return the readable text of a case, one line per part; empty parts are omitted.
/// @param detail     description of the fault, as in report.json.
/// @param why, mend  reason and suggested fix, as in report.json.
[[nodiscard]] std::string JunitText(const std::string& detail, const std::string& why,
                                    const std::string& suggested_fix);

/// Return the outcome for an entry's verdict: "pass", "fail" or "skipped".
[[nodiscard]] JunitOutcome OutcomeOf(std::string_view verdict);

/// Return a suite named after the plan, with a case for each entry of its report and no times.
/// @param folder  folder of the report's frames, as CI servers find it (apps/output_files.h,
///     PathForCi).
[[nodiscard]] JunitSuite MakeJunitSuite(const Report& report, const std::filesystem::path& folder);

/// Set the durations of the cases of a suite.
/// @param seconds  durations in the order of the cases. Final cases that were not executed may be
///     missing.
void SetCaseTimes(const std::vector<double>& seconds, JunitSuite& suite);

/// Format JUnit XML for CI servers.
/// The text of a failure names its image. The image is attached to the case in the form that GitLab
/// and the Jenkins plugin junit-attachments read. Only the times differ from run to run.
[[nodiscard]] std::string FormatJunit(const std::vector<JunitSuite>& suites);

}  // namespace regrasp::report
