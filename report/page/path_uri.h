#pragma once

#include <string>
#include <string_view>

namespace regrasp::report {

/// A relative path as a link to it, "plan%231/report.html": bytes other than unreserved characters
/// (RFC 3986, 2.3) and slashes are written in percent, so that none is taken for a scheme, a query
/// or a fragment.
[[nodiscard]] std::string PathUri(std::string_view path);

}  // namespace regrasp::report
