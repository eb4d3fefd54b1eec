#include "render/figures/plan_figure.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/planar_panel.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

BorderPoint BorderPointOf(const grasp::Contact& contact) {
  return {contact.p.head<2>(), -contact.n.head<2>()};
}

const char* TypeName(DiagramKind kind) {
  switch (kind) {
    case DiagramKind::kTwoFinger:
      return "2-finger grasp";
    case DiagramKind::kConcurrent:
      return "concurrent grasp";
    case DiagramKind::kParallel:
      return "parallel grasp";
    case DiagramKind::kOther:
      break;
  }
  return "other grasp";
}

/// Return the type of a grasp, with φ if its cones are narrower than the friction cones.
std::string Describe(const GraspDiagram& grasp, double friction) {
  std::string name = TypeName(grasp.kind);
  if (grasp.kind != DiagramKind::kConcurrent) return name;
  const auto degrees = [](double radians) { return FormatShort(Degrees(radians), 3) + "°"; };
  const std::string drawn = degrees(grasp.cones.front().friction_angle);
  const std::string theta = degrees(friction);
  return drawn == theta ? name : name + "; φ = " + drawn + " < θ = " + theta;
}

/// Return the positions of a finger at the waypoints of a sliding step.
std::vector<BorderPoint> PathOf(const plan::Align& align, FingerIndex finger) {
  std::vector<BorderPoint> path;
  for (const plan::FingerGrasp& waypoint : align.waypoints) {
    const plan::FingerContact* at = plan::FindFinger(waypoint, finger);
    if (at != nullptr) path.push_back(BorderPointOf(at->contact));
  }
  return path;
}

bool Moves(const std::vector<BorderPoint>& path) {
  return std::any_of(path.begin(), path.end(),
                     [&](const BorderPoint& point) { return point.p != path.front().p; });
}

void AddActions(const plan::FingerGrasp& /*before*/, const plan::Align& align,
                std::vector<DiagramFinger>& fingers) {
  for (DiagramFinger& finger : fingers) {
    std::vector<BorderPoint> path = PathOf(align, finger.finger);
    if (!Moves(path)) continue;
    finger.role = plan::FingerRole::kMoved;
    finger.path = std::move(path);
  }
}

void AddActions(const plan::FingerGrasp& before, const plan::Switch& step,
                std::vector<DiagramFinger>& fingers) {
  for (DiagramFinger& finger : fingers) {
    if (plan::FindFinger(step.place, finger.finger)) finger.role = plan::FingerRole::kPlaced;
  }
  for (const FingerIndex released : step.release) {
    const plan::FingerContact* at = plan::FindFinger(before, released);
    if (at == nullptr) continue;
    fingers.push_back({released, plan::FingerRole::kReleased, BorderPointOf(at->contact), {}});
  }
}

void AddActions(const plan::FingerGrasp& /*before*/, const plan::Move& /*step*/,
                std::vector<DiagramFinger>& /*fingers*/) {}

}  // namespace

std::string PanelLabel(int index) {
  constexpr int kLetters = 26;
  std::string letters;
  for (int remaining = index; remaining >= 0; remaining = remaining / kLetters - 1) {
    letters.insert(letters.begin(), static_cast<char>('a' + remaining % kLetters));
  }
  return "(" + letters + ")";
}

std::vector<StepDiagram> DescribePlan(const object::Polygon& polygon, const plan::Plan& plan) {
  std::vector<StepDiagram> diagrams;
  plan::FingerGrasp grasp = plan.initial;
  const int entries = static_cast<int>(plan.steps.size()) + 1;
  for (plan::EntryIndex entry{0}; entry < entries; ++entry) {
    const plan::FingerGrasp before = grasp;
    const plan::Step* step = entry > 0 ? &plan::StepOf(plan, entry) : nullptr;
    if (step != nullptr) grasp = plan::GraspAfter(before, *step);
    StepDiagram diagram;
    diagram.kind = step != nullptr ? plan::StepKind(*step) : "hold";
    diagram.grasp = DescribeGrasp(polygon, plan::ContactsOf(grasp), plan.friction_angle);
    diagram.caption = PanelLabel(entry) + " " + EntryTitle(plan, entry) + "; " +
                      Describe(diagram.grasp, plan.friction_angle);
    for (const plan::FingerContact& held : grasp) {
      diagram.fingers.push_back(
          {held.finger, plan::FingerRole::kHolding, BorderPointOf(held.contact), {}});
    }
    if (step != nullptr) {
      std::visit([&](const auto& s) { AddActions(before, s, diagram.fingers); }, *step);
    }
    diagrams.push_back(std::move(diagram));
  }
  return diagrams;
}

using Eigen::Vector2d;

namespace {

constexpr double kBorderWidth = 0.9;  ///< width of the polygon's border, points

void AddPolygon(cairo_t* cr, const object::Polygon& polygon, const PanelView& view) {
  cairo_new_path(cr);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  for (const auto& ring : polygon.rings()) {
    std::vector<Vector2d> points;
    points.reserve(ring.size());
    for (const Vector2d& p : ring) points.push_back(view.ToPanel(p));
    AddOutline(cr, points);
  }
}

}  // namespace

double PlanPanels::HeightFor(double width) const {
  return FitView(polygon_, diagrams_, width).height + kScaleBarSpace;
}

void PlanPanels::Draw(cairo_t* cr, int index, double width, bool scale_bar) const {
  const PanelView view = FitView(polygon_, diagrams_, width);
  const StepDiagram& diagram = diagrams_[index];
  AddPolygon(cr, polygon_, view);
  Fill(cr, kMaterial);
  DrawFocusCell(cr, diagram.grasp, view);
  DrawCones(cr, polygon_, diagram, view);
  AddPolygon(cr, polygon_, view);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  Stroke(cr, kInk, kBorderWidth);
  DrawForceLines(cr, diagram.grasp, view);
  DrawFingers(cr, polygon_, diagram, view);
  DrawFocusPoint(cr, diagram.grasp, view);
  if (!scale_bar) return;
  DrawScaleBar(cr, {width, view.height + kScaleBarSpace}, view.scale / metres_per_unit_);
}

std::unique_ptr<FigurePanels> MakePanels(const object::Object& object, const plan::Plan& plan,
                                         const SolidFigureOptions& solid) {
  if (const auto* polygon = dynamic_cast<const object::Polygon*>(&object)) {
    return std::make_unique<PlanPanels>(*polygon, DescribePlan(*polygon, plan), plan.scale);
  }
  return std::make_unique<SolidPanels>(dynamic_cast<const object::Polyhedron&>(object), plan,
                                       solid);
}

}  // namespace regrasp::render
