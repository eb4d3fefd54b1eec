#include "apps/evaluate_rows.h"

#include <algorithm>
#include <cstddef>

#include "apps/batch/line_records.h"
#include "planner/base/json.h"
#include "planner/plan/json_reader.h"

namespace regrasp::apps {

namespace {

using plan::JsonReader;

std::optional<double> NumberOf(const JsonReader& json, const char* key) {
  if (!json.Has(key)) return std::nullopt;
  return json.Member(key).Number();
}

std::string TextOf(const JsonReader& json, const char* key) {
  return json.Has(key) ? json.Member(key).String() : "";
}

/// Return the smallest number of an array; null elements do not count.
/// @param by_direction  output: all numbers, if the array exists.
std::optional<double> SmallestOf(const JsonReader& json, const char* key,
                                 std::array<std::optional<double>, kDirections>& by_direction) {
  if (!json.Has(key)) return std::nullopt;
  std::optional<double> smallest;
  std::size_t direction = 0;
  for (const JsonReader& element : json.Member(key).Elements()) {
    if (direction == kDirections) json.Member(key).Fail("expected at most 6 numbers");
    std::optional<double>& place = by_direction[direction++];
    if (element.IsNull()) continue;
    place = element.Number();
    smallest = smallest ? std::min(*smallest, *place) : *place;
  }
  return smallest;
}

void ReadResult(const JsonReader& json, GraspRow& row) {
  const std::string name = json.Member("protocol").String();
  const auto* const found = std::ranges::find(kProtocolNames, name);
  if (found == kProtocolNames.end()) {
    json.Member("protocol")
        .Fail("protocol not supported, found " + json.Member("protocol").Quoted());
  }
  ProtocolCell& cell = row.results[static_cast<std::size_t>(found - kProtocolNames.begin())];
  cell.verdict = json.Member("verdict").String();
  cell.reason = TextOf(json, "reason");
  cell.quality = NumberOf(json, "quality");
  cell.moved_mm = NumberOf(json, "moved_mm");
  cell.rotated_deg = NumberOf(json, "rotated_deg");
  cell.seconds = SmallestOf(json, "seconds", cell.by_direction);
  cell.resisted_N = SmallestOf(json, "resisted_N", cell.by_direction);
}

void ReadReport(const Json& value, const JsonReader& json, GraspRow& row) {
  row.id = json.Member("id").String();
  row.set = TextOf(json, "set");
  row.hand = TextOf(json, "hand");
  row.object = json.Member("object").Member("file").String();
  row.scale = NumberOf(json.Member("object"), "scale");
  row.reason = TextOf(json, "reason");
  row.likely_cause = TextOf(json, "likely_cause");
  const auto claimed = value.find("claimed");
  if (claimed != value.end() && claimed->is_boolean()) row.claimed = claimed->get<bool>();
  row.score = NumberOf(json, "score");
  row.distance_mm = NumberOf(json, "distance_mm");
  constexpr int kMostContacts = 1'000'000;
  for (const JsonReader& link : json.Member("links").Elements()) {
    row.links.emplace_back(link.Member("link").String(),
                           link.Member("contacts").Integer(0, kMostContacts));
  }
  for (const JsonReader& result : json.Member("protocols").Elements()) ReadResult(result, row);
}

}  // namespace

std::optional<double> GraspRow::depth_mm() const {
  if (!distance_mm) return std::nullopt;
  return std::max(0.0, -*distance_mm);
}

std::string GraspRow::contacts() const {
  std::string text;
  for (const auto& [link, count] : links) {
    text += (text.empty() ? "" : ", ") + link + " " + std::to_string(count);
  }
  return text;
}

bool GraspRow::differs_from_claim() const {
  return claimed && (verdict == "pass" || verdict == "fail") && *claimed != (verdict == "pass");
}

void ReadGraspRows(const std::filesystem::path& path, const std::function<void(GraspRow)>& visit) {
  LinesInput input(path);
  while (const std::optional<Line> line = input.Next()) {
    GraspRow row;
    row.index = line->entry;
    const Json value = ParseJson(line->text, line->name);
    const JsonReader json(value, line->name);
    row.verdict = json.Member("verdict").String();
    if (row.verdict == "pass" || row.verdict == "fail") {
      ReadReport(value, json, row);
    } else {
      row.reason = TextOf(json, "message");
    }
    visit(std::move(row));
  }
}

}  // namespace regrasp::apps
