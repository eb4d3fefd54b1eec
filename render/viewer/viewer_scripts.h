#pragma once

#include <array>
#include <string_view>

namespace regrasp::render {

/// Return the scripts of the viewer in the order in which a page runs them: three.js with its
/// licence, its orbit controls, and the viewer itself.
///
/// They are classic scripts without modules, so that a page works as a file. None contains the end
/// of a script element, `<!--` or `]]>`.
[[nodiscard]] const std::array<std::string_view, 4>& ViewerScripts();

}  // namespace regrasp::render
