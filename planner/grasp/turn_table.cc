#include "planner/grasp/turn_table.h"

namespace regrasp::grasp {

TurnTable::TurnTable(std::span<const UnitContact> contacts)
    : count_(static_cast<int>(contacts.size())),
      words_((count_ + kWordBits - 1) / kWordBits),
      by_contact_(Row(Pair(count_, 0))),
      by_line_(Row(Pair(count_, 0))),
      antipodal_(Row(count_)) {
  for (int a = 0; a < count_; ++a) {
    for (int b = a + 1; b < count_; ++b) {
      for (int c = 0; c < count_; ++c) {
        if (c == a || c == b) continue;
        Store(a, b, c, TurnAboutLine(contacts[a], contacts[b], contacts[c]));
      }
      if (IsAntipodal(contacts[a], contacts[b])) {
        Set(&antipodal_[Row(a)], b);
        Set(&antipodal_[Row(b)], a);
      }
    }
  }
}

void TurnTable::Store(int a, int b, int c, Turn turn) {
  if (turn == Turn::kUnclear) return;
  if (turn == Turn::kNone) {
    Store(a, b, c, Turn::kPositive);
    Store(a, b, c, Turn::kNegative);
    return;
  }
  const int kind = turn == Turn::kPositive ? 0 : turn == Turn::kNegative ? 1 : 2;
  Set(&by_contact_[Row(Pair(a, b) + kind)], c);
  Set(&by_contact_[Row(Pair(b, a) + kind)], c);
  Set(&by_line_[Row(Pair(a, c) + kind)], b);
  Set(&by_line_[Row(Pair(b, c) + kind)], a);
}

}  // namespace regrasp::grasp
