#include "apps/view_options.h"

#include <string>

#include "apps/list_option.h"
#include "apps/options.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

constexpr double kTurn_deg = 360, kPole_deg = 90;

/// Return a parser of an angle in degrees, stored in radians.
ListOption::Parser AngleParser(double& radians, double lower, double upper) {
  return [&radians, lower, upper](const std::string& name, const std::string& text) {
    radians = Radians(ParseNumber(name, text, {.lower = lower, .upper = upper}));
  };
}

/// Return the option `--view` with azimuth and elevation.
ListOption ViewOption(std::optional<render::ViewDirection>& view) {
  ListOption list("--view");
  list.Values("AZIMUTH,ELEVATION, as in 30,20",
              {[&view](const std::string& name, const std::string& text) {
                 view = render::ViewDirection{
                     Radians(ParseNumber(name, text, {.lower = -kTurn_deg, .upper = kTurn_deg})),
                     0};
               },
               [&view](const std::string& name, const std::string& text) {
                 view->elevation =
                     Radians(ParseNumber(name, text, {.lower = -kPole_deg, .upper = kPole_deg}));
               }});
  return list;
}

constexpr char kViewText[] =
    "View direction of images, degrees. Azimuth about z from the x axis, elevation above the xy "
    "plane. By default the direction that shows most fingers; planar objects from above";

}  // namespace

void AddView(CLI::App& app, std::optional<render::ViewDirection>& view) {
  ViewOption(view).AddTo(app, "AZIMUTH,ELEVATION", kViewText);
}

void AddEdges(CLI::App& app, render::BodyOptions& body) {
  using render::EdgeStyle;
  constexpr double kHalfTurn_deg = 180;
  ListOption("--edges")
      .Values("crease, all or none",
              {ChoiceParser<EdgeStyle>(body.edges, {{"crease", EdgeStyle::kCrease},
                                                    {"all", EdgeStyle::kAll},
                                                    {"none", EdgeStyle::kNone}})})
      .Key("angle", AngleParser(body.crease_angle, 0, kHalfTurn_deg))
      .AddTo(app, "crease|all|none[,angle=DEG]",
             "Drawn edges of a solid [default: crease,angle=40]\n"
             "crease: edges at which the surface bends by more than the angle, and the outline\n"
             "all: edges of all triangles\n"
             "angle=DEG: crease angle, below which shading is smooth");
}

void AddFrameView(CLI::App& app, render::FrameOptions& frame) {
  ViewOption(frame.view.direction)
      .Key("zoom", NumberParser(frame.view.zoom, NumberRange::Positive()))
      .Word("orthographic", [&frame] { frame.view.projection = render::Projection::kOrthographic; })
      .AddTo(app, "AZIMUTH,ELEVATION[,zoom=X][,orthographic]",
             std::string(kViewText) +
                 "\nzoom=X: magnification relative to the full scene [default: 1]\n"
                 "orthographic: parallel projection, as planar objects always have");
  AddEdges(app, frame.body);
  using render::Background;
  AddChoice<Background>(app, "--background", frame.background,
                        {{"white", Background::kWhite},
                         {"dark", Background::kDark},
                         {"transparent", Background::kTransparent}},
                        "Background of frames. dark has light lines and text, transparent an alpha "
                        "channel [default: white]");
}

}  // namespace regrasp::apps
