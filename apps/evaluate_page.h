#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace regrasp::apps {

/// Largest number of grasps on a page. Browsers open larger tables slowly.
inline constexpr std::size_t kMostPageRows = 50'000;

/// Content of the page that is not in the reports.
struct GraspPage {
  std::string grasps;  ///< name of the file of the grasps
  std::string images;  ///< path of the folder of images, relative to the page; empty: none
};

/// Return the file name of the image of a grasp, "000017.png".
[[nodiscard]] std::string GraspImageName(std::int64_t index);

/// Return whether GraspImageName returns this name for any grasp.
[[nodiscard]] bool IsGraspImageName(const std::string& name);

/// Return an HTML page with the counts of a file of reports and one row per grasp.
///
/// Grasps that fail are first. The page is self-contained: it loads nothing, and its only script,
/// which sorts and filters the rows, is permitted by its digest. Without scripts it is a table.
/// @param reports  file that `evaluate` wrote.
/// @throws InputError  if it is not such a file.
[[nodiscard]] std::string FormatGraspPage(const std::filesystem::path& reports,
                                          const GraspPage& page);

}  // namespace regrasp::apps
