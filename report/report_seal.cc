#include "report/report_seal.h"

#include <utility>

#include "planner/base/file.h"

namespace regrasp::report {

namespace {

constexpr char kRun[] = "run";
constexpr char kSeal[] = "report_sha256";

std::string Text(const Json& report) {
  // File names may be any bytes; JSON must be UTF-8.
  return report.dump(1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string SealReport(Json report) {
  if (!report.contains(kRun)) return Text(report);
  report[kRun].erase(kSeal);
  report[kRun][kSeal] = Sha256(Text(report));
  return Text(report);
}

bool IsSealed(std::string_view text) {
  Json report = ParseJson(text, "report");
  if (!report.is_object() || !report.contains(kRun) || !report[kRun].is_object()) return false;
  return SealReport(std::move(report)) == text;
}

}  // namespace regrasp::report
