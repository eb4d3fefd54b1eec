// hand: finds palm and fingertips in a model of a hand, and writes its hand file.

#include <filesystem>
#include <iostream>
#include <string>

#include "apps/commands.h"
#include "apps/help.h"
#include "apps/options.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "planner/base/file.h"
#include "planner/kinematics/inspect_hand.h"
#include "render/frames/hand_image.h"
#include "render/picture/image.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

namespace fs = std::filesystem;

constexpr char kProgram[] = "hand";

struct HandProgram {
  std::string model;
  std::string output;
  std::string picture;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run() const;
  void WritePicture(const kinematics::InspectedHand& inspected) const;
};

void HandProgram::AddTo(CLI::App& app) {
  BeginGroup(app, "Input");
  app.add_option("--model", model, "Hand model. MJCF, URDF, or a hand file that contains its path")
      ->type_name("FILE")
      ->required();
  BeginGroup(app, "Output");
  app.add_option("-o,--output", output, "Hand file (JSON). The model's path is relative to it")
      ->type_name("FILE");
  app.add_option("--picture", picture, "Image of the hand with its fingertip spheres (PNG)")
      ->type_name("FILE");
  AddQuiet(app, quiet);
  app.footer(
      "  hand --model right_hand.xml --output hand.json --picture hand.png\n"
      "  hand --model models/hands/ring5.json\n");
}

void HandProgram::WritePicture(const kinematics::InspectedHand& inspected) const {
  const std::string caption = inspected.description.name + " · " +
                              std::to_string(inspected.hand.fingers.size()) +
                              " fingers · palm: " + inspected.description.palm;
  render::WritePng(picture, render::DrawHand(inspected.hand, inspected.visuals, caption));
}

int HandProgram::Run() const {
  OutputFiles outputs;
  outputs.Add("--output", output);
  outputs.Add("--picture", picture);
  CheckOutputsDiffer({{"--model", model}}, outputs);
  CheckOutputsWritable(outputs);
  const kinematics::InspectedHand inspected = kinematics::InspectHand(model);
  if (!output.empty()) {
    kinematics::HandDescription description = inspected.description;
    const fs::path folder = fs::absolute(output).parent_path();
    description.model = fs::absolute(inspected.model).lexically_proximate(folder).string();
    WriteFile(output, kinematics::FormatHandDescription(description));
  }
  if (!picture.empty()) WritePicture(inspected);
  if (!quiet) std::cout << kinematics::InspectionText(inspected);
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  HandProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
