#include "apps/entry_names.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace regrasp::apps {

namespace {

constexpr std::size_t kEntryDigits = 3;

/// Return all kinds of entries.
std::vector<std::string> EntryKinds() {
  static_assert(std::variant_size_v<plan::Step> == 3, "a kind of step is missing below");
  return {"hold", plan::StepKind(plan::Switch()), plan::StepKind(plan::Align()),
          plan::StepKind(plan::Move())};
}

}  // namespace

std::string EntryNumber(plan::EntryIndex index) {
  const std::string number = std::to_string(index);
  return std::string(kEntryDigits - std::min(kEntryDigits, number.size()), '0') + number;
}

std::optional<std::string> AfterEntryNumber(const std::string& name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  if (digits < kEntryDigits) return std::nullopt;
  return name.substr(digits);
}

std::string EntryFileName(plan::EntryIndex index, const std::string& kind,
                          const std::string& ending) {
  return EntryNumber(index) + "_" + kind + "." + ending;
}

bool IsEntryFileName(const std::string& name, const std::string& ending) {
  const auto rest = AfterEntryNumber(name);
  if (!rest) return false;
  return std::ranges::any_of(
      EntryKinds(), [&](const std::string& kind) { return *rest == "_" + kind + "." + ending; });
}

}  // namespace regrasp::apps
