#pragma once

#include <compare>
#include <cstddef>
#include <functional>

namespace regrasp {

/// A number that names one thing of a kind; a tag makes a kind, as at the end of this file. An
/// index of one kind is neither taken for, made from, nor compared with one of another. A plain
/// number becomes an index only where that is said: FaceIndex(3).
///
/// An index converts to int by itself, as Drake's TypeSafeIndex does: what belongs to the things
/// stands in plain vectors and is found by subscript, loops compare with a count, and messages
/// print the number. The price is that a function that takes an int takes every kind.
///
/// Laws: the order is that of the numbers; an index that nothing was put into is not valid.
template <class Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(int value) : value_(value) {}
  template <class Other>
  Index(Index<Other> other) = delete;

  // NOLINTNEXTLINE(google-explicit-constructor): see above
  constexpr operator int() const { return value_; }
  [[nodiscard]] constexpr bool valid() const { return value_ >= 0; }

  constexpr Index& operator++() {
    ++value_;
    return *this;
  }

  friend constexpr bool operator==(Index a, Index b) { return a.value_ == b.value_; }
  friend constexpr std::strong_ordering operator<=>(Index a, Index b) {
    return a.value_ <=> b.value_;
  }

 private:
  int value_ = -1;
};

/// Without these, indices of two kinds would be compared as ints.
template <class A, class B>
bool operator==(Index<A> a, Index<B> b) = delete;
template <class A, class B>
std::strong_ordering operator<=>(Index<A> a, Index<B> b) = delete;

/// A face of an object, an edge of a polygon.
using FaceIndex = Index<struct FaceTag>;
/// A finger of the hand.
using FingerIndex = Index<struct FingerTag>;

}  // namespace regrasp

template <class Tag>
struct std::hash<regrasp::Index<Tag>> {
  std::size_t operator()(regrasp::Index<Tag> index) const noexcept {
    return std::hash<int>{}(index);
  }
};
