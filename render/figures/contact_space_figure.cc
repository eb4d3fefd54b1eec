#include "render/figures/contact_space_figure.h"

#include <algorithm>

#include "planner/base/number.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/contact_space_overview.h"
#include "render/figures/contact_space_switch.h"
#include "render/figures/plan_figure.h"
#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

constexpr int kDigits = 3;  ///< of lengths and angles in captions

std::string OverviewCaption(const ContactSpaceMap& map, double half_angle) {
  const bool stretching =
      std::ranges::any_of(map.sets, [](const MapSet& set) { return set.stretching; });
  return "contact space, θ = " + FormatShort(Degrees(half_angle), kDigits) +
         "°: " + std::to_string(map.set_count) + (map.set_count == 1 ? " set" : " sets") +
         " of 2-finger grasps" + (stretching ? " (hatched: stretching)" : "") +
         "; dots: the grasp after each step; solid: aligns; dashed: switches";
}

std::string SwitchCaption(const ContactSwitch& step, const plan::Plan& plan, FingerIndex finger,
                          double place) {
  const auto& [before, after] = step.sides;
  const auto half_width = [&](const ContactSwitchSide& side) {
    return "±" + FormatLength(plan.scale * side.size, kDigits) + " about grasp " +
           std::to_string(side.grasp_entry);
  };
  return PanelLabel(step.entry) + " " + EntryTitle(plan, step.entry) + "; finger " +
         std::to_string(finger) + " stays at " + FormatLength(plan.scale * place, kDigits) +
         "; largest squares: " + half_width(before) + ", " + half_width(after);
}

}  // namespace

ContactSpaceFigures::ContactSpaceFigures(const object::Polygon& polygon, const plan::Plan& plan)
    : plan_(plan),
      graph_(polygon, plan.half_angle),
      geometry_(graph_),
      track_(TrackPlan(plan)),
      names_(NameSets(geometry_, track_)),
      unit_(UnitOfAxes(graph_.boundary(), plan.scale)) {}

std::string ContactSpaceFigures::DrawOverview(FigureFormat format) {
  const ContactSpaceMap map = MapContactSpace(geometry_, track_);
  return DrawContactSpace(graph_.boundary(), map, unit_, OverviewCaption(map, plan_.half_angle),
                          format);
}

std::optional<std::string> ContactSpaceFigures::DrawSwitch(plan::EntryIndex entry,
                                                           FigureFormat format) {
  const auto step = DescribeContactSwitch(geometry_, track_, entry, names_);
  if (!step) return std::nullopt;
  const int axis = *track_[entry].shared_axis;
  const FingerIndex finger = track_[entry].grasp[axis].finger;
  const double place = step->sides[0].grasp.y();
  return DrawContactSwitch(graph_.boundary(), *step, unit_,
                           SwitchCaption(*step, plan_, finger, place), format);
}

}  // namespace regrasp::render
