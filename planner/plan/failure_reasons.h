#pragma once

#include <span>
#include <string>
#include <string_view>

namespace regrasp::plan {

/// The check that reports a failure reason.
enum class FailureCheck {
  kAnalytic,  ///< checks of the plan file and of force closure
  kHand,      ///< `--hand`: checks of the hand's paths
  kReplay,    ///< simulation, by point fingers or by a hand
  kTrials,    ///< repeated simulation with noise
  kCause,     ///< not a failure: the likely cause of one
};

/// One entry of the reference of failure reasons and likely causes.
///
/// `validate --explain` and the pages of the documents share this text.
///
/// @code
/// if (const FailureReason* slipped = FindFailureReason("slipped")) Print(slipped->meaning);
/// @endcode
struct FailureReason {
  std::string_view name;  ///< name in reports, for example "slipped"
  FailureCheck check;
  std::string_view meaning;     ///< full sentences
  std::string_view causes;      ///< usual causes, one per line
  std::string_view remedies;    ///< imperatives, one per line
  std::string_view see = "";    ///< page of the documents with an anchor
  std::string_view about = "";  ///< title of that page
};

/// Return all failure reasons in the order of the report, then all likely causes.
[[nodiscard]] std::span<const FailureReason> FailureReasons();

/// Return the entry of that name, or nullptr.
[[nodiscard]] const FailureReason* FindFailureReason(std::string_view name);

/// Return the name of a check for people, for example "hand check".
[[nodiscard]] std::string_view FailureCheckName(FailureCheck check);

/// Return an entry as a section of docs/failure_reasons.md or docs/likely_causes.md; its heading is
/// the anchor.
[[nodiscard]] std::string FailureReasonMarkdown(const FailureReason& reason);

}  // namespace regrasp::plan
