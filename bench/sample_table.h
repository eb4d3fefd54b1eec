#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/table_file.h"

namespace regrasp {

/// Result of one replay.
struct Sample {
  std::string body;
  double ratio = 0;  ///< friction coefficient over the required one of the tested grasp
  double quality = 0;
  bool passed = false;
  bool passed_fixed = false;  ///< verdict of the same disturbance test at fixed grasp force
  std::string reason;
  std::string reason_fixed;
  double give = 0;          ///< compliance displacement under position control, in diameters
  double displacement = 0;  ///< displacement, in diameters
};

struct Range {
  std::string name;
  double from;
  double to;
};

/// Ranges of the friction coefficient over the required one, and of the grasp quality.
extern const std::vector<Range> kRatios;
extern const std::vector<Range> kQualities;

/// Return the number of passes among the selected samples by one of the two protocols: "3 of 7".
std::string Share(const std::vector<Sample>& samples, const std::function<bool(const Sample&)>& in,
                  bool Sample::*passes = &Sample::passed);

/// Return a table of passes in each range, for all objects together and for each.
TableFile RangeTable(const std::string& name, const std::string& title, const std::string& column,
                     const std::vector<Range>& ranges, const std::vector<Sample>& samples,
                     const std::function<std::optional<double>(const Sample&)>& value);

/// Return a table of passes by both protocols: by friction for grasps that are not force closure,
/// by quality for the other grasps.
TableFile ProtocolTable(const std::vector<Sample>& holds, const std::vector<Sample>& switches);

/// Write every sample as CSV.
void WriteSamples(const std::vector<Sample>& samples, const std::filesystem::path& file);

}  // namespace regrasp
