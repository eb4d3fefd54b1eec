#pragma once

#include <compare>
#include <cstddef>
#include <functional>

namespace regrasp {

/// Index of elements of one kind. The tag identifies the kind, as at the end of this file.
/// Indices of different kinds cannot be assigned, converted or compared. An integer is converted
/// only explicitly: FaceIndex(3).
///
/// An index converts to int implicitly, like TypeSafeIndex of Drake. It can therefore be a
/// subscript of plain vectors, be compared with counts in loops, and be printed. The disadvantage
/// is that a function with an int parameter accepts every kind.
///
/// Laws: indices are ordered as their numbers. A default-constructed index is invalid.
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

/// Deleted, because indices of different kinds would otherwise be compared as integers.
template <class A, class B>
bool operator==(Index<A> a, Index<B> b) = delete;
template <class A, class B>
std::strong_ordering operator<=>(Index<A> a, Index<B> b) = delete;

/// Face of a solid, or edge of a polygon.
using FaceIndex = Index<struct FaceTag>;
/// Finger of the hand.
using FingerIndex = Index<struct FingerTag>;

}  // namespace regrasp

template <class Tag>
struct std::hash<regrasp::Index<Tag>> {
  std::size_t operator()(regrasp::Index<Tag> index) const noexcept {
    return std::hash<int>{}(index);
  }
};
