#include "apps/entry_names.h"

#include <gtest/gtest.h>

namespace regrasp::apps {
namespace entry_names_test {

TEST(EntryNames, SortAsTheirEntriesDo) {
  EXPECT_EQ(EntryFileName(plan::EntryIndex(0), "hold", "png"), "000_hold.png");
  EXPECT_EQ(EntryFileName(plan::EntryIndex(12), "align", "svg"), "012_align.svg");
  EXPECT_EQ(EntryFileName(plan::EntryIndex(1234), "switch", "pdf"), "1234_switch.pdf");
  EXPECT_LT(EntryFileName(plan::EntryIndex(9), "switch", "png"),
            EntryFileName(plan::EntryIndex(10), "align", "png"));
}

TEST(EntryNames, AreKnownByTheirNumberKindAndEnding) {
  int known = 0;
  for (const int number : {0, 7, 99, 1000}) {
    for (const char* kind : {"hold", "switch", "align", "move"}) {
      known += IsEntryFileName(EntryFileName(plan::EntryIndex(number), kind, "png"), "png") ? 1 : 0;
    }
  }
  EXPECT_EQ(known, 16);
  for (const char* other : {"00_hold.png", "000_hold.svg", "000_hold.png~", "000_rest.png", "000",
                            "x000_hold.png", "000hold.png", "_hold.png", ""}) {
    EXPECT_FALSE(IsEntryFileName(other, "png")) << other;
  }
}

TEST(EntryNames, ANumberIsAtLeastThreeDigitsAtTheBeginning) {
  EXPECT_EQ(AfterEntryNumber("003.svg"), ".svg");
  EXPECT_EQ(AfterEntryNumber("00345"), "");
  EXPECT_EQ(AfterEntryNumber("03.svg"), std::nullopt);
  EXPECT_EQ(AfterEntryNumber("a003"), std::nullopt);
}

}  // namespace entry_names_test
}  // namespace regrasp::apps
