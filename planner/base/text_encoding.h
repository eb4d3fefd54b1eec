#pragma once

#include <string>
#include <string_view>

namespace regrasp {

/// Return the text of a file without its UTF-8 byte-order mark.
///
/// Every reader of text calls this function first, so that all of them accept the same files.
/// UTF-16 and UTF-32 are detected by their byte-order mark, or by the zero bytes in their first two
/// characters. Other bytes that are not UTF-8 are accepted here, because comments and names in
/// surface files can have any 8-bit encoding.
/// @param bytes  bytes of the file, or of its first line; must outlive the result.
/// @param name   name of the file in messages.
/// @returns the bytes after the mark.
/// @throws InputError  if the text is in UTF-16 or UTF-32.
[[nodiscard]] std::string_view TextOf(std::string_view bytes, const std::string& name);

}  // namespace regrasp
