#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace regrasp::render {

/// Points of a line; the last one equals the first one if it is closed.
using Polyline = std::vector<Eigen::Vector2d>;

/// Sides between the samples of an image that belong to a line drawing.
///
/// A node (x, y) is the upper left corner of sample (x, y). A side goes from a node to its right or
/// lower neighbour.
class SampleSides {
 public:
  /// Create an empty set for an image of width × height samples.
  SampleSides(int width, int height);

  /// Add all inner sides between two different samples for which `differs` is true.
  /// @param differs  symmetric function of two neighbouring samples (x, y) and (x2, y2).
  void AddBetween(const std::function<bool(int x, int y, int x2, int y2)>& differs);

  /// Return the sides as lines with few points, in samples.
  ///
  /// Lines end where three or more sides meet, after the removal of very short ones. They pass
  /// through the middles of sides, and are simplified with a tolerance of kLineTolerance (Douglas
  /// and Peucker 1973).
  /// @param shortest  connected sets of sides with a smaller total length are omitted, and so are
  ///                  lines of less than a quarter of it with a free end, samples.
  [[nodiscard]] std::vector<Polyline> Trace(double shortest) const;

  /// Return the sides as closed, smoothed and simplified lines. Every node must have an even number
  /// of sides.
  [[nodiscard]] std::vector<Polyline> TraceLoops() const;

 private:
  using Chain = std::vector<Eigen::Vector2i>;  ///< successive nodes
  using Sides = std::vector<unsigned char>;    ///< bits per node: right, down, left, up

  [[nodiscard]] std::size_t Index(int x, int y) const { return std::size_t(y) * (width_ + 1) + x; }
  [[nodiscard]] bool Has(const Sides& sides, const Eigen::Vector2i& node, int direction) const;
  void Set(const Eigen::Vector2i& node, int direction, bool value, Sides& sides) const;
  [[nodiscard]] int Degree(const Eigen::Vector2i& node) const;
  [[nodiscard]] Chain Walk(Eigen::Vector2i node, int direction, bool through, Sides& left) const;
  [[nodiscard]] std::vector<Polyline> TraceAll(double shortest) const;
  void Prune(std::size_t shortest_end);
  void WalkAll(bool from_ends, bool through, Sides& left, std::vector<Chain>& chains) const;

  int width_, height_;
  Sides sides_;
};

/// Tolerance of simplified lines, samples.
inline constexpr double kLineTolerance = 1;

/// Return the line with the fewest points within a tolerance (Douglas and Peucker 1973).
[[nodiscard]] Polyline Simplified(const Polyline& line, double tolerance = kLineTolerance);

/// Return the outlines of the samples that a predicate selects, as closed and simplified lines.
/// Filled with the even-odd rule they cover these samples, except that ragged borders are smoothed.
/// @param smallest  outlines of parts and holes whose width and height are smaller are omitted,
///                  samples.
[[nodiscard]] std::vector<Polyline> OutlineOf(int width, int height, double smallest,
                                              const std::function<bool(int x, int y)>& selects);

}  // namespace regrasp::render
