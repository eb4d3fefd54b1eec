#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/solid_figure.h"
#include "render/frames/frame_model.h"
#include "render/frames/hand_view.h"

namespace regrasp::render {

struct PanelCamera;

/// A hand that executes a plan, for figures.
struct FigureHand {
  std::shared_ptr<const HandView> view;
  std::vector<std::string> finger_names;
  std::vector<plan::Snapshot> snapshots;  ///< object, fingers and links after each entry
  /// Motion of the object up to the end of each entry, as in "36.7° of 90°", for its caption. Empty
  /// texts and an empty array add nothing.
  std::vector<std::string> progress = {};
};

/// The panels of a plan for a hand, one per entry, as line drawings for papers.
///
/// Each panel shows the hand with its outlines and creases, the posed solid as in SolidPanels, and
/// the contacts with friction cones and finger names. The solid is visible through the hand, and
/// outlines of the hand behind the solid are dashed. Faces of a solid are tinted by their direction
/// in its frame (TintByDirection), unless it is a scan. An in-hand motion has the former pose as a
/// dashed ghost and an arrow of the rotation. Placed and released fingers have arrows. The palm is
/// fixed, and the hand fades out at sides of the panel that cut it. All panels have one scale
/// and one view. Deterministic.
class HandPanels final : public FigurePanels {
 public:
  /// Create the panels.
  /// @param solid  must outlive the panels.
  /// @param plan   valid plan (CheckPlan) that is located on the solid (ProjectPlan).
  HandPanels(const object::Polyhedron& solid, const plan::Plan& plan, const FigureHand& hand,
             const SolidFigureOptions& options = {});
  ~HandPanels() override;

  [[nodiscard]] int count() const override { return static_cast<int>(snapshots_.size()); }
  [[nodiscard]] std::string caption(int index) const override { return captions_[index]; }
  [[nodiscard]] double HeightFor(double width) const override;
  void Draw(cairo_t* cr, int index, double width, bool scale_bar = true) const override;

 private:
  /// Sides of the panels that cut the hand.
  struct Cuts {
    bool left = false, right = false, top = false, bottom = false;
  };
  class Fade;
  struct Drawing;  ///< lines and areas of the hand in a panel

  [[nodiscard]] Drawing DrawingOf(const plan::Snapshot& snapshot,
                                  const std::vector<ShadedMesh>& meshes, double crease_angle) const;

  /// Choose the rows that show everything, and find the sides that cut the hand.
  void ChooseRows();
  /// Return the projection to a panel.
  /// @param width  width of the panel, points.
  [[nodiscard]] PanelCamera CameraOf(double width) const;
  /// Draw the pose before an in-hand motion.
  /// @returns the points of the arrow of its rotation; empty without rotation.
  std::vector<Eigen::Vector2d> DrawBefore(cairo_t* cr, const plan::Snapshot& snapshot,
                                          const PanelCamera& camera) const;

  std::vector<plan::Snapshot> snapshots_;
  std::vector<std::string> names_;
  std::vector<std::string> captions_;
  FrameModel model_;
  Camera camera_;
  std::vector<Drawing> drawings_;
  double top_ = 0, bottom_ = 0;  ///< rows of the camera's image that the panels show, pixels
  Cuts cuts_;
};

}  // namespace regrasp::render
