#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/batch/object_cache.h"
#include "apps/batch/report_summary.h"
#include "apps/earlier_run.h"
#include "apps/lines_run.h"
#include "apps/output_files.h"
#include "apps/validate_run.h"
#include "apps/validate_task.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan_io.h"
#include "report/failure.h"
#include "report/report_json.h"

namespace regrasp::apps {

namespace {

namespace fs = std::filesystem;

/// Digits in the name of the folder of a plan with frames.
constexpr std::size_t kDigits = 7;

/// Return the text before the initial grasp, without parsing.
/// Lines with equal texts have the same object.
std::string ValidateObjectText(const Line& line) {
  const std::string_view text = line.text;
  const std::size_t begin = text.find(R"("object":)");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find(R"("initial":)", begin) - begin));
}

class ValidateLines {
 public:
  explicit ValidateLines(const ValidateOptions& options)
      : options_(options),
        objects_{ObjectFinder(options.object_path), {}},
        folder_(options.Folder()) {
    options_.quiet = true;
  }

  int Run(bool quiet) {
    LinesRun run;
    run.program = kValidateName;
    run.content = "reports";
    run.input = options_.plan_path;
    run.output = folder_ / kReportsName;
    CheckOutput(run.output.string());
    shared_ = ReadSharedInputs(options_);
    common_ = DigestOf(options_, "", "");
    run.shard = options_.shard;
    run.digest = [this](const std::string& source) { return Digest(source); };
    run.jobs = options_.jobs;
    run.time_limit_s = options_.time_limit_s;
    run.fresh = options_.fresh;
    run.quiet = quiet;
    run.work.group = ValidateObjectText;
    run.work.prepare = [this](const Line& line) { Prepare(line); };
    run.work.work = [this](const Line& line) {
      return GuardLine(line, [&] { return ValidateLine(line); });
    };
    run.work.inputs = [this](const Line& line) {
      return EntryDigest(common_, line, ObjectOf(line), objects_.finder);
    };
    run.work.complete = [this](const Line& line, std::string_view record) {
      return HasFrames(line, record);
    };
    run.work.messages = MessagesOf;
    return RunLinesFile(run);
  }

 private:
  void CheckOutput(const std::string& reports) const {
    OutputFiles outputs;
    outputs.Add("--output", reports);
    outputs.Add("--output", reports + kPartEnding);
    CheckOutputsDiffer({{"--object", options_.object_path},
                        {"--plan", options_.plan_path},
                        {"--start", options_.start},
                        {"--goal", options_.goal},
                        {"--hand", options_.hand}},
                       outputs);
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw EnvironmentError(folder_.string() + ": " + error.message());
    CheckOutputsWritable(outputs);
  }

  /// Return the digest of all inputs of the output's lines.
  /// @param source  identity of the input's lines.
  [[nodiscard]] std::string Digest(const std::string& source) const {
    ValidateOptions options = options_;
    // A time limit changes which entries are errors.
    if (options.time_limit_s) {
      options.given.emplace_back("--time-limit", std::vector{FormatDouble(*options.time_limit_s)});
    }
    const bool one = !objects_.finder.is_folder();
    return DigestOf(options, source, one ? Sha256(ReadFile(options.object_path)) : "");
  }

  /// Return the digest of all inputs, for given options.
  /// @param object_sha256  SHA-256 of the object of all lines; empty: each line names its object.
  [[nodiscard]] std::string DigestOf(const ValidateOptions& options, const std::string& source,
                                     const std::string& object_sha256) const {
    return RunDigest(options, {{"", source},
                               {"", object_sha256},
                               options.start.empty() ? "" : Sha256(shared_.start_text),
                               options.goal.empty() ? "" : Sha256(shared_.goal_text),
                               shared_.hand ? shared_.hand->hand.sha256 : ""});
  }

  /// Return the object of a line; nullopt if it is not a plan.
  [[nodiscard]] std::optional<ObjectOfLine> ObjectOf(const Line& line) const {
    try {
      const Json json = ParseJson(line.text, line.name);
      const plan::JsonReader object = plan::JsonReader(json, line.name).Member("object");
      return ObjectOfLine{object.Member("file").String(), object.Member("sha256").String(),
                          RepairInput(options_, line.text)};
    } catch (const InputError&) {
      return std::nullopt;  // the child process reports the error
    }
  }

