#pragma once

#include <string>

#include "apps/batch/batch_summary.h"

namespace regrasp::apps {

/// Format index.html, the overview page of a batch, which is written next to the folders of the
/// plans.
/// Plans that did not pass come first, each group in the order of the batch. Each plan has its
/// verdict in words, the image of the failed step or the overview image, its weakest step, its
/// size, and a link to its own page.
///
/// Every external text is escaped. The same plans give the same bytes, regardless of reused results
/// and of the number of jobs.
[[nodiscard]] std::string FormatBatchPage(const BatchSummary& summary);

}  // namespace regrasp::apps
