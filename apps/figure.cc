// figure: draws every step of a plan as a figure for a paper.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/help.h"
#include "apps/list_option.h"
#include "apps/options.h"
#include "apps/output_files.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/view_options.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/plan/projection.h"
#include "render/figures/contact_space_figure.h"
#include "render/figures/hand_figure.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/plan_figure.h"
#include "render/figures/solid_figure.h"
#include "render/frames/step_scene.h"
#include "report/pictures/hand_picture.h"
#include "report/pictures/object_progress.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

constexpr char kProgram[] = "figure";

/// First part of the file names of contact space figures.
constexpr char kContactSpace[] = "contact_space";

constexpr char kSceneEnding[] = "glb";

constexpr NumberRange kWidths = {.lower = 20, .upper = 2000};
constexpr NumberRange kFontSizes = {.lower = 2, .upper = 72};

/// Folder of the figures.
class FigureFolder {
 public:
  explicit FigureFolder(std::filesystem::path path);
  void Write(const std::string& name, const std::string& bytes);
  /// Remove the figures of an earlier run that this run has not overwritten.
  /// A file is removed if it has the name of a figure and the mark of this program.
  void RemoveOthers(const std::string& format) const;

 private:
  std::filesystem::path path_;
  std::set<std::string> written_;
};

struct FigureProgram {
  std::string object_path;
  std::string plan_path;
  std::string hand_path;
  std::string out;
  std::string format = "svg";
  render::FigureStyle style;
  std::string panels;  ///< panels of the sheet; empty: all
  std::optional<double> scale;
  bool allow_object_change = false;
  bool contact_space = false;
  bool gltf = false;
  render::SolidFigureOptions solid;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run();

 private:
  void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object) const;
  void CheckOut() const;
  [[nodiscard]] object::ObjectFile ReadTold(const plan::Plan& plan) const;
  [[nodiscard]] plan::Plan Projected(const plan::Plan& plan, const object::Object& object) const;
  void CheckHasContactSpace(const plan::Plan& plan) const;
  [[nodiscard]] render::FigureStyle Printed() const;
  [[nodiscard]] std::unique_ptr<render::FigurePanels> Panels(const object::Object& object,
                                                             const plan::Plan& plan) const;
  void WriteFigures(const object::Object& object, const plan::Plan& plan) const;
  void WriteContactSpace(const object::Polygon& polygon, const plan::Plan& plan,
                         FigureFolder& folder) const;
};

/// Return a parser of an installed font family.
ListOption::Parser FamilyParser(std::string& family) {
  return [&family](const std::string& name, const std::string& value) {
    if (!render::IsInstalledFamily(value)) {
      throw CLI::ValidationError(name, "font family \"" + value +
                                           "\" not found; help: list the installed families with "
                                           "fc-list : family");
    }
    family = value;
  };
}

