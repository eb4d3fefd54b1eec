#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "render/figures/panel_sheet.h"
#include "render/frames/body_shape.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/viewpoint.h"

namespace regrasp::render {

struct SolidFigureOptions {
  BodyOptions body = {};
  /// From where all panels are seen, without perspective; chosen as for frames where not given.
  std::optional<ViewDirection> view = std::nullopt;
};

/// The panels of a plan of a solid, one for each step, in lines as papers print them.
///
/// Each shows the creases and the outline of the solid, what is hidden thin and dashed; a marker at
/// each contact with its number, pale where it is behind the solid; the friction cone and the stem
/// of each finger; and what the fingers do, by the signs of planar plans: a ring and an arrow that
/// arrives, a hollow marker and an arrow that leaves, a hollow marker and a path. At the bottom
/// right a bar tells the length. All panels have one scale and one view.
///
/// Laws: the same plan gives the same bytes.
class SolidPanels final : public FigurePanels {
 public:
  /// @param plan  of this solid, located (LocatePlan), and legal (CheckPlan).
  SolidPanels(const object::Polyhedron& solid, const plan::Plan& plan,
              const SolidFigureOptions& options = {});

  [[nodiscard]] int count() const override { return static_cast<int>(fingers_.size()); }
  [[nodiscard]] std::string caption(int index) const override { return captions_[index]; }
  [[nodiscard]] double HeightFor(double width) const override;
  void Draw(cairo_t* cr, int index, double width) const override;

 private:
  PictureFrame frame_;
  BodyShape body_;
  double half_angle_;
  Eigen::Matrix3d axes_;                           ///< right, up, towards the eye
  std::vector<std::vector<FingerGlyph>> fingers_;  ///< of each panel
  std::vector<std::string> captions_;
  Eigen::Vector2d low_, high_;  ///< of all that is drawn, along right and up
};

}  // namespace regrasp::render
