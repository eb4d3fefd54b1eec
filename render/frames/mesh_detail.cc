#include "render/frames/mesh_detail.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Cosine of the largest rotation of a triangle, and of the largest change of a corner's normal.
constexpr double kLeastTurnCosine = 0.5;
/// Area of a triangle per squared longest side, below which it has no reliable normal.
constexpr double kSliverArea = 1e-3;
/// Rounding error of squared distances, relative to the squared size of the mesh.
constexpr double kQuadricRounding = 1e-13;
/// Shares of the largest squared distance that are permitted one after the other, so that vertices
/// of small error disappear first.
constexpr std::array<double, 3> kErrorShares = {0.01, 0.1, 1};
/// Largest number of passes over the vertices per share, and share of removed vertices below which
/// a pass is the last.
constexpr int kMostPasses = 8;
constexpr double kLastPassShare = 0.02;
/// Weight of the squared edge length in the order of candidates. Short edges disappear first if
/// errors are equal, which avoids thin triangles.
constexpr double kLengthWeight = 1e-4;

/// The sum of the squared distances to planes.
class Quadric {
 public:
  /// Add the plane through a point with a unit normal.
  void Add(const Vector3d& normal, const Vector3d& point) {
    const double offset = -normal.dot(point);
    products_ += normal * normal.transpose();
    linear_ += offset * normal;
    constant_ += offset * offset;
  }
  void Add(const Quadric& other) {
    products_ += other.products_;
    linear_ += other.linear_;
    constant_ += other.constant_;
  }
  [[nodiscard]] double operator()(const Vector3d& p) const {
    return p.dot(products_ * p) + 2 * linear_.dot(p) + constant_;
  }

 private:
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero();
  Vector3d linear_ = Vector3d::Zero();
  double constant_ = 0;
};