void FigureProgram::AddTo(CLI::App& app) {
  BeginGroup(app, "Input");
  app.add_option("--object", object_path, "Object file. A polygon (WKT) or a closed surface mesh")
      ->required()
      ->type_name("FILE");
  app.add_option("--plan", plan_path, "Plan file")->required()->type_name("FILE");
  app.add_option("--hand", hand_path, "Hand file, required for a plan with a hand")
      ->type_name("FILE");
  AddScale(app, scale, "Metres per length unit of the object file. Must be that of the plan");
  ListOption("--allow")
      .Word("object-change", [this] { allow_object_change = true; })
      .AddTo(app, "object-change",
             "Exceptions to permit.\n"
             "object-change: an object file with different content than the plan was made for");
  BeginGroup(app, "Figures");
  ListOption("--format")
      .Values("svg, pdf or png",
              {ChoiceParser<std::string>(format, {{"svg", "svg"}, {"pdf", "pdf"}, {"png", "png"}})})
      .Word("gltf", [this] { gltf = true; })
      .Word("contact-space", [this] { contact_space = true; })
      .AddTo(app, "svg|pdf|png[,gltf,contact-space]",
             "Format of the figures [default: svg]\n"
             "gltf: also write each step as a scene in binary glTF 2.0, in metres\n"
             "contact-space: also draw the contact space and each switch in it. Requires a plan of "
             "2-finger grasps");
  ListOption("--size")
      .Key("width", NumberParser(style.width_mm, kWidths))
      .Key("sheet", NumberParser(style.sheet_width_mm, kWidths))
      .Key("font", NumberParser(style.font_pt, kFontSizes))
      .Key("family", FamilyParser(style.family))
      .Key("captions", ChoiceParser<bool>(style.captions, {{"below", true}, {"none", false}}))
      .AddTo(app, "KEY=VALUE,…",
             "Sizes and text of the figures "
             "[default: width=85,sheet=174,font=7.5]\n"
             "width=MM: width of the figure of a step\n"
             "sheet=MM: width of the sheet\n"
             "font=PT: font size, with which lines and markers scale\n"
             "family=NAME: font family, as in family=DejaVu Serif. Otherwise sans-serif\n"
             "captions=below|none: captions below the figures, or no captions");
  app.add_option("--panels", panels,
                 "Entries on the sheet. 0 is the initial grasp, k is step k, as in 0,2-4 "
                 "[default: all]")
      ->type_name("LIST");
  AddView(app, solid.view);
  AddEdges(app, solid.body);
  BeginGroup(app, "Output");
  app.add_option("-o,--output", out, "Folder for the figures")->required()->type_name("DIR");
  AddQuiet(app, quiet);
  app.footer(
      "  figure --object polygon15.wkt --plan polygon15.json --output figures --format pdf\n"
      "  figure --object cube.obj --plan cube.json --output figures --view 30,20\n");
}

void FigureProgram::CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object) const {
  if (plan.hand && hand_path.empty()) {
    throw InputError("--plan: " + plan_path + ": a plan with a hand requires --hand; help: pass " +
                     "--hand " + plan.hand->file);
  }
  if (!plan.hand && !hand_path.empty()) {
    throw InputError("--hand: " + hand_path + ": expected a plan with a hand, found " + plan_path +
                     " without a hand; help: omit --hand");
  }
  if (plan.hand && object.object->dimension() != 3) {
    throw InputError("--plan: " + plan_path + ": a plan with a hand requires a solid, found the " +
                     "planar object " + object_path);
  }
  if (contact_space && object.object->dimension() != 2) {
    throw InputError("--format contact-space: requires a planar object, found the solid " +
                     object_path);
  }
  if (solid.view && object.object->dimension() == 2) {
    throw InputError("--view requires a solid, found the planar object " + object_path +
                     "; help: omit --view");
  }
  apps::CheckPlanFits(plan, object, {plan_path, object_path, allow_object_change, scale});
}

plan::Plan FigureProgram::Projected(const plan::Plan& plan, const object::Object& object) const {
  ProgressLine progress(quiet);
  progress.Report("checking the plan");
  const plan::PlanCheck check = plan::CheckPlan(object, plan);
  for (const plan::StepCheck& step : check.steps) {
    if (step.reason == plan::Reason::kNone) continue;
    throw InputError(plan_path + ": step " + std::to_string(step.index) + " (" + step.kind +
                     "): " + std::string(plan::ReasonName(step.reason)) + ": " + step.detail);
  }
  return check.projected;
}

/// Return whether a name is one that an earlier run may have written.
/// In this format these are 000_hold.svg, 001_switch.svg, …, contact_space.svg and
/// contact_space_001.svg, …. Scenes are 000_hold.glb, ….
bool IsFigureName(const std::string& name, const std::string& format) {
  if (IsEntryFileName(name, format) || IsEntryFileName(name, kSceneEnding) ||
      name == std::string(kContactSpace) + "." + format) {
    return true;
  }
  const std::string prefix = std::string(kContactSpace) + "_";
  return name.starts_with(prefix) && AfterEntryNumber(name.substr(prefix.size())) == "." + format;
}

render::FigureFormat FormatOf(const std::string& format) {
  static const std::map<std::string, render::FigureFormat> kFormats = {
      {"svg", render::FigureFormat::kSvg},
      {"pdf", render::FigureFormat::kPdf},
      {"png", render::FigureFormat::kPng}};
  return kFormats.at(format);
}

