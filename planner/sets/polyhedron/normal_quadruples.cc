#include "planner/sets/polyhedron/normal_quadruples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace regrasp::polyhedron {

using Eigen::Vector3d;

namespace {

/// Volume of three unit normals below which they are coplanar up to rounding.
constexpr double kCoplanar = 1e-12;

/// Fraction by which tan φ* is rounded down.
constexpr double kRoundedDown = 1e-12;

/// Set of normals for each pair of normals, as bits.
class PairRows {
 public:
  explicit PairRows(std::size_t count)
      : count_(count), words_((count + 63) / 64), bits_(count * count * words_) {}
  [[nodiscard]] std::uint64_t* Row(std::size_t a, std::size_t b) {
    return &bits_[(a * count_ + b) * words_];
  }
  [[nodiscard]] std::size_t words() const { return words_; }

 private:
  std::size_t count_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// Compute the distance from the origin to the plane through the ends of three vectors.
double PlaneDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d across = (b - a).cross(c - a);
  return std::abs(across.dot(a)) / across.norm();
}

class QuadrupleFinder {
 public:
  /// @param deadline  must outlive this object.
  QuadrupleFinder(const std::vector<Vector3d>& normals, double tangent, planning::Spanning spanning,
                  const Deadline& deadline)
      : normals_(normals),
        tangent_(tangent),
        deadline_(deadline),
        least_(spanning == planning::Spanning::kUniform ? tangent / std::sqrt(1 + tangent * tangent)
                                                        : 0),
        left_(normals.size()),
        right_(normals.size()) {
    const std::size_t n = normals.size();
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b) {
        deadline.Check();
        const Vector3d across = normals[a].cross(normals[b]);
        std::uint64_t* left = left_.Row(a, b);
        std::uint64_t* right = right_.Row(a, b);
        for (std::size_t k = 0; k < n; ++k) {
          const double volume = across.dot(normals[k]);
          left[k / 64] |= std::uint64_t{volume > kCoplanar} << (k % 64);
          right[k / 64] |= std::uint64_t{volume < -kCoplanar} << (k % 64);
        }
      }
    }
  }

  std::vector<QuadrupleCandidate> Find() {
    const int n = static_cast<int>(normals_.size());
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        deadline_.Check();
        if (!MaySpan(a, b)) continue;
        for (int c = b + 1; c < n; ++c) FindFourth(a, b, c);
      }
    }
    return std::move(found_);
  }

 private:
  /// Return whether two normals can be in a quadruple. A plane through two ends is at most as far
  /// from the origin as the midpoint between them.
  [[nodiscard]] bool MaySpan(int a, int b) const {
    return (normals_[a] + normals_[b]).squaredNorm() > 4 * least_ * least_;
  }

  /// Find the normals after c inside the trihedron of the opposites of a, b and c.
  void FindFourth(int a, int b, int c) {
    const auto has_c = [&](const std::uint64_t* row) { return (row[c / 64] >> (c % 64) & 1) != 0; };
    const bool turns_left = has_c(left_.Row(a, b));
    if (!turns_left && !has_c(right_.Row(a, b))) return;
    const std::uint64_t* of_ab = (turns_left ? right_ : left_).Row(a, b);
    const std::uint64_t* of_bc = (turns_left ? right_ : left_).Row(b, c);
    const std::uint64_t* of_ac = (turns_left ? left_ : right_).Row(a, c);
    double height = -1;  // distance of the plane through the three; computed on demand
    for (std::size_t w = c / 64; w < left_.words(); ++w) {
      std::uint64_t bits = of_ab[w] & of_bc[w] & of_ac[w];
      if (w == static_cast<std::size_t>(c) / 64) bits &= ~std::uint64_t{0} << (c % 64);
      if (bits != 0 && height < 0) {
        height = PlaneDistance(normals_[a], normals_[b], normals_[c]);
        if (height <= least_) return;
      }
      for (; bits != 0; bits &= bits - 1) {
        const int d = static_cast<int>(64 * w) + std::countr_zero(bits);
        Add({FaceIndex(a), FaceIndex(b), FaceIndex(c), FaceIndex(d)}, height);
      }
    }
  }

  void Add(const FaceQuadruple& faces, double height) {
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
  const Deadline& deadline_;
  double least_;    ///< lower bound on sin φ*
  PairRows left_;   ///< normals on the left of the plane through a and b, a < b
  PairRows right_;  ///< normals on the right of it
  std::vector<QuadrupleCandidate> found_;
};

}  // namespace

std::vector<QuadrupleCandidate> FindQuadrupleCandidates(const std::vector<Vector3d>& normals,
                                                        double tangent, planning::Spanning spanning,
                                                        const Deadline& deadline) {
  return QuadrupleFinder(normals, tangent, spanning, deadline).Find();
}

std::vector<QuadrupleCandidate> FindQuadrupleCandidates(const object::Polyhedron& solid,
                                                        double tangent, planning::Spanning spanning,
                                                        const Deadline& deadline) {
  std::vector<FaceIndex> faces;
  std::vector<Vector3d> normals;
  for (FaceIndex face{0}; face < solid.face_count(); ++face) {
    if (!solid.TakesFingers(face)) continue;
    faces.push_back(face);
    normals.push_back(solid.inward_normal(face));
  }
  std::vector<QuadrupleCandidate> candidates =
      FindQuadrupleCandidates(normals, tangent, spanning, deadline);
  for (QuadrupleCandidate& candidate : candidates) {
    for (FaceIndex& face : candidate.faces) face = faces[face];
  }
  return candidates;
}

}  // namespace regrasp::polyhedron
