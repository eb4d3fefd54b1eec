#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/plan.h"
#include "report/report.h"

namespace regrasp::report {

/// An image in the form that a page contains.
struct PagePicture {
  std::string bytes;  ///< bytes of the file; empty if there is no image
  int width = 0;      ///< width and height, pixels
  int height = 0;
  /// MIME type of an image, or of a video that browsers play
  std::string_view media_type = "image/webp";
  bool own_view = false;  ///< whether the camera differs from that of the other images
  /// Path of the file relative to the page. If it is set, the page links to the file instead of
  /// containing it.
  std::string file = {};
};

/// Largest animation that a page contains, bytes. A page with a larger one cannot be sent by mail.
inline constexpr std::size_t kLargestMoving = 4'000'000;

/// Row of a plan on the index page of a batch (DataTable).
struct IndexRow {
  std::string page = {};  ///< relative link to the index page; empty: no index
  std::string key = {};   ///< key of the row in links: page#plan=KEY
};

/// Return the text of report.html, a page that needs no other file unless its animation is linked.
/// It has the verdict, the interactive 3-D replay, settings, plots of displacement and friction
/// margin over the steps, a table with one line per step, and the images. Without scripts or WebGL
/// an image replaces the replay.
///
/// External text is escaped. The page's own header forbids requests and all scripts but those of
/// the replay. The page is also well-formed XML. The same report gives the same bytes.
/// @param plan      plan of the report, for the names of steps.
/// @param pictures  one image per entry of the report, or none at all.
/// @param moving    animation of the replay, if there is one; omitted in print.
/// @param viewer    data of the interactive replay (render::FormatViewerScene); empty: none.
/// @param finger_names  names of fingers by index; other fingers have their number.
/// @param index     row of the plan on an index page, which the page links to.
[[nodiscard]] std::string FormatReportHtml(const Report& report, const plan::Plan& plan,
                                           const std::vector<PagePicture>& pictures,
                                           const PagePicture& moving = {},
                                           std::string_view viewer = "",
                                           std::span<const std::string> finger_names = {},
                                           const IndexRow& index = {});

/// Return a page with the verdict and the interactive 3-D replay only.
/// @param viewer  data of the replay (render::FormatViewerScene).
[[nodiscard]] std::string FormatViewerHtml(const Report& report, const plan::Plan& plan,
                                           std::string_view viewer);

/// Return a page with the interactive 3-D replay of a plan that was not simulated.
/// It shows the planned motion without forces, and no verdict.
/// @param report  results of the analytic check only: steps without replay.
/// @param viewer  data of the replay (render::FormatViewerScene).
[[nodiscard]] std::string FormatPlanHtml(const Report& report, std::string_view viewer);

/// Return the width of an image in pixels with which a page of `count` images can be sent by mail.
[[nodiscard]] int PagePictureWidth(int count);

}  // namespace regrasp::report