  /// Return the messages of the process that made a record.
  static std::vector<std::string> MessagesOf(const Line& line, std::string_view record) {
    const auto outcome = OutcomeOf(record, line.entry);
    const auto has = [record](std::string_view member) {
      return record.find(member) != std::string_view::npos;
    };
    const bool states_rate = has(R"("trials":{)") || has(R"("conditions":{)");
    if (outcome != Outcome::kFail && (outcome != Outcome::kPass || !states_rate)) return {};
    const ReportSummary report = SummarizeReport(ParseJson(record, line.name), line.name);
    const std::string said = report.headline();
    return said.empty() ? std::vector<std::string>{} : std::vector{line.name + ": " + said};
  }

  /// Return whether the frames of a record still exist.
  [[nodiscard]] bool HasFrames(const Line& line, std::string_view record) {
    const auto outcome = OutcomeOf(record, line.entry);
    if (outcome != Outcome::kFail && outcome != Outcome::kPass) return true;
    if (!options_.draws_frames(outcome == Outcome::kPass)) return true;
    ValidateOptions options = FramesOptions(line.entry);
    const auto object = ObjectOf(line);
    if (!object) return false;
    try {
      options.object_path = objects_.finder.Find(object->name, object->sha256, line.name);
    } catch (const InputError&) {
      return false;
    }
    return HasSameRun(options);
  }

  /// Return the options with the name of the plan of a line in messages.
  [[nodiscard]] ValidateOptions OptionsFor(const Line& line) const {
    ValidateOptions options = options_;
    options.plan_path = line.name;
    return options;
  }

  void Prepare(const Line& line) {
    try {
      static_cast<void>(MakePlanTask(OptionsFor(line), line.text, shared_, objects_));
    } catch (const InputError&) {
      // The process of each line reports the error.
    }
  }

  std::string ValidateLine(const Line& line) {
    if (const auto why = WhyNoPlan(line)) {
      return FormatNoResult(line.entry, Outcome::kNoPlan, *why);
    }
    const ValidateOptions options = OptionsFor(line);
    const ValidateTask task = MakePlanTask(options, line.text, shared_, objects_);
    report::Report report = ValidateFiles(options, task).report;
    report.plan_file = "query " + std::to_string(line.entry);
    report.plan_sha256 = Sha256(line.text);
    const std::string said = report::VerdictHeadline(report);
    if (!said.empty()) std::cerr << line.name + ": " + said + "\n";
    if (options.draws_frames(report.passed())) DrawFrames(line, task);
    Json json = report::ReportJson(report);
    for (const std::string& warning : HandWarnings(options, task)) {
      json["warnings"].push_back(warning);
    }
    for (const std::string& warning : report::Warnings(report)) json["warnings"].push_back(warning);
    return FormatRecord(line.entry, json);
  }

  /// Return the message of a planner that found no plan.
  static std::optional<std::string> WhyNoPlan(const Line& line) {
    for (const Outcome outcome : {Outcome::kNoPlan, Outcome::kBadInput, Outcome::kError}) {
      if (OutcomeOf(line.text, line.entry) != outcome) continue;
      const Json json = ParseJson(line.text, line.name);
      return plan::JsonReader(json, line.name).Member("message").String();
    }
    return std::nullopt;
  }

  /// Return the options of the validation that draws the frames of an entry.
  /// The object is not set.
  [[nodiscard]] ValidateOptions FramesOptions(std::int64_t entry) const {
    const std::string number = std::to_string(entry);
    ValidateOptions options = options_;
    options.out =
        (folder_ / (std::string(kDigits - std::min(kDigits, number.size()), '0') + number))
            .string();
    options.plan_path = (fs::path(options.out) / "plan.json").string();
    options.workers = std::max(1, options.workers / options.jobs);
    options.silent = true;
    if (shared_.hand) options.hand_sha256 = shared_.hand->hand.sha256;
    return options;
  }

  /// Draw the frames of a line by a separate validation with the same result.
  void DrawFrames(const Line& line, const ValidateTask& task) {
    ValidateOptions options = FramesOptions(line.entry);
    options.object_path =
        objects_.finder.Find(task.plan.object_file, task.plan.object_sha256, line.name);
    fs::create_directories(options.out);
    WriteFile(options.plan_path, plan::FormatPlan(task.plan));
    static_cast<void>(RunValidation(options));
  }

  ValidateOptions options_;
  PlanObjects objects_;
  fs::path folder_;
  SharedInputs shared_;
  std::string common_;  ///< digest of the inputs of all lines
};

}  // namespace

int RunValidateLines(const ValidateOptions& options) {
  return ValidateLines(options).Run(options.quiet);
}

}  // namespace regrasp::apps
