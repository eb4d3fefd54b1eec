#include "planner/polyhedron/normal_quadruples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// Three unit normals whose volume is smaller than this are coplanar: roundings of normals that
/// would be, were they exact.
constexpr double kCoplanar = 1e-12;

/// tan φ* is rounded down by this share.
constexpr double kRoundedDown = 1e-12;

/// Sets of normals as bits.
class BitRow {
 public:
  explicit BitRow(std::size_t bits) : words_((bits + 63) / 64) {}
  void Set(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  [[nodiscard]] std::uint64_t word(std::size_t w) const { return words_[w]; }
  [[nodiscard]] std::size_t words() const { return words_.size(); }

 private:
  std::vector<std::uint64_t> words_;
};

/// The distance from the origin to the plane through the ends of three vectors.
double PlaneDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d across = (b - a).cross(c - a);
  return std::abs(across.dot(a)) / across.norm();
}

class QuadrupleFinder {
 public:
  QuadrupleFinder(const std::vector<Vector3d>& normals, double tangent, Spanning spanning)
      : normals_(normals),
        tangent_(tangent),
        least_(spanning == Spanning::kUniform ? tangent / std::sqrt(1 + tangent * tangent) : 0) {
    const std::size_t n = normals.size();
    left_.assign(n * n, BitRow(n));
    right_.assign(n * n, BitRow(n));
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b) {
        const Vector3d across = normals[a].cross(normals[b]);
        for (std::size_t k = 0; k < n; ++k) {
          const double volume = across.dot(normals[k]);
          if (volume > kCoplanar) left_[a * n + b].Set(k);
          if (volume < -kCoplanar) right_[a * n + b].Set(k);
        }
      }
    }
  }

  std::vector<QuadrupleCandidate> Find() {
    const int n = static_cast<int>(normals_.size());
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        for (int c = b + 1; c < n; ++c) FindFourth(a, b, c);
      }
    }
    return std::move(found_);
  }

 private:
  /// Normals inside the trihedron of the opposites of three, after the third.
  void FindFourth(int a, int b, int c) {
    const std::size_t n = normals_.size();
    const std::size_t ab = a * n + b;
    const std::size_t bc = b * n + c;
    const std::size_t ac = a * n + c;
    const auto bit = [&](const BitRow& row) { return (row.word(c / 64) >> (c % 64) & 1) != 0; };
    const bool turns_left = bit(left_[ab]);
    if (!turns_left && !bit(right_[ab])) return;
    const BitRow& of_ab = turns_left ? right_[ab] : left_[ab];
    const BitRow& of_bc = turns_left ? right_[bc] : left_[bc];
    const BitRow& of_ac = turns_left ? left_[ac] : right_[ac];
    double height = -1;  // of the plane of the three, once it is needed
    for (std::size_t w = c / 64; w < of_ab.words(); ++w) {
      std::uint64_t bits = of_ab.word(w) & of_bc.word(w) & of_ac.word(w);
      if (w == static_cast<std::size_t>(c) / 64) bits &= ~std::uint64_t{0} << (c % 64);
      if (bits != 0 && height < 0) {
        height = PlaneDistance(normals_[a], normals_[b], normals_[c]);
        if (height <= least_) return;
      }
      for (; bits != 0; bits &= bits - 1) {
        Add({a, b, c, static_cast<int>(64 * w) + std::countr_zero(bits)}, height);
      }
    }
  }

  void Add(const std::array<int, 4>& faces, double height) {
    const Vector3d& d = normals_[faces[3]];
    for (int k = 0; k < 3; ++k) {
      const Vector3d& one = normals_[faces[k]];
      const Vector3d& other = normals_[faces[(k + 1) % 3]];
      height = std::min(height, PlaneDistance(one, other, d));
    }
    if (height <= least_) return;
    const double limit = (1 - kRoundedDown) * height / std::sqrt(1 - height * height);
    found_.push_back({faces, std::min(tangent_, limit)});
  }

  const std::vector<Vector3d>& normals_;
  double tangent_;
  double least_;               ///< that φ*'s sine must exceed
  std::vector<BitRow> left_;   ///< for a < b: the normals on the left of the plane through both
  std::vector<BitRow> right_;  ///< those on the right
  std::vector<QuadrupleCandidate> found_;
};

}  // namespace

std::vector<QuadrupleCandidate> FindQuadrupleCandidates(const std::vector<Vector3d>& normals,
                                                        double tangent, Spanning spanning) {
  return QuadrupleFinder(normals, tangent, spanning).Find();
}

}  // namespace regrasp
