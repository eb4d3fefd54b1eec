#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/figures/region_lines.h"
#include "render/figures/solid_figure.h"
#include "render/frames/body_shape.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/caption.h"

namespace regrasp::render {

/// A parallel projection to a panel.
struct PanelCamera {
  Eigen::Matrix3d axes;
  double scale;              ///< scale, points per diameter
  Eigen::Vector2d top_left;  ///< coordinates of the panel's corner along right and up

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d flat = (axes.transpose() * p).head<2>();
    return {scale * (flat.x() - top_left.x()), scale * (top_left.y() - flat.y())};
  }
  [[nodiscard]] Eigen::Vector3d back() const { return axes.col(2); }
  /// Return the same projection for points of a frame with this pose.
  [[nodiscard]] PanelCamera InFrame(const Eigen::Isometry3d& pose) const;
};

/// Draws a solid and its fingers as a line drawing. All lengths are in diameters, in the frame of
/// the solid.
class SolidPainter {
 public:
  /// @param body  must outlive the painter.
  SolidPainter(cairo_t* cr, const BodyShape& body, const PanelCamera& camera);

  /// Draw the area of the solid and its hidden edges.
  void DrawBody();
  void DrawVisibleEdges();
  /// Draw the visible edges as the ghost of a former pose.
  void DrawGhost(Color color);
  /// Draw the outline of a cone: its apex and the visible part of its rim.
  void DrawCone(const FingerGlyph& glyph, double friction_angle);
  void DrawStem(const FingerGlyph& glyph);
  /// Draw the arrow of a finger that moves.
  void DrawMotion(const FingerGlyph& glyph);
  /// Return the markers of the starts of sliding fingers, then of the contacts.
  [[nodiscard]] std::vector<FingerMarker> MarkersOf(const std::vector<FingerGlyph>& fingers) const;
  /// Draw the numbers of fingers, or their names.
  /// @param names    names of fingers by index; other fingers have their number.
  /// @param covered  further areas that numbers should not cover, points.
  void DrawNumbers(const std::vector<FingerGlyph>& fingers,
                   const std::vector<FingerMarker>& markers, const Eigen::Vector2d& size,
                   std::span<const std::string> names = {}, std::span<const Obstacle> covered = {});

 private:
  [[nodiscard]] LineParts Edges() const;
  [[nodiscard]] bool IsBehind(const FingerGlyph& glyph) const;
  void DrawLine(const LineSegment& line, Color color, double width);

  [[nodiscard]] bool IsScan() const { return !body_.shell.triangles.empty(); }
  void FillScan();
  void FillTints();
  void StrokeScan(double width) const;

  cairo_t* cr_;
  const BodyShape& body_;
  PanelCamera camera_;
  LineParts edges_;
  std::vector<Polyline> outlines_;  ///< visible outlines of a scan, points
};

}  // namespace regrasp::render
