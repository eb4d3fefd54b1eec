#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

/// Return bytes as a data URI, "data:image/webp;base64,…".
[[nodiscard]] std::string DataUri(std::string_view media_type, std::string_view bytes);

/// Return a relative path as a link, "plan%231/report.html".
/// Bytes other than unreserved characters (RFC 3986, 2.3) and slashes are percent-encoded, so that
/// none is read as a scheme, a query or a fragment.
[[nodiscard]] std::string PathUri(std::string_view path);

/// Permitted sources of a page's images, which are all that a page loads.
enum class PictureSource {
  kInPage,   ///< in the page (DataUri)
  kOwnSite,  ///< also files in the folder of the page
};

/// Return an HTML page in the style of report pages.
///
/// Its content security policy permits no scripts but the given ones, by their digests, and no
/// requests. The page is also well-formed XML.
/// @param parts    elements of the page, from top to bottom.
/// @param scripts  scripts that run after the page was read; never text from input.
/// @param style    style sheet after that of report pages; never text from input.
[[nodiscard]] std::string FormatHtmlPage(std::string_view title, const std::vector<Element>& parts,
                                         PictureSource pictures = PictureSource::kInPage,
                                         std::span<const std::string_view> scripts = {},
                                         std::string_view style = {});

/// Append a text to an element. The names of options in it, "--friction-angle", do not break across
/// lines.
[[nodiscard]] Element WithOptions(Element element, std::string_view text);

/// Return the head of a page: its kind in small letters, its subject, and the verdict with a
/// summary.
/// @param extent  text after "Pass" or "Fail", for example "in 14 of 20 trials"; may be empty.
[[nodiscard]] Element PageHeader(std::string_view kind, std::string_view subject, bool passed,
                                 std::string_view statement, std::string_view extent = "");

}  // namespace regrasp::report
