// Module regrasp_repair.so: planner/repair for programs that load it at its first use.

#include "apps/repair_module.h"
#include "planner/repair/repair.h"

extern "C" const regrasp::apps::RepairFunctions* regrasp_repair_functions() {
  static const regrasp::apps::RepairFunctions functions = {&regrasp::repair::ReadRepaired,
                                                           &regrasp::repair::RepairHint};
  return &functions;
}
