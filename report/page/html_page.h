#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

/// Bytes as a URI that holds them, "data:image/webp;base64,…".
[[nodiscard]] std::string DataUri(std::string_view media_type, std::string_view bytes);

/// A relative path as a link to it, "plan%231/report.html": bytes other than unreserved characters
/// (RFC 3986, 2.3) and slashes are written in percent, so that none is taken for a scheme, a query
/// or a fragment.
[[nodiscard]] std::string PathUri(std::string_view path);

/// Where a page may take its pictures from; it loads nothing else.
enum class PictureSource {
  kInPage,   ///< from the page alone (DataUri)
  kOwnSite,  ///< and from files beside it
};

/// The text of an HTML page in the style of report pages, which runs nothing, whatever stands in
/// it. Well-formed XML too.
/// @param parts  what stands in it, one below the other.
[[nodiscard]] std::string FormatHtmlPage(std::string_view title, const std::vector<Element>& parts,
                                         PictureSource pictures = PictureSource::kInPage);

/// A page's first lines: what it is in small letters, its subject, and the verdict with what it
/// says in words.
/// @param extent  text behind "Pass" or "Fail", as "in 14 of 20 trials"; may be empty.
[[nodiscard]] Element PageHeader(std::string_view kind, std::string_view subject, bool passed,
                                 std::string_view statement, std::string_view extent = "");

}  // namespace regrasp::report
