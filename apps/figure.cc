// figure: draws every step of a planar plan as a figure for a paper.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "apps/options.h"
#include "apps/output_files.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/reading.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "render/figures/contact_space_figure.h"
#include "render/figures/figure_mark.h"
#include "render/figures/plan_figure.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

constexpr char kProgram[] = "figure";

/// Steps are numbered with this many digits, so that names sort.
constexpr std::size_t kDigits = 3;

/// The beginning of the names of figures of contact space.
constexpr char kContactSpace[] = "contact_space";

struct FigureProgram {
  std::string object_path;
  std::string plan_path;
  std::string out;
  std::string format = "svg";
  std::optional<double> scale;
  bool allow_object_change = false;
  bool contact_space = false;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run();

 private:
  void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object) const;
  void CheckOut() const;
  [[nodiscard]] object::ObjectFile ReadTold() const;
  [[nodiscard]] plan::Plan Located(const plan::Plan& plan, const object::Object& object) const;
  void CheckHasContactSpace(const plan::Plan& plan) const;
  void WriteFigures(const object::Polygon& polygon, const plan::Plan& plan) const;
  void WriteContactSpace(const object::Polygon& polygon, const plan::Plan& plan,
                         render::FigureFormat file_format, std::set<std::string>& written) const;
};

void FigureProgram::AddTo(CLI::App& app) {
  app.add_option("--object", object_path, "Polygon file (WKT)")->required()->type_name("FILE");
  app.add_option("--plan", plan_path, "Plan file")->required()->type_name("FILE");
  app.add_option("--out", out, "Folder for the figures")->required()->type_name("DIR");
  app.add_option("--format", format, "svg, pdf or png (default svg)")
      ->check(CLI::IsMember({"svg", "pdf", "png"}))
      ->type_name("FORMAT");
  app.add_flag("--contact-space", contact_space,
               "Also draw the contact space, and each switch in it: contact_space.FORMAT, "
               "contact_space_001.FORMAT …; needs a plan of 2-finger grasps");
  app.add_flag("--allow-object-change", allow_object_change,
               "Accept an object file with other bytes than the plan was made for");
  AddScale(app, scale)
      ->description("Metres per unit of length of the object file; must be the plan's");
  AddQuiet(app, quiet);
}

void FigureProgram::CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object) const {
  if (object.object->dimension() != 2) {
    throw InputError(object_path +
                     ": a solid, but figure draws planar objects (validate draws solids)");
  }
  apps::CheckPlanFits(plan, object, {plan_path, object_path, allow_object_change, scale});
}

plan::Plan FigureProgram::Located(const plan::Plan& plan, const object::Object& object) const {
  ProgressLine progress(quiet);
  progress.Report("checking the plan");
  const plan::PlanCheck check = plan::CheckPlan(object, plan);
  for (const plan::StepCheck& step : check.steps) {
    if (step.reason == plan::Reason::kNone) continue;
    throw InputError(plan_path + ": step " + std::to_string(step.index) + " (" + step.kind +
                     "): " + std::string(plan::ReasonName(step.reason)) + ": " + step.detail);
  }
  return check.located;
}

/// True iff an earlier run may have written this: 000_hold.svg, 001_switch.svg, …,
/// contact_space.svg, contact_space_001.svg, … in this format.
bool IsFigureName(const std::string& name, const std::string& format) {
  if (name == std::string(kContactSpace) + "." + format) return true;
  const std::string prefix = std::string(kContactSpace) + "_";
  if (name.starts_with(prefix)) {
    const std::string rest = name.substr(prefix.size());
    const std::size_t digits = rest.find_first_not_of("0123456789");
    return digits >= kDigits && digits != std::string::npos && rest.substr(digits) == "." + format;
  }
  const auto digits = std::find_if_not(name.begin(), name.end(),
                                       [](unsigned char c) { return std::isdigit(c) != 0; });
  const std::string rest(digits, name.end());
  return digits - name.begin() >= static_cast<std::ptrdiff_t>(kDigits) &&
         (rest == "_hold." + format || rest == "_switch." + format || rest == "_align." + format);
}

std::string SheetName(const std::string& format) { return "sheet." + format; }

/// Whether a file says that this program made it. One that cannot be read does not.
bool IsOurs(const std::filesystem::path& file) {
  try {
    return render::IsMarkedFigure(ReadFile(file));
  } catch (const InputError&) {
    return false;
  }
}

