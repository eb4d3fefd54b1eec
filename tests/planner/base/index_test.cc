#include "planner/base/index.h"

#include <gtest/gtest.h>

#include <concepts>
#include <cstddef>
#include <sstream>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

namespace regrasp {
namespace index_test {

using Leaf = Index<struct LeafTag>;
using Root = Index<struct RootTag>;

template <class A, class B>
concept Equatable = requires(A a, B b) {
  a == b;
};
template <class A, class B>
concept Ordered = requires(A a, B b) {
  a < b;
};

// An integer is converted to an index only explicitly. An index is converted to an integer
// implicitly.
static_assert(std::is_constructible_v<Leaf, int> && !std::is_convertible_v<int, Leaf>);
static_assert(!std::is_assignable_v<Leaf&, int>);
static_assert(std::is_convertible_v<Leaf, int>);

// Indices of different kinds are neither converted nor compared.
static_assert(std::is_convertible_v<Leaf, Leaf> && !std::is_convertible_v<Root, Leaf>);
static_assert(std::is_constructible_v<Leaf, Leaf> && !std::is_constructible_v<Leaf, Root>);
static_assert(std::is_assignable_v<Leaf&, Leaf> && !std::is_assignable_v<Leaf&, Root>);
static_assert(Equatable<Leaf, Leaf> && Ordered<Leaf, Leaf>);
static_assert(!Equatable<Leaf, Root> && !Ordered<Leaf, Root>);
static_assert(Equatable<Leaf, int> && Ordered<Leaf, int>);

int Paint(Leaf leaf, Root root) { return 10 * leaf + root; }
static_assert(std::is_invocable_v<decltype(Paint), Leaf, Root>);
static_assert(!std::is_invocable_v<decltype(Paint), Root, Leaf>);
static_assert(!std::is_invocable_v<decltype(Paint), int, int>);

// An index has the size of an int and is trivially copyable.
static_assert(sizeof(Leaf) == sizeof(int) && std::is_trivially_copyable_v<Leaf>);

TEST(Index, IsNotValidUntilSomethingIsPutIntoIt) {
  EXPECT_FALSE(Leaf().valid());
  EXPECT_TRUE(Leaf(0).valid());
  EXPECT_EQ(Leaf(), Leaf(-1));
}

TEST(Index, OrdersAndCountsAsItsNumber) {
  EXPECT_LT(Leaf(2), Leaf(3));
  EXPECT_NE(Leaf(2), Leaf(3));
  int counted = 0;
  for (Leaf leaf{0}; leaf < 4; ++leaf) EXPECT_EQ(leaf, counted++);
  EXPECT_EQ(counted, 4);
}

TEST(Index, IsASubscriptAndAKeyAndPrintsItsNumber) {
  const std::vector<int> tens = {0, 10, 20};
  EXPECT_EQ(tens[Leaf(2)], 20);
  EXPECT_EQ((std::unordered_set<Leaf>{Leaf(1), Leaf(2), Leaf(1)}.size()), std::size_t{2});
  std::ostringstream out;
  out << Leaf(7);
  EXPECT_EQ(out.str(), "7");
}

TEST(Index, KeepsItsPlaceAmongArguments) { EXPECT_EQ(Paint(Leaf(3), Root(4)), 34); }

}  // namespace index_test
}  // namespace regrasp
