#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/plan.h"
#include "report/report.h"

namespace regrasp::report {

/// A picture, ready to be put into a page.
struct PagePicture {
  std::string bytes;  ///< of its file; empty where there is no picture
  int width = 0;      ///< pixels, as is the height
  int height = 0;
  std::string_view media_type = "image/webp";  ///< of an image, or of a video that browsers play
  bool own_view = false;                       ///< not taken from where the others are
};

/// The text of report.html: what a report says, for people, as one HTML page that needs no other
/// file and no script: verdict, settings, plots of displacement and of the margin to the friction
/// cone over the steps, a table with a line per step, and the pictures.
///
/// Every text from outside is escaped, and the page forbids scripts and requests in its own header.
/// Well-formed XML too. Same report, same bytes.
/// @param plan      the one that was reported on, for the names of steps.
/// @param pictures  one per entry of the report, or none at all.
/// @param moving    of the whole replay, where there is one; left out on paper.
[[nodiscard]] std::string FormatReportHtml(const Report& report, const plan::Plan& plan,
                                           const std::vector<PagePicture>& pictures,
                                           const PagePicture& moving = {});

/// How wide a picture should be, pixels, so that a page of `count` of them can be sent by mail: the
/// more, the smaller.
[[nodiscard]] int PagePictureWidth(int count);

}  // namespace regrasp::report