std::string SheetName(const std::string& format) { return "sheet." + format; }

/// Return whether a file has the mark of this program; false if it cannot be read.
bool IsOurs(const std::filesystem::path& file) {
  try {
    return render::IsMarkedFigure(ReadFile(file));
  } catch (const InputError&) {
    return false;
  }
}

FigureFolder::FigureFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) throw EnvironmentError(path_.string() + ": cannot be created: " + error.message());
}

void FigureFolder::Write(const std::string& name, const std::string& bytes) {
  WriteFile(path_ / name, bytes, Durability::kCached);
  written_.insert(name);
}

void FigureFolder::RemoveOthers(const std::string& format) const {
  std::error_code error;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(path_, error)) {
    const std::string name = entry.path().filename().string();
    const bool file = entry.symlink_status(error).type() == std::filesystem::file_type::regular;
    if (!file || written_.contains(name) || !IsFigureName(name, format)) continue;
    if (IsOurs(entry.path())) others.push_back(entry.path());
  }
  if (error) throw EnvironmentError(path_.string() + ": cannot be read: " + error.message());
  for (const std::filesystem::path& other : others) {
    std::filesystem::remove(other, error);
    if (error) throw EnvironmentError(other.string() + ": cannot be removed: " + error.message());
  }
}

void FigureProgram::CheckHasContactSpace(const plan::Plan& plan) const {
  const auto rest = render::FindOtherThanTwoContacts(plan);
  if (!rest) return;
  const std::string entry = rest->entry == 0
                                ? "its initial grasp"
                                : "the grasp after step " + std::to_string(rest->entry);
  throw InputError(plan_path + ": " + entry + " has " + std::to_string(rest->contacts) +
                   " contacts, but --format contact-space requires plans of 2-finger grasps");
}

void FigureProgram::WriteContactSpace(const object::Polygon& polygon, const plan::Plan& plan,
                                      FigureFolder& folder) const {
  const int count = static_cast<int>(plan.steps.size());
  ProgressLine progress(quiet);
  progress.Report("contact space");
  render::ContactSpaceFigures figures(polygon, plan);
  folder.Write(std::string(kContactSpace) + "." + format, figures.DrawOverview(Printed()));
  for (plan::EntryIndex step{1}; step <= count; ++step) {
    progress.Report("contact space, step " + std::to_string(step) + " of " + std::to_string(count));
    const auto bytes = figures.DrawSwitch(step, Printed());
    if (!bytes) continue;
    folder.Write(std::string(kContactSpace) + "_" + EntryNumber(step) + "." + format, *bytes);
  }
}

/// Parse a list of entries such as "0,2-4".
/// An empty text means all `count` entries.
/// @throws InputError  if the text is not such a list, or an entry does not exist.
std::vector<int> ParsePanels(const std::string& text, int count) {
  std::vector<int> entries;
  if (text.empty()) {
    for (int i = 0; i < count; ++i) entries.push_back(i);
    return entries;
  }
  try {
    std::istringstream parts(text + ",");  // the last part can be empty
    for (std::string part; std::getline(parts, part, ',');) {
      const std::size_t dash = part.find('-');
      const int first = ParseInteger("--panels", part.substr(0, dash), 0, count - 1);
      const int last = dash == std::string::npos
                           ? first
                           : ParseInteger("--panels", part.substr(dash + 1), first, count - 1);
      for (int i = first; i <= last; ++i) entries.push_back(i);
    }
  } catch (const CLI::ValidationError& error) {
    throw InputError(error.what());
  }
  return entries;
}

std::string KindOf(const plan::Plan& plan, plan::EntryIndex entry) {
  return entry == 0 ? "hold" : plan::StepKind(plan::StepOf(plan, entry));
}

render::FigureStyle FigureProgram::Printed() const {
  render::FigureStyle printed = style;
  printed.format = FormatOf(format);
  return printed;
}

