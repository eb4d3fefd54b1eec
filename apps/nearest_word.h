#pragma once

#include <string>
#include <vector>

namespace regrasp::apps {

/// Return "; similar: --object" for the most similar of some words; empty if none is similar.
///
/// A word that starts with the given text is similar. Otherwise similarity is the number of
/// insertions, deletions, replacements and transpositions (Damerau 1964), at most one per three
/// characters; the first of equally similar words is taken.
[[nodiscard]] std::string SimilarWord(const std::string& given,
                                      const std::vector<std::string>& words);

}  // namespace regrasp::apps
