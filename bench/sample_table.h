#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/table_file.h"

namespace regrasp {

/// One replay.
struct Sample {
  std::string body;
  double ratio = 0;  ///< μ over the critical μ of the grasp that is examined
  double quality = 0;
  bool passed = false;
  bool passed_fixed = false;  ///< the same shakes at fixed squeeze
  std::string reason;
  std::string reason_fixed;
  double give = 0;          ///< on the servos, over D
  double displacement = 0;  ///< over D
};

struct Range {
  std::string name;
  double from;
  double to;
};

/// Friction over the critical one.
extern const std::vector<Range> kRatios;
extern const std::vector<Range> kQualities;

/// How many of the samples in question pass, by one of the two protocols: "3 of 7".
std::string Share(const std::vector<Sample>& samples, const std::function<bool(const Sample&)>& in,
                  bool Sample::*passes = &Sample::passed);

/// Passes in each range, all bodies and one by one.
TableFile RangeTable(const std::string& name, const std::string& title, const std::string& column,
                     const std::vector<Range>& ranges, const std::vector<Sample>& samples,
                     const std::function<std::optional<double>(const Sample&)>& value);

/// Passes by both protocols, of grasps that are not force closure by friction and of the others by
/// quality.
TableFile ProtocolTable(const std::vector<Sample>& holds, const std::vector<Sample>& switches);

/// Every sample as CSV.
void WriteSamples(const std::vector<Sample>& samples, const std::filesystem::path& file);

}  // namespace regrasp
