#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "render/figures/panel_sheet.h"
#include "render/frames/body_shape.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/shaded_mesh.h"
#include "render/frames/viewpoint.h"

namespace regrasp::render {

using LineSegment = std::array<Eigen::Vector3d, 2>;

/// Parts of lines that a surface does not hide, and parts that it hides.
struct LineParts {
  std::vector<LineSegment> visible;
  std::vector<LineSegment> hidden;
};

/// Split lines at the points of changing visibility, in a parallel projection.
///
/// Each line is sampled in steps of kVisibilityStep, and changes are located to within 1e-5 of a
/// step. Shorter hidden or visible parts can be missed. A surface does not hide lines that lie on
/// it. The size of the surface must be about 1.
/// @param back  unit vector towards the eye.
[[nodiscard]] LineParts SplitByVisibility(const RayTree& surface,
                                          std::span<const LineSegment> lines,
                                          const Eigen::Vector3d& back);

inline constexpr double kVisibilityStep = 0.01;

/// Return whether a surface hides a point.
[[nodiscard]] bool IsHidden(const RayTree& surface, const Eigen::Vector3d& point,
                            const Eigen::Vector3d& back);

struct SolidFigureOptions {
  BodyOptions body = {};
  /// Direction of the parallel projection of all panels. If not set, it is chosen as for frames.
  std::optional<ViewDirection> view = std::nullopt;
};

/// The panels of a plan for a solid, one per entry, as line drawings for papers.
///
/// Each panel shows the creases and the outline of the solid, with hidden parts thin and dashed.
/// Contacts have numbered markers, which are pale behind the solid. Fingers have a friction cone
/// and a stem, and the same action symbols as in planar panels (DrawFingers). A scale bar is at the
/// bottom right. All panels have one scale and one view. Deterministic.
class SolidPanels final : public FigurePanels {
 public:
  /// Create the panels.
  /// @param plan  valid plan (CheckPlan) that is located on the solid (ProjectPlan).
  SolidPanels(const object::Polyhedron& solid, const plan::Plan& plan,
              const SolidFigureOptions& options = {});

  [[nodiscard]] int count() const override { return static_cast<int>(fingers_.size()); }
  [[nodiscard]] std::string caption(int index) const override { return captions_[index]; }
  [[nodiscard]] double HeightFor(double width) const override;
  void Draw(cairo_t* cr, int index, double width, bool scale_bar = true) const override;

 private:
  NormalizedFrame frame_;
  BodyShape body_;
  double friction_angle_;
  Eigen::Matrix3d axes_;                           ///< columns right, up, towards the eye
  std::vector<std::vector<FingerGlyph>> fingers_;  ///< fingers of each panel
  std::vector<std::string> captions_;
  Eigen::Vector2d low_, high_;  ///< bounding box of the drawing, along right and up
};

}  // namespace regrasp::render
