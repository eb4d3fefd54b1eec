#include "apps/plan_lines.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/batch/object_cache.h"
#include "apps/lines_run.h"
#include "apps/options.h"
#include "apps/output_files.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/repair_module.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/criteria/reach.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan_io.h"
#include "sim/scene/mujoco_engine.h"

namespace regrasp::apps {

namespace {

/// A query of a JSON Lines file, as options of the command line.
struct Query {
  /// name and digest of the object's file; empty: not given
  std::string object_name, object_sha256;
  PlanProgram program;  ///< options of the query, without the object's path
};

PlanEnd ReadEnd(const plan::JsonReader& root, const std::string& name, const char* key,
                const Json& json, PlanEnd end) {
  if (!root.Has(key)) return end;
  end.name = name + ": /" + key;
  end.value = json.at(key).is_object() ? "" : root.Member(key).OneOf({"random", "random-any"});
  end.text = json.at(key).is_object() ? json.at(key).dump() : "";
  return end;
}

void ReadFriction(const plan::JsonReader& friction, FrictionOptions& options) {
  const bool degrees = friction.Has("half_angle_deg");
  if (degrees == friction.Has("mu")) friction.Fail("expected half_angle_deg or mu");
  const plan::JsonReader value = friction.Member(degrees ? "half_angle_deg" : "mu");
  if (!(value.Number() > 0)) value.Fail("must be positive, found " + value.Quoted());
  if (degrees && !(value.Number() < 90)) {
    value.Fail("must be between 0 and 90, found " + value.Quoted());
  }
  degrees ? options.SetDegrees(value.Number()) : options.SetMu(value.Number());
}

double ReadPositive(const plan::JsonReader& value, bool or_zero) {
  if (or_zero ? value.Number() >= 0 : value.Number() > 0) return value.Number();
  value.Fail(std::string(or_zero ? "must not be negative" : "must be positive") + ", found " +
             value.Quoted());
}

/// Refuse members with the name of an option that changes plans, such as `turn`, except some.
/// Such a member would have no effect.
void RefuseOptions(const plan::JsonReader& reader, const Json& object,
                   const std::vector<std::string>& options,
                   const std::vector<std::string>& except) {
  for (const auto& [name, value] : object.items()) {
    std::string option = "--" + name;
    std::ranges::replace(option, '_', '-');
    if (std::ranges::find(except, name) != except.end()) continue;
    if (std::ranges::find(options, option) == options.end()) continue;
    reader.Fail("unknown member " + name + ": a query cannot have the option " + option);
  }
}

/// Refuse members whose names are similar to known ones.
/// Members with other names are accepted as the user's own data.
void RefuseMisspelt(const plan::JsonReader& reader, const Json& object,
                    const std::vector<std::string>& names) {
  for (const auto& [name, value] : object.items()) {
    if (std::ranges::find(names, name) != names.end()) continue;
    const std::string meant = SimilarWord(name, names);
    if (!meant.empty()) reader.Fail("unknown member " + name + meant);
  }
}

Query ReadQuery(const Line& line, const PlanProgram& program) {
  const Json json = ParseJson(line.text, line.name);
  const plan::JsonReader root(json, line.name);
  if (!json.is_object()) root.Fail("expected a JSON object, found " + root.Quoted());
  const std::vector<std::string> members = {"object",      "friction", "scale", "seed",
                                            "min_quality", "start",    "goal"};
  RefuseOptions(root, json, program.options_of_plans, members);
  RefuseMisspelt(root, json, members);
  Query query{"", "", program};
  if (root.Has("object")) {
    const plan::JsonReader object = root.Member("object");
    if (!json.at("object").is_object()) {
      object.Fail("expected a JSON object that names the file, found " + object.Quoted() +
                  "; help: write {\"object\": {\"file\": " +
                  (json.at("object").is_string() ? object.Quoted() : "\"cube.obj\"") + "}}");
    }
    RefuseMisspelt(object, json.at("object"), {"file", "sha256"});
    query.object_name = object.Member("file").String();
    if (object.Has("sha256")) query.object_sha256 = object.Member("sha256").String();
  }
  PlanProgram& asked = query.program;
  if (root.Has("friction")) ReadFriction(root.Member("friction"), asked.common.friction);
  if (root.Has("scale")) asked.common.scale = ReadPositive(root.Member("scale"), false);
  if (root.Has("seed")) asked.common.seed = root.Member("seed").Unsigned();
  if (root.Has("min_quality")) asked.min_quality = ReadPositive(root.Member("min_quality"), true);
  asked.start = ReadEnd(root, line.name, "start", json, asked.start);
  asked.goal = ReadEnd(root, line.name, "goal", json, asked.goal);
  return query;
}

/// Return the text of the member "object", without parsing.
/// Lines with the same text have the same object.
std::string ObjectText(const Line& line) {
  const std::string_view text = line.text;
  const std::size_t begin = text.find(R"("object")");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find('}', begin) - begin));
}

class PlanLines {
 public:
  explicit PlanLines(const PlanProgram& program)
      : program_(program), finder_(program.common.object) {
    program_.common.quiet = true;  // no progress per line
  }

