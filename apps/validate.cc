// validate: checks a plan, a library of plans or grasps analytically, replays it in MuJoCo and
// draws a frame of each step. The result is pass or fail. With --export-states, it makes states in
// which a hand holds an object.

#include "apps/commands.h"
#include "apps/explain.h"
#include "apps/program.h"
#include "apps/validate_options.h"
#include "apps/validate_run.h"

int main(int argc, char** argv) {
  using namespace regrasp::apps;
  using namespace regrasp;
  CLI::App app(CommandText(kValidateName), kValidateName);
  ValidateOptions options;
  options.AddTo(app);
  AddExplain(app);
  return RunProgram(app, argc, argv, [&] {
    options.Finish(app);
    if (options.for_states()) return RunStates(options);
    if (options.for_grasps()) return RunGrasps(options);
    if (options.for_lines()) return RunValidateLines(options);
    return options.for_batch() ? RunBatch(options) : RunValidation(options).exit_code;
  });
}
