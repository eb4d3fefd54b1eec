#include "bench/sample_table.h"

#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp {

namespace {

std::vector<std::string> BodyNames(const std::vector<Sample>& samples) {
  std::vector<std::string> names;
  for (const Sample& sample : samples) {
    if (names.empty() || names.back() != sample.body) names.push_back(sample.body);
  }
  return names;
}

}  // namespace

const std::vector<Range> kRatios = {{"0.7 to 0.9", 0.7, 0.9},   {"0.9 to 0.98", 0.9, 0.98},
                                    {"0.98 to 1", 0.98, 1},     {"1 to 1.02", 1, 1.02},
                                    {"1.02 to 1.1", 1.02, 1.1}, {"1.1 to 1.3", 1.1, 1.3},
                                    {"1.3 to 1.5", 1.3, 1.5}};
const std::vector<Range> kQualities = {
    {"0 to 0.002", 0, 0.002},       {"0.002 to 0.005", 0.002, 0.005},
    {"0.005 to 0.01", 0.005, 0.01}, {"0.01 to 0.012", 0.01, 0.012},
    {"0.012 to 0.02", 0.012, 0.02}, {"0.02 to 0.05", 0.02, 0.05},
    {"0.05 and more", 0.05, 1e9}};

std::string Share(const std::vector<Sample>& samples, const std::function<bool(const Sample&)>& in,
                  bool Sample::*passes) {
  int count = 0;
  int passed = 0;
  for (const Sample& sample : samples) {
    if (!in(sample)) continue;
    ++count;
    passed += sample.*passes ? 1 : 0;
  }
  return count == 0 ? "–" : std::to_string(passed) + " of " + std::to_string(count);
}

TableFile RangeTable(const std::string& name, const std::string& title, const std::string& column,
                     const std::vector<Range>& ranges, const std::vector<Sample>& samples,
                     const std::function<std::optional<double>(const Sample&)>& value) {
  TableFile table{name, title, {column, "all"}, {}};
  const std::vector<std::string> bodies = BodyNames(samples);
  table.columns.insert(table.columns.end(), bodies.begin(), bodies.end());
  for (const Range& range : ranges) {
    const auto in_range = [&](const Sample& sample) {
      const auto x = value(sample);
      return x && *x >= range.from && *x < range.to;
    };
    std::vector<std::string> row = {range.name, Share(samples, in_range)};
    for (const std::string& body : bodies) {
      row.push_back(Share(samples, [&](const Sample& s) { return s.body == body && in_range(s); }));
    }
    table.rows.push_back(row);
  }
  return table;
}

TableFile ProtocolTable(const std::vector<Sample>& holds, const std::vector<Sample>& switches) {
  TableFile table{
      "protocols",
      "Grasps that pass with adapted forces and with constant grasp force",
      {"grasps", "holds, adapted", "holds, fixed", "switches, adapted", "switches, fixed"},
      {}};
  const auto add = [&](const std::string& name, const std::function<bool(const Sample&)>& in) {
    table.rows.push_back({name, Share(holds, in), Share(holds, in, &Sample::passed_fixed),
                          Share(switches, in), Share(switches, in, &Sample::passed_fixed)});
  };
  add("friction at most 0.98 of the required one", [](const Sample& s) { return s.ratio <= 0.98; });
  add("0.98 to 1", [](const Sample& s) { return s.ratio > 0.98 && s.ratio < 1; });
  for (const Range& range : kQualities) {
    add("quality " + range.name, [&](const Sample& s) {
      return s.ratio >= 1 && s.quality >= range.from && s.quality < range.to;
    });
  }
  return table;
}

void WriteSamples(const std::vector<Sample>& samples, const std::filesystem::path& file) {
  std::string csv =
      "body,ratio,quality,verdict,reason,displacement_over_diameter,fixed_verdict,fixed_reason,"
      "fixed_give_over_diameter\n";
  for (const Sample& sample : samples) {
    csv += sample.body + "," + FormatFixed(sample.ratio, 4) + "," + FormatShort(sample.quality, 4) +
           "," + (sample.passed ? "pass" : "fail") + "," + sample.reason + "," +
           FormatShort(sample.displacement, 3) + "," + (sample.passed_fixed ? "pass" : "fail") +
           "," + sample.reason_fixed + "," + FormatShort(sample.give, 3) + "\n";
  }
  WriteFile(file, csv);
}

}  // namespace regrasp