  int Run(bool quiet) {
    CheckOutput();
    program_.ReadHand();
    LinesRun run;
    run.program = kPlanName;
    run.content = "plans";
    run.input = program_.batch;
    run.output = program_.output;
    run.shard = program_.shard;
    run.digest = [this](const std::string& source) { return Digest(source); };
    run.jobs = program_.jobs;
    run.fresh = program_.fresh;
    run.quiet = quiet;
    run.work.group = ObjectText;
    run.work.prepare = [this](const Line& line) { Prepare(line); };
    run.work.work = [this](const Line& line) {
      return GuardLine(line, [&] { return PlanLine(line); });
    };
    common_ = Common().Finish();
    run.work.inputs = [this](const Line& line) {
      return EntryDigest(common_, line, ObjectOf(line), finder_);
    };
    return RunLinesFile(run);
  }

 private:
  void CheckOutput() const {
    std::error_code error;
    const bool other = std::filesystem::exists(program_.output, error) &&
                       !std::filesystem::is_regular_file(program_.output, error);
    if (program_.output == "-" || other) {
      throw InputError(
          "--output: with --batch must be a file, because an interrupted run continues it");
    }
    OutputFiles outputs;
    outputs.Add("--output", program_.output);
    outputs.Add("--output", program_.output + kPartEnding);
    CheckOutputsDiffer({{"--object", program_.common.object},
                        {"--batch", program_.batch},
                        {"--start", FileOfEnd(program_.start.value)},
                        {"--goal", FileOfEnd(program_.goal.value)},
                        {"--hand", program_.hand.hand}},
                       outputs);
    CheckOutputsWritable(outputs);
  }

  /// Add a start or goal to a digest.
  /// It is missing, a word, or the path and the bytes of a file. These three cases have different
  /// digests.
  static void AddEnd(const PlanEnd& end, InputsDigest& digest) {
    if (!end.given()) {
      digest.AddAbsent(end.option);
    } else {
      digest.Add(end.option, end.value);
    }
    std::error_code error;
    const std::string path = FileOfEnd(end.value);
    const bool file = end.given() && !end.is_random() && std::filesystem::exists(path, error);
    if (file) digest.Add("sha256", Sha256(ReadFile(path)));
  }

  /// Return the digest of all inputs that the results of all queries depend on.
  [[nodiscard]] InputsDigest Common() const {
    InputsDigest digest;
    digest.Add("version", ProgramVersion()).Add("build", BuildId());
    digest.Add("engine", sim::EngineVersion());
    AddEnd(program_.start, digest);
    AddEnd(program_.goal, digest);
    if (program_.hand_file) {
      digest.Add("hand", program_.hand_file->hand.file)
          .Add("sha256", program_.hand_file->hand.sha256);
    } else {
      digest.AddAbsent("hand");
    }
    if (program_.common.repair.wanted()) digest.Add("repair", RepairModuleDigest());
    digest.Add("options", program_.given);
    return digest;
  }

  [[nodiscard]] std::string Digest(const std::string& source) const {
    InputsDigest digest = Common();
    digest.Add("source", source);
    if (finder_.is_folder()) return digest.AddAbsent("object").Finish();
    return digest.Add("object", Sha256(ReadFile(program_.common.object))).Finish();
  }

  /// Return the object that a query names; nullopt if the query is invalid.
  [[nodiscard]] std::optional<ObjectOfLine> ObjectOf(const Line& line) const {
    try {
      const Query query = ReadQuery(line, program_);
      return ObjectOfLine{query.object_name, query.object_sha256};
    } catch (const InputError&) {
      return std::nullopt;  // the child process reports the error
    }
  }

  /// Return the object of a query, and set its file in the query's options.
  SharedObject ObjectOf(const Line& line, Query& query) {
    PlannerOptions& common = query.program.common;
    // --time-limit applies to each query separately.
    common.begin = std::chrono::steady_clock::now();
    common.object = finder_.Find(query.object_name, query.object_sha256, line.name);
    SharedObject object =
        object_cache_.Get(common.object, [&] { return common.ReadObjectFile(kPlanName); });
    if (!query.object_sha256.empty() && object->sha256 != query.object_sha256 &&
        !(object->repair && object->repair->sha256 == query.object_sha256)) {
      throw InputError(line.name + ": /object/sha256: the query is for another file, expected " +
                       DescribeFile(query.object_name, query.object_sha256) + ", found " +
                       DescribeFile(common.object, object->sha256));
    }
    return object;
  }

  void Prepare(const Line& line) {
    try {
      Query query = ReadQuery(line, program_);
      static_cast<void>(ObjectOf(line, query));
    } catch (const InputError&) {
      // The child process reports the error for each line.
    } catch (const TimeUp&) {
      // The child process reports this, too.
    }
  }

  std::string PlanLine(const Line& line) {
    Query query = ReadQuery(line, program_);
    PlanProgram& asked = query.program;
    asked.ReadHandGrasps();
    asked.CheckEnds();
    const SharedObject object = ObjectOf(line, query);
    criteria::CheckFingerRadius(*object->object, asked.finger_radius, "--finger-radius");
    const FinishedPlan finished = asked.Plan(*object, asked.common.ReadGivenPoints());
    const planning::PlanResult& result = finished.result;
    if (!result.plan) return FormatNoResult(line.entry, Outcome::kNoPlan, result.message);
    Json json = ParseJson(plan::FormatPlan(*result.plan), line.name);
    for (const std::string& warning : result.warnings) {
      if (!warning.empty()) json["warnings"].push_back(warning);
    }
    return FormatRecord(line.entry, json);
  }

  PlanProgram program_;
  ObjectFinder finder_;
  ObjectCache object_cache_;
  std::string common_;  ///< digest of all that the results of all queries depend on
};

}  // namespace

int RunPlanLines(const PlanProgram& program) {
  return PlanLines(program).Run(program.common.quiet);
}

}  // namespace regrasp::apps
