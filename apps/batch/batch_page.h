#pragma once

#include <string>

#include "apps/batch/batch_summary.h"

namespace regrasp::apps {

/// The text of index.html, beside the folders of the plans: all plans of a batch, for people. What
/// did not pass comes first, then in the order of the batch; of each its verdict in words, the
/// frame of what failed or the sheet of all frames, what is weakest, size, and a link to its own
/// page.
///
/// Every text from outside is escaped. The same plans give the same bytes, whatever was kept and
/// however many ran at once.
[[nodiscard]] std::string FormatBatchPage(const BatchSummary& summary);

}  // namespace regrasp::apps
