#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regrasp::apps {

/// Names of all protocols of `evaluate`, in the order of their columns.
inline constexpr std::array<std::string_view, 4> kProtocolNames = {"analytic", "dexgraspbench",
                                                                   "fall", "disturbance"};

/// Number of directions of loads, in the order −x, x, −y, y, −z, z.
inline constexpr std::size_t kDirections = 6;

/// Result of a protocol in a report. Only the values of its protocol are set.
struct ProtocolCell {
  std::string verdict;  ///< "pass" or "fail"; empty: not tested
  std::string reason;   ///< reason of a failure
  std::optional<double> quality, moved_mm, rotated_deg;
  std::optional<double> seconds;     ///< smallest held time of all directions
  std::optional<double> resisted_N;  ///< smallest resisted force of all directions
  /// Held time or resisted force by direction; nullopt: not measured.
  std::array<std::optional<double>, kDirections> by_direction = {};
};

/// One line of a file that `evaluate` wrote, for tables.
struct GraspRow {
  std::int64_t index = 0;  ///< number of the grasp in its file, from 1
  std::string verdict;     ///< "pass", "fail", "bad-input" or "error"
  std::string id, set, object, hand;
  std::optional<double> scale;
  std::string reason;        ///< reason of a failure, or message of a grasp without a verdict
  std::string likely_cause;  ///< violated convention
  std::optional<bool> claimed;
  std::optional<double> score;
  std::optional<double> distance_mm;               ///< smallest signed distance
  std::vector<std::pair<std::string, int>> links;  ///< links in contact, number of contacts
  std::array<ProtocolCell, kProtocolNames.size()> results;  ///< in the order of kProtocolNames

  /// Depth of the deepest link, in millimetres.
  [[nodiscard]] std::optional<double> depth_mm() const;
  /// Number of contacts per link as text, "thumb 4, index 2".
  [[nodiscard]] std::string contacts() const;
  /// Whether the data set claims another success than measured.
  [[nodiscard]] bool differs_from_claim() const;
};

/// Read the rows of a file in its order. Memory use does not depend on its size.
/// @throws InputError  if the file is not one that `evaluate` wrote.
void ReadGraspRows(const std::filesystem::path& path, const std::function<void(GraspRow)>& visit);

}  // namespace regrasp::apps