/// Removes the figures of an earlier run that this one has not written again: files that bear a
/// figure's name and are ours.
void RemoveOthers(const std::filesystem::path& folder, const std::string& format,
                  const std::set<std::string>& written) {
  std::error_code error;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool file = entry.symlink_status(error).type() == std::filesystem::file_type::regular;
    if (!file || written.contains(name) || !IsFigureName(name, format)) continue;
    if (IsOurs(entry.path())) others.push_back(entry.path());
  }
  for (const std::filesystem::path& other : others) {
    if (!error) std::filesystem::remove(other, error);
  }
  if (error) throw EnvironmentError(folder.string() + ": " + error.message());
}

std::string Number(int index) {
  const std::string number = std::to_string(index);
  return std::string(kDigits - std::min(kDigits, number.size()), '0') + number;
}

std::string FileName(int index, const std::string& kind, const std::string& format) {
  return Number(index) + "_" + kind + "." + format;
}

void FigureProgram::CheckHasContactSpace(const plan::Plan& plan) const {
  const auto rest = render::FindOtherThanTwoFingers(plan);
  if (!rest) return;
  const std::string entry = rest->entry == 0
                                ? "its initial grasp"
                                : "the grasp after step " + std::to_string(rest->entry);
  throw InputError(plan_path + ": " + entry + " has " + std::to_string(rest->contacts) +
                   " contacts, but --contact-space draws plans of 2-finger grasps");
}

void FigureProgram::WriteContactSpace(const object::Polygon& polygon, const plan::Plan& plan,
                                      render::FigureFormat file_format,
                                      std::set<std::string>& written) const {
  const std::filesystem::path folder = out;
  const int count = static_cast<int>(plan.steps.size());
  ProgressLine progress(quiet);
  progress.Report("contact space");
  render::ContactSpaceFigures figures(polygon, plan);
  const auto write = [&](const std::string& name, const std::string& bytes) {
    WriteFile(folder / name, bytes, Durability::kCached);
    written.insert(name);
  };
  write(std::string(kContactSpace) + "." + format, figures.DrawOverview(file_format));
  for (int step = 1; step <= count; ++step) {
    progress.Report("contact space, step " + std::to_string(step) + " of " + std::to_string(count));
    const auto bytes = figures.DrawSwitch(step, file_format);
    if (bytes) write(std::string(kContactSpace) + "_" + Number(step) + "." + format, *bytes);
  }
}

void FigureProgram::WriteFigures(const object::Polygon& polygon, const plan::Plan& plan) const {
  static const std::map<std::string, render::FigureFormat> kFormats = {
      {"svg", render::FigureFormat::kSvg},
      {"pdf", render::FigureFormat::kPdf},
      {"png", render::FigureFormat::kPng}};
  const render::FigureFormat file_format = kFormats.at(format);
  const std::filesystem::path folder = out;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": " + error.message());
  const std::vector<render::StepDiagram> diagrams = render::DescribePlan(polygon, plan);
  const int count = static_cast<int>(diagrams.size());
  std::set<std::string> written;
  ProgressLine progress(quiet);
  for (int i = 0; i < count; ++i) {
    progress.Report("figure " + std::to_string(i + 1) + " of " + std::to_string(count));
    const std::string name = FileName(i, diagrams[i].kind, format);
    WriteFile(folder / name, render::DrawStepFigure(polygon, diagrams, i, file_format),
              Durability::kCached);
    written.insert(name);
  }
  WriteFile(folder / SheetName(format), render::DrawSheet(polygon, diagrams, file_format),
            Durability::kCached);
  if (contact_space) WriteContactSpace(polygon, plan, file_format, written);
  RemoveOthers(folder, format, written);
}

void FigureProgram::CheckOut() const {
  OutputFiles outputs;
  outputs.folders.push_back({"--out", out, [this](const std::string& name) {
                               return name == SheetName(format) || IsFigureName(name, format);
                             }});
  CheckOutputsDiffer({{"--object", object_path}, {"--plan", plan_path}}, outputs);
  CheckOutputsWritable(outputs);
}

object::ObjectFile FigureProgram::ReadTold() const {
  ProgressLine progress(quiet);
  return object::ReadObject(object_path, {progress.reporter(), {}});
}

int FigureProgram::Run() {
  CheckOut();
  const object::ObjectFile object = ReadTold();
  const plan::Plan plan = plan::ReadPlan(plan_path);
  CheckPlanFits(plan, object);
  // Planar objects are polygons: ReadObject makes no other.
  const auto& polygon = dynamic_cast<const object::Polygon&>(*object.object);
  const plan::Plan located = Located(plan, polygon);
  if (contact_space) CheckHasContactSpace(located);
  WriteFigures(polygon, located);
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Draws every step of a planar regrasp plan as a figure for a paper, and a sheet of all.",
      kProgram);
  FigureProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
