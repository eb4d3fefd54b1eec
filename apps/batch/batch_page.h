#pragma once

#include <string>

#include "apps/batch/batch_summary.h"

namespace regrasp::apps {

/// Format index.html, the overview page of a batch.
///
/// It is written next to the folders of the plans. It has a table with a row per plan
/// (report::DataTable): plans that did not pass first, the worst at the top, each group in the
/// order of the batch. A row has an image, a link to the report of the plan, verdict, reason,
/// friction margin, steps, object and planner. The image is the frame of the failed step, otherwise
/// of the weakest step.
///
/// External text is escaped. The page loads only images of the plans' folders, and permits only its
/// own script by its digest. The same plans give the same bytes, regardless of reused results and
/// of the number of jobs.
[[nodiscard]] std::string FormatBatchPage(const BatchSummary& summary);

/// Return the key of a plan in links to its row, as in index.html#plan=KEY.
[[nodiscard]] std::string PlanKey(const std::string& name);

}  // namespace regrasp::apps