std::unique_ptr<render::FigurePanels> FigureProgram::Panels(const object::Object& object,
                                                            const plan::Plan& plan) const {
  if (!plan.hand) return render::MakePanels(object, plan, solid);
  const kinematics::HandFile file =
      kinematics::HandOfPlan(kinematics::ReadHandFile(hand_path), plan);
  if (file.hand.sha256 != plan.hand->sha256) {
    throw InputError("--hand: " + plan_path + " is for another hand, expected " +
                     DescribeFile(plan.hand->file, plan.hand->sha256) + ", found " +
                     DescribeFile(hand_path, file.hand.sha256));
  }
  const report::HandPicture picture(file, plan, plan.scale * object.mass_properties().centroid);
  render::FigureHand hand = {picture.view(), picture.FingerNames(), {}};
  report::ObjectProgress progress(picture.PlannedPoses());
  for (plan::EntryIndex i{0}; i <= std::ssize(plan.steps); ++i) {
    plan::Fault none;
    hand.snapshots.push_back(plan::MakePlannedSnapshot(plan, i, none, 0));
    picture.MarkActions(i, hand.snapshots.back());
    picture.Place(i, hand.snapshots.back(), none);
    for (const plan::HandState& state : picture.StatesAlong(i)) {
      progress.Follow(picture.X_WP() * state.pose);
    }
    const bool moves = i > 0 && std::holds_alternative<plan::Move>(plan.steps[i - 1]);
    hand.progress.push_back(moves ? progress.Text() : "");
  }
  return std::make_unique<render::HandPanels>(dynamic_cast<const object::Polyhedron&>(object), plan,
                                              hand, solid);
}

void FigureProgram::WriteFigures(const object::Object& object, const plan::Plan& plan) const {
  const std::vector<int> on_sheet = ParsePanels(panels, static_cast<int>(plan.steps.size()) + 1);
  ProgressLine progress(quiet);
  progress.Report("laying out the figures");
  const std::unique_ptr<render::FigurePanels> drawn = Panels(object, plan);
  FigureFolder folder(out);
  const int count = drawn->count();
  const render::FigureStyle printed = Printed();
  for (plan::EntryIndex i{0}; i < count; ++i) {
    progress.Report("figure " + std::to_string(i + 1) + " of " + std::to_string(count));
    folder.Write(EntryFileName(i, KindOf(plan, i), format),
                 render::DrawStepFigure(*drawn, i, printed));
  }
  for (plan::EntryIndex i{0}; gltf && i < count; ++i) {
    progress.Report("scene " + std::to_string(i + 1) + " of " + std::to_string(count));
    folder.Write(EntryFileName(i, KindOf(plan, i), kSceneEnding),
                 render::EncodeGlb(render::kFigureMaker,
                                   render::MakeStepScene(object, plan, i, solid.body)));
  }
  progress.Report("the sheet of all figures");
  folder.Write(SheetName(format), render::DrawSheet(*drawn, on_sheet, printed));
  if (contact_space) {
    WriteContactSpace(dynamic_cast<const object::Polygon&>(object), plan, folder);
  }
  folder.RemoveOthers(format);
}

void FigureProgram::CheckOut() const {
  OutputFiles outputs;
  outputs.folders.push_back({"--output", out, [this](const std::string& name) {
                               return name == SheetName(format) || IsFigureName(name, format);
                             }});
  CheckOutputsDiffer({{"--object", object_path}, {"--plan", plan_path}, {"--hand", hand_path}},
                     outputs);
  CheckOutputsWritable(outputs);
}

object::ObjectFile FigureProgram::ReadTold(const plan::Plan& plan) const {
  ProgressLine progress(quiet);
  return ReadObjectOf(plan, object_path, {progress.reporter(), {}});
}

int FigureProgram::Run() {
  CheckOut();
  const plan::Plan plan = plan::ReadPlan(plan_path);
  const object::ObjectFile object = ReadTold(plan);
  CheckPlanFits(plan, object);
  const plan::Plan projected = Projected(plan, *object.object);
  if (contact_space) CheckHasContactSpace(projected);
  WriteFigures(*object.object, projected);
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  FigureProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
