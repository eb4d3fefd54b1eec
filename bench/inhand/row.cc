#include "bench/inhand/row.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"

namespace regrasp::bench {
namespace {

int CountSteps(const plan::Plan& plan, const std::string& kind) {
  return static_cast<int>(std::ranges::count(plan.steps, kind, plan::StepKind));
}

template <class Value>
std::optional<Value> Maybe(const Json& json, const char* key) {
  return json.at(key).is_null() ? std::nullopt : std::optional(json.at(key).get<Value>());
}

/// Round to 1e-4: more digits of seconds, millimetres and degrees are not significant.
Json JsonOf(const std::optional<double>& value) {
  constexpr double kPerUnit = 1e4;
  return value ? Json(std::round(*value * kPerUnit) / kPerUnit) : Json();
}

Row RowOf(const Json& json) {
  Row row;
  row.task = json.at("task").get<std::string>();
  row.group = json.at("group").get<std::string>();
  row.body = json.at("body").get<std::string>();
  row.hand = json.at("hand").get<std::string>();
  row.hand_sha256 = json.at("hand_sha256").get<std::string>();
  row.planner = json.at("planner").get<std::string>();
  row.limit_s = Maybe<double>(json, "limit_s");
  row.seconds = Maybe<double>(json, "seconds");
  row.found = json.at("found").get<bool>();
  row.switches = json.at("switches").get<int>();
  row.moves = json.at("moves").get<int>();
  row.aligns = json.at("aligns").get<int>();
  row.passed = json.at("passed").get<bool>();
  row.reason = json.at("reason").get<std::string>();
  row.detail = json.at("detail").get<std::string>();
  if (const auto mm = Maybe<double>(json, "error_mm")) {
    row.error = {1e-3 * *mm, Radians(json.at("error_deg").get<double>())};
  }
  row.plan_sha256 = json.at("plan_sha256").get<std::string>();
  return row;
}

bool IsOfSame(const Row& a, const Row& b) {
  return a.task == b.task && a.hand == b.hand && a.planner == b.planner;
}

}  // namespace

Row RowOf(const Task& task, const kinematics::HandFile& hand) {
  Row row;
  row.task = task.name;
  row.group = task.group;
  row.body = task.body;
  row.hand = hand.hand.name;
  row.hand_sha256 = hand.hand.sha256;
  return row;
}

void AddPlan(const plan::Plan& plan, std::string_view bytes, const Verdict& verdict, Row& row) {
  row.planner = plan.planner;
  row.found = true;
  row.switches = CountSteps(plan, "switch");
  row.moves = CountSteps(plan, "move");
  row.aligns = CountSteps(plan, "align");
  row.passed = !verdict.fault;
  if (verdict.fault) {
    row.reason = plan::ReasonName(verdict.fault->reason);
    row.detail = verdict.fault->detail;
  }
  row.error = verdict.error;
  row.plan_sha256 = Sha256(bytes);
}

std::string FormatRow(const Row& row) {
  Json json;
  json["task"] = row.task;
  json["group"] = row.group;
  json["body"] = row.body;
  json["hand"] = row.hand;
  json["hand_sha256"] = row.hand_sha256;
  json["planner"] = row.planner;
  json["limit_s"] = row.limit_s ? Json(*row.limit_s) : Json();
  json["seconds"] = JsonOf(row.seconds);
  json["found"] = row.found;
  json["switches"] = row.switches;
  json["moves"] = row.moves;
  json["aligns"] = row.aligns;
  json["passed"] = row.passed;
  json["reason"] = row.reason;
  json["detail"] = row.detail;
  std::optional<double> mm;
  std::optional<double> deg;
  if (row.error) {
    mm = 1e3 * row.error->metres;
    deg = Degrees(row.error->radians);
  }
  json["error_mm"] = JsonOf(mm);
  json["error_deg"] = JsonOf(deg);
  json["plan_sha256"] = row.plan_sha256;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Row> ParseRows(std::string_view text, const std::string& name) {
  std::vector<Row> rows;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    const std::string place = name + ": line " + std::to_string(number);
    try {
      rows.push_back(RowOf(ParseJson(line, place)));
    } catch (const nlohmann::json::exception& error) {
      throw InputError(place + ": not a row of the scoreboard: " + error.what());
    }
  }
  return rows;
}

std::vector<Row> ReadRows(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  std::vector<Row> rows;
  for (Row& row : ParseRows(ReadFile(path), path.string())) {
    std::erase_if(rows, [&](const Row& before) { return IsOfSame(before, row); });
    rows.push_back(std::move(row));
  }
  return rows;
}

void AppendRows(const std::filesystem::path& path, std::string_view lines) {
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file << lines << std::flush;
  if (!file) throw EnvironmentError(path.string() + ": cannot be written");
}

}  // namespace regrasp::bench
