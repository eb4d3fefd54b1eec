#include "apps/validate_options.h"

#include <cstddef>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp {

namespace {

/// Adds an option that takes a size in pixels, "1280x960".
CLI::Option* AddSize(CLI::App& app, const std::string& name, int& width, int& height,
                     const std::string& what) {
  const auto parse = [name, &width, &height](const std::string& text) {
    const std::size_t x = text.find('x');
    const auto side = [&](const std::string& digits) {
      const std::optional<double> value = ParseDouble(digits);
      const bool integer = digits.find_first_not_of("0123456789") == std::string::npos;
      if (!value || !integer || *value < kMinFrameSide || *value > kMaxFrameSide) {
        throw CLI::ValidationError(
            name, "expected WxH with sides from " + std::to_string(kMinFrameSide) + " to " +
                      std::to_string(kMaxFrameSide) + ", found \"" + text + "\"");
      }
      return static_cast<int>(*value);
    };
    width = side(text.substr(0, x));
    height = side(x == std::string::npos ? "" : text.substr(x + 1));
  };
  return app
      .add_option_function<std::string>(
          name, parse,
          what + ", pixels, each side from " + std::to_string(kMinFrameSide) + " to " +
              std::to_string(kMaxFrameSide) + " (default " + std::to_string(width) + "x" +
              std::to_string(height) + ")")
      ->type_name("WxH");
}

void AddFiles(CLI::App& app, ValidateOptions& options) {
  const auto add = [&app](const std::string& name, std::string& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("--object", options.object_path, "Object file")->required();
  CLI::Option* plan = add("--plan", options.plan_path, "Plan file; or --grasp");
  CLI::Option* grasp =
      add("--grasp", options.grasp_path,
          "Grasp file: asks for a single grasp, at the friction given here, whether it is force "
          "closure, the half-angle that it needs, its quality, and its weakest finger: the one "
          "whose own friction may fall least while all others keep theirs; holds and shakes it")
          ->excludes(plan);
  app.add_option("--out", options.out,
                 "Folder for report and frames (default out/<plan or grasp name>)")
      ->type_name("DIR");
  add("--start", options.start, "Grasp file that the plan's initial grasp must be")
      ->excludes(grasp);
  add("--goal", options.goal, "Grasp file that the plan's goal must be")->excludes(grasp);
  app.add_flag("--certificates", options.certificates,
               "The report also holds, for every grasp and all along every align, contact forces "
               "that prove force closure, or a twist that refutes it");
  add("--verify", options.verify,
      "Checks the proofs of a report that --certificates wrote, in exact rational arithmetic, "
      "against this plan and object; nothing is replayed or written")
      ->excludes(grasp);
  add("--junit", options.junit, "Write the verdicts as JUnit XML");
  add("--export-mjcf", options.mjcf, "Write the scene of the replay as MJCF for any MuJoCo");
  add("--trajectory", options.trajectory,
      "Write time (s), place (m) and force (N) of every finger during the replay as CSV");
}

void AddPhysics(CLI::App& app, ValidateOptions& options) {
  options.friction.AddTo(app);
  AddScale(app, options.scale)
      ->description(
          "Metres per unit of length of the object file; must be the plan's, 1 for a grasp where "
          "left out");
  CLI::Option* mass = AddNumber(app, "--mass", options.replay.mass_kg, NumberRange::Positive(),
                                "Mass of the object, kg; instead of --density")
                          ->type_name("KG");
  AddNumber(app, "--density", options.replay.density_kg_m3, NumberRange::Positive(),
            "Density of the object, kg/m^3 (default 1000)")
      ->type_name("KG_M3")
      ->excludes(mass);
  AddNumber(app, "--thickness", options.replay.thickness, NumberRange::Positive(),
            "Thickness of the prism that a planar object is, in the object file's own unit of "
            "length (default a quarter of the diameter)")
      ->type_name("X");
  AddNumber(app, "--squeeze", options.replay.squeeze_N, NumberRange::Positive(),
            "Sum of the normal forces of a grasp at rest, newtons (default: such "
            "that the weight is a tenth of the shake force, 1000 weights at the default shake)")
      ->type_name("N");
  AddNumber(app, "--shake", options.replay.shake, NumberRange::NotNegative(),
            "Size of the shake: force over squeeze, and torque over squeeze times half the "
            "diameter (default 0.01)")
      ->type_name("RHO");
  AddNumber(app, "--tolerance", options.replay.tolerance, NumberRange::Positive(),
            "How far the object may move and a fingertip slip, in diameters of the object "
            "(default 0.001)")
      ->type_name("X");
}

void AddPictures(CLI::App& app, ValidateOptions& options) {
  CLI::Option* none = app.add_flag("--no-frames", options.no_frames, "Draw no frames");
  app.add_flag("--show-focus", options.frame.show_focus,
               "Frames of a solid also show the focus point of four concurrent contacts, the lines "
               "to it, and the contact regions that it gives");
  app.add_flag("--show-clusters", options.show_clusters,
               "Frames of a plan over clustered contact points show the clusters on the surface, "
               "and their representatives as dots");
  AddSize(app, "--size", options.frame.width, options.frame.height, "Size of the frames");
  CLI::Option* moving =
      app.add_flag("--animate", options.animate,
                   "Also write the whole replay as a moving picture, replay.webp, slowed down")
          ->excludes(none);
  AddSize(app, "--animate-size", options.animation.width, options.animation.height,
          "Size of the moving picture")
      ->needs(moving);
}

}  // namespace

void ValidateOptions::AddTo(CLI::App& app) {
  AddFiles(app, *this);
  AddPhysics(app, *this);
  AddPictures(app, *this);
  app.add_flag("--allow-object-change", allow_object_change,
               "Accept an object file with other bytes than the plan was made for");
  AddQuiet(app, quiet);
}

void ValidateOptions::CheckUsage() const {
  if (plan_path.empty() && grasp_path.empty()) throw InputError("--plan or --grasp is required");
  if (!grasp_path.empty() && allow_object_change) {
    throw InputError("--allow-object-change: a grasp file names no object");
  }
}

const std::string& ValidateOptions::InputPath() const {
  return grasp_path.empty() ? plan_path : grasp_path;
}

std::filesystem::path ValidateOptions::Folder() const {
  if (!out.empty()) return out;
  return std::filesystem::path("out") / std::filesystem::path(InputPath()).stem();
}

}  // namespace regrasp
