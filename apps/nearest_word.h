#pragma once

#include <string>
#include <vector>

namespace regrasp::apps {

/// Return "; similar: --object" for the most similar word, or an empty text.
///
/// A word that starts with the given text is similar. Otherwise similarity is the number of
/// insertions, deletions, replacements and transpositions (Damerau 1964). At most one per three
/// characters is permitted. If several words are equally similar, the first is returned.
[[nodiscard]] std::string SimilarWord(const std::string& given,
                                      const std::vector<std::string>& words);

}  // namespace regrasp::apps
