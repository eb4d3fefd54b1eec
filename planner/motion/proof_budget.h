#pragma once

#include <cstddef>
#include <cstdint>

namespace regrasp::motion {

/// Work that searches for proofs along motions may still do: pieces looked at, times their
/// contacts. Counted, not timed, so that the same input has the same answer on every machine; a
/// unit takes some ten microseconds.
class ProofBudget {
 public:
  explicit ProofBudget(std::int64_t units) : left_(units) {}

  /// @returns false where nothing is left.
  bool SpendPiece(std::size_t contacts) {
    if (left_ <= 0) return false;
    left_ -= static_cast<std::int64_t>(contacts);
    return true;
  }
  [[nodiscard]] std::int64_t left() const { return left_; }

 private:
  std::int64_t left_;
};

}  // namespace regrasp::motion