/// Moves vertices of a mesh to their neighbours.
class DetailReducer {
 public:
  DetailReducer(const ShadedMesh& mesh, double tolerance)
      : welded_(Weld(mesh)),
        normals_(mesh.normals),
        quadrics_(welded_.vertices.size()),
        triangles_at_(welded_.vertices.size()),
        marks_(welded_.vertices.size(), 0) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : welded_.vertices) box.extend(p);
    // Coordinates relative to the middle have the smallest rounding errors.
    for (const Vector3d& p : welded_.vertices) points_.push_back(p - box.center());
    largest_ = tolerance * tolerance + kQuadricRounding * box.sizes().squaredNorm();
    for (int t = 0; t < std::ssize(welded_.triangles); ++t) AddTriangle(t);
    AddBorders();
  }

  [[nodiscard]] ShadedMesh Reduce() {
    for (const double share : kErrorShares) {
      for (int pass = 0; pass < kMostPasses; ++pass) {
        const auto left = static_cast<double>(points_.size()) - removed_;
        if (Pass(share * largest_) <= kLastPassShare * left) break;
      }
    }
    ShadedMesh reduced;
    for (std::size_t t = 0; t < welded_.triangles.size(); ++t) {
      const auto& [a, b, c] = welded_.triangles[t];
      if (a < 0) continue;
      reduced.Add({welded_.vertices[a], welded_.vertices[b], welded_.vertices[c]}, normals_[t]);
    }
    return reduced;
  }

 private:
  /// Register a triangle at its vertices. One without area disappears.
  void AddTriangle(int t) {
    auto& [a, b, c] = welded_.triangles[t];
    if (a == b || b == c || c == a) {
      a = -1;
      return;
    }
    const Vector3d across = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    for (const int vertex : {a, b, c}) {
      triangles_at_[vertex].push_back(t);
      if (across.norm() > 0) quadrics_[vertex].Add(across.normalized(), points_[a]);
    }
  }

  /// Add planes through the open borders, perpendicular to their triangles.
  void AddBorders() {
    for (const std::array<int, 3>& triangle : welded_.triangles) {
      if (triangle[0] < 0) continue;
      for (int i = 0; i < 3; ++i) {
        const int a = triangle[i], b = triangle[(i + 1) % 3], c = triangle[(i + 2) % 3];
        if (SharedTriangles(a, b) != 1) continue;
        const Vector3d side = points_[b] - points_[a];
        const Vector3d outward = side.cross(side.cross(points_[c] - points_[a]));
        if (!(outward.norm() > 0)) continue;
        for (const int vertex : {a, b}) quadrics_[vertex].Add(outward.normalized(), points_[a]);
      }
    }
  }

  [[nodiscard]] bool Has(int t, int vertex) const {
    return std::ranges::find(welded_.triangles[t], vertex) != welded_.triangles[t].end();
  }

  [[nodiscard]] int SharedTriangles(int u, int v) const {
    return static_cast<int>(
        std::ranges::count_if(triangles_at_[u], [&](int t) { return Has(t, v); }));
  }

  /// Mark the neighbours of a vertex with a new mark.
  /// @returns the neighbours.
  const std::vector<int>& MarkNeighbours(int u) {
    ++mark_;
    neighbours_.clear();
    marks_[u] = mark_;
    for (const int t : triangles_at_[u]) {
      for (const int v : welded_.triangles[t]) {
        if (marks_[v] == mark_) continue;
        marks_[v] = mark_;
        neighbours_.push_back(v);
      }
    }
    return neighbours_;
  }

  /// Visit every vertex once.
  /// @returns the number of removed vertices.
  int Pass(double largest) {
    const int before = removed_;
    for (int u = 0; u < std::ssize(points_); ++u) {
      if (triangles_at_[u].empty()) continue;
      candidates_.clear();
      for (const int v : MarkNeighbours(u)) {
        const double error = quadrics_[u](points_[v]) + quadrics_[v](points_[v]);
        if (error > largest) continue;
        candidates_.emplace_back(error + kLengthWeight * (points_[u] - points_[v]).squaredNorm(),
                                 v);
      }
      std::ranges::sort(candidates_);
      for (const auto& [order, v] : candidates_) {
        if (!KeepsTopology(u, v) || !KeepsDirections(u, v)) continue;
        Collapse(u, v);
        break;
      }
    }
    return removed_ - before;
  }

  /// Return whether the common neighbours of u, which is marked, and v are those of their common
  /// triangles. Otherwise parts of the surface would coincide.
  bool KeepsTopology(int u, int v) {
    int common = 0;
    counted_.clear();
    for (const int t : triangles_at_[v]) {
      for (const int w : welded_.triangles[t]) {
        if (w == u || w == v || marks_[w] != mark_) continue;
        if (std::ranges::find(counted_, w) != counted_.end()) continue;
        counted_.push_back(w);
        ++common;
      }
    }
    const int shared = SharedTriangles(u, v);
    return shared <= 2 && common == shared;
  }

  /// Return whether no triangle and no normal changes its direction much.
  [[nodiscard]] bool KeepsDirections(int u, int v) const {
    return std::ranges::all_of(triangles_at_[u], [&](int t) {
      if (Has(t, v)) return true;
      const std::array<int, 3>& corners = welded_.triangles[t];
      const auto i = std::ranges::find(corners, u) - corners.begin();
      const Vector3d& b = points_[corners[(i + 1) % 3]];
      const Vector3d& c = points_[corners[(i + 2) % 3]];
      const Vector3d before = (b - points_[u]).cross(c - points_[u]);
      const Vector3d after = (b - points_[v]).cross(c - points_[v]);
      const auto is_sliver = [&](const Vector3d& across, const Vector3d& p) {
        const double longest =
            std::max({(b - p).squaredNorm(), (c - p).squaredNorm(), (b - c).squaredNorm()});
        return across.norm() < kSliverArea * longest;
      };
      const bool was_sliver = is_sliver(before, points_[u]);
      if (!was_sliver && is_sliver(after, points_[v])) return false;
      if (!was_sliver && before.dot(after) < kLeastTurnCosine * before.norm() * after.norm()) {
        return false;
      }
      const Vector3d& normal = normals_[t][i];
      return normal.dot(NormalAt(v, normal)) >= kLeastTurnCosine;
    });
  }

  /// Return the corner normal at a vertex that is closest to a direction.
  [[nodiscard]] Vector3d NormalAt(int vertex, const Vector3d& direction) const {
    Vector3d best = Vector3d::Zero();
    double most = -2;
    for (const int t : triangles_at_[vertex]) {
      for (int i = 0; i < 3; ++i) {
        if (welded_.triangles[t][i] != vertex) continue;
        const double cosine = normals_[t][i].dot(direction);
        if (cosine <= most) continue;
        most = cosine;
        best = normals_[t][i];
      }
    }
    return best;
  }

  /// Move u to v.
  void Collapse(int u, int v) {
    // The normals at v must be known before its triangles change.
    for (const int t : triangles_at_[u]) {
      for (int i = 0; i < 3; ++i) {
        if (welded_.triangles[t][i] == u) normals_[t][i] = NormalAt(v, normals_[t][i]);
      }
    }
    for (const int t : triangles_at_[u]) {
      std::array<int, 3>& corners = welded_.triangles[t];
      if (Has(t, v)) {
        for (const int w : corners) {
          if (w != u) std::erase(triangles_at_[w], t);
        }
        corners[0] = -1;
        continue;
      }
      std::ranges::replace(corners, u, v);
      triangles_at_[v].push_back(t);
    }
    triangles_at_[u] = {};
    quadrics_[v].Add(quadrics_[u]);
    ++removed_;
  }

  WeldedMesh welded_;  ///< triangles with a first index of −1 no longer exist
  std::vector<std::array<Vector3d, 3>> normals_;
  std::vector<Vector3d> points_;
  std::vector<Quadric> quadrics_;
  std::vector<std::vector<int>> triangles_at_;  ///< empty for removed vertices
  double largest_ = 0;                          ///< largest squared distance
  int removed_ = 0;
  // Buffers.
  std::vector<int> marks_, neighbours_, counted_;
  int mark_ = 0;
  std::vector<std::pair<double, int>> candidates_;
};

}  // namespace

ShadedMesh ReduceDetail(const ShadedMesh& mesh, double tolerance) {
  if (!mesh.colors.empty()) return mesh;
  return DetailReducer(mesh, tolerance).Reduce();
}

}  // namespace regrasp::render
