#include "apps/nearest_word.h"

#include <algorithm>
#include <limits>

namespace regrasp::apps {

namespace {

/// Return the number of edits, by dynamic programming over prefixes.
int Distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({replaced, d[i - 1][j] + 1, d[i][j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d.back().back();
}

}  // namespace

std::string SimilarWord(const std::string& given, const std::vector<std::string>& words) {
  // Maximum length of the given text, above all words with plausible misspellings.
  constexpr std::size_t kLongest = 64;
  constexpr int kCharactersAnEdit = 3;
  if (given.size() > kLongest) return "";
  std::string nearest;
  int least = std::numeric_limits<int>::max();
  for (const std::string& word : words) {
    const bool begun = given.size() >= kCharactersAnEdit && word.starts_with(given);
    const int distance = begun ? 0 : Distance(given, word);
    if (distance < least) {
      least = distance;
      nearest = word;
    }
  }
  const int most = std::max(1, static_cast<int>(given.size()) / kCharactersAnEdit);
  return least <= most ? "; similar: " + nearest : "";
}

}  // namespace regrasp::apps
