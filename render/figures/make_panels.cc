#include "render/figures/make_panels.h"

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "render/figures/plan_diagram.h"
#include "render/figures/plan_figure.h"

namespace regrasp::render {

std::unique_ptr<FigurePanels> MakePanels(const object::Object& object, const plan::Plan& plan,
                                         const SolidFigureOptions& solid) {
  if (const auto* polygon = dynamic_cast<const object::Polygon*>(&object)) {
    return std::make_unique<PlanPanels>(*polygon, DescribePlan(*polygon, plan), plan.scale);
  }
  return std::make_unique<SolidPanels>(dynamic_cast<const object::Polyhedron&>(object), plan,
                                       solid);
}

}  // namespace regrasp::render
