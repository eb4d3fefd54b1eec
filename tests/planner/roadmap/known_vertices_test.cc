#include <gtest/gtest.h>

#include "planner/roadmap/cluster_search.h"

namespace regrasp::roadmap {
namespace known_vertices_test {

TEST(KnownVertices, KeepWhatIsLearntOfEachVertexApart) {
  KnownVertices known(3, criteria::KnownGrasp::HeldAt(0.5));
  criteria::KnownGrasp& last = known[2];
  last.required = 0.25;
  known[0].required = 0.125;
  // Additional vertices do not invalidate references to earlier entries.
  EXPECT_EQ(&known[2], &last);
  EXPECT_EQ(known[2].required, 0.25);
  EXPECT_EQ(known[0].required, 0.125);
  EXPECT_EQ(known[1].required, criteria::KnownGrasp::kUnknown);
  EXPECT_EQ(known[1].holds_at, 0.5);
}

}  // namespace known_vertices_test
}  // namespace regrasp::roadmap
