#include "apps/view_options.h"

#include <string>

#include "apps/options.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Reads "AZIMUTH,ELEVATION", degrees.
render::ViewDirection ParseView(const std::string& name, const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    throw CLI::ValidationError(name, "\"" + text + "\" is not AZIMUTH,ELEVATION, as in 30,20");
  }
  constexpr double kTurn = 360, kPole = 90;
  return {Radians(ParseNumber(name, text.substr(0, comma), {.lower = -kTurn, .upper = kTurn})),
          Radians(ParseNumber(name, text.substr(comma + 1), {.lower = -kPole, .upper = kPole}))};
}

}  // namespace

void AddView(CLI::App& app, std::optional<render::ViewDirection>& view) {
  app.add_option_function<std::string>(
         "--view", [&view](const std::string& text) { view = ParseView("--view", text); },
         "Where pictures are taken from, degrees: azimuth about z from the x axis, elevation above "
         "the plane of x and y (default: where most of the fingers is seen; a planar object from "
         "above)")
      ->type_name("AZIMUTH,ELEVATION");
}

void AddEdges(CLI::App& app, render::BodyOptions& body) {
  using render::EdgeStyle;
  AddChoice<EdgeStyle>(
      app, "--edges", body.edges,
      {{"crease", EdgeStyle::kCrease}, {"all", EdgeStyle::kAll}, {"none", EdgeStyle::kNone}},
      "Which edges of a solid are drawn: crease, where the surface turns by more than the crease "
      "angle, and the outline; all, between all facets; none (default crease)");
  constexpr double kHalfTurn = 180;
  app.add_option_function<std::string>(
         "--crease-angle",
         [&body](const std::string& text) {
           body.crease_angle =
               Radians(ParseNumber("--crease-angle", text, {.lower = 0, .upper = kHalfTurn}));
         },
         "Angle below which facets are shown as one smooth surface, degrees (default 40)")
      ->type_name("DEG");
}

void AddFrameView(CLI::App& app, render::FrameOptions& frame) {
  AddView(app, frame.view.direction);
  AddNumber(app, "--zoom", frame.view.zoom, NumberRange::Positive(),
            "How much larger things are in frames than where all of them are seen (default 1)");
  app.add_flag_callback(
      "--orthographic", [&frame] { frame.view.projection = render::Projection::kOrthographic; },
      "Frames of a solid without perspective: parallel edges are parallel, and lengths across the "
      "line of sight have one scale. Those of a planar object are so always");
  AddEdges(app, frame.body);
  using render::Background;
  AddChoice<Background>(app, "--background", frame.background,
                        {{"white", Background::kWhite},
                         {"dark", Background::kDark},
                         {"transparent", Background::kTransparent}},
                        "What frames stand on: white, dark with light lines and text, or nothing: "
                        "PNG files with an alpha channel (default white)");
}

}  // namespace regrasp::apps
