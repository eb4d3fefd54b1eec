#include "apps/entry_names.h"

#include <algorithm>

namespace regrasp::apps {

namespace {

constexpr std::size_t kDigits = 3;

}  // namespace

std::string EntryNumber(plan::EntryIndex index) {
  const std::string number = std::to_string(index);
  return std::string(kDigits - std::min(kDigits, number.size()), '0') + number;
}

std::optional<std::string> AfterEntryNumber(const std::string& name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  if (digits < kDigits) return std::nullopt;
  return name.substr(digits);
}

std::string EntryFileName(plan::EntryIndex index, const std::string& kind,
                          const std::string& ending) {
  return EntryNumber(index) + "_" + kind + "." + ending;
}

bool IsEntryFileName(const std::string& name, const std::string& ending) {
  const auto rest = AfterEntryNumber(name);
  return rest == "_hold." + ending || rest == "_switch." + ending || rest == "_align." + ending;
}

}  // namespace regrasp::apps
