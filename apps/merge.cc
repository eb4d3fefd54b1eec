// merge: joins the shards of a run over a JSON Lines file into a single output file.

#include <filesystem>
#include <string>
#include <vector>

#include "apps/batch/line_output.h"
#include "apps/batch/merge_lines.h"
#include "apps/commands.h"
#include "apps/help.h"
#include "apps/options.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "planner/base/error.h"

namespace {

using namespace regrasp::apps;

constexpr char kProgram[] = "merge";

struct MergeProgram {
  std::vector<std::string> shards;
  std::string output;
  bool fresh = false;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run() const;
};

void MergeProgram::AddTo(CLI::App& app) {
  BeginGroup(app, "Input");
  app.add_option("--shards", shards,
                 "Files of all shards of a run, in any order. Made by plan --batch --shard I/N, or "
                 "reports.jsonl of validate")
      ->type_name("FILE")
      ->required();
  BeginGroup(app, "Output");
  app.add_option("-o,--output", output, "Joined file, as one run without --shard writes it")
      ->type_name("FILE")
      ->required();
  app.add_flag("--restart", fresh, "Discard the results of an earlier merge");
  AddQuiet(app, quiet);
  app.footer(
      "  merge --shards shards/plans.*.jsonl --output plans.jsonl\n"
      "  merge --shards shards/*/reports.jsonl --output reports.jsonl\n");
}

int MergeProgram::Run() const {
  std::vector<NamedFile> inputs;
  for (const std::string& shard : shards) inputs.push_back({"--shards", shard});
  OutputFiles outputs;
  outputs.Add("--output", output);
  outputs.Add("--output", output + kPartEnding);
  CheckOutputsDiffer(inputs, outputs);
  std::error_code error;
  if (std::filesystem::exists(output, error) && !std::filesystem::is_regular_file(output, error)) {
    throw regrasp::InputError("--output: " + output + ": must be a file");
  }
  const std::vector<ShardFile> found = FindShards({shards.begin(), shards.end()});
  CheckOutputsWritable(outputs);
  const OutcomeCounts counts = MergeLines(found, output, fresh);
  if (!quiet) PrintMessage(kProgram, output + ": " + OutcomeCountsText(counts));
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  MergeProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
