// repair: makes a closed solid from a scan, a broken mesh or several shells, and reports the
// changes.

#include "planner/repair/repair.h"

#include <string>

#include "apps/commands.h"
#include "apps/help.h"
#include "apps/options.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/object/read_object.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

constexpr char kProgram[] = "repair";

struct RepairProgram {
  std::string object;
  std::string output;
  std::string report;
  RepairOptions options;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run() const;
  void WriteReport(const Json& json) const;
};

void RepairProgram::AddTo(CLI::App& app) {
  BeginGroup(app, "Input");
  app.add_option("--object", object, "Scan or mesh (OBJ, OFF, PLY, STL, glTF, …)")
      ->type_name("FILE")
      ->required();
  BeginGroup(app, "Repair");
  options.AddTo(app);
  BeginGroup(app, "Output");
  app.add_option("-o,--output", output,
                 "Closed solid (OBJ). Its group `invented` contains the filled triangles, which "
                 "planners avoid")
      ->type_name("FILE")
      ->required();
  app.add_option("--report", report, "Report of all stages and their changes (JSON)")
      ->type_name("FILE");
  AddQuiet(app, quiet);
  app.footer(
      "  repair --object scan.ply --output solid.obj --report repair.json\n"
      "  repair --object pieces.obj --output solid.obj --repair part=1,max-triangles=5000\n");
}

int RepairProgram::Run() const {
  OutputFiles outputs;
  outputs.Add("--output", output);
  outputs.Add("--report", report);
  CheckOutputsDiffer({{"--object", object}}, outputs);
  CheckOutputsWritable(outputs);
  ProgressLine progress(quiet);
  object::Reading reading{progress.reporter(), {}};
  reading.shells = options.shells();
  const object::SoupFile file = object::ReadSoup(object, reading);
  try {
    const repair::Repaired repaired = repair::Repair(file.soup, object, options.Get(), reading);
    progress.Clear();
    WriteFile(output, repair::FormatSolid(repaired.solid));
    WriteReport(repair::RepairReport(repaired, file, options.Get()));
    if (!quiet) PrintMessage(kProgram, object + ": " + repair::RepairText(repaired));
    return kExitDone;
  } catch (const repair::NotRepaired& refusal) {
    WriteReport(repair::RefusalReport(refusal, file, options.Get()));
    throw;
  }
}

void RepairProgram::WriteReport(const Json& json) const {
  if (!report.empty()) WriteFile(report, FormatJson(json));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  RepairProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
