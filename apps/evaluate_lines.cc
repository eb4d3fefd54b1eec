#include "apps/evaluate_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/batch/object_cache.h"
#include "apps/evaluate_files.h"
#include "apps/evaluate_page.h"
#include "apps/lines_run.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/object/polyhedron.h"
#include "render/frames/grasp_image.h"
#include "sim/hand_grasps/grasp_conventions.h"

namespace regrasp::apps {

namespace {

constexpr double kMillimetres = 1000;
constexpr std::size_t kMostWorlds = 8;
/// Width and height of images, pixels.
constexpr int kImageSize = 640;
/// Number of decimals of lengths in millimetres, and of other measured values.
constexpr int kDecimals = 3;

/// Return a number for a report, rounded.
double Rounded(double value) {
  double factor = 1;
  for (int i = 0; i < kDecimals; ++i) factor *= 10;
  return std::round(value * factor) / factor + 0.0;
}

/// Ending of the folder with the convex pieces of an object, next to the object's file.
constexpr char kPiecesEnding[] = "_pieces";

/// Return the files of an object's convex pieces, sorted: cup_pieces/*.obj for cup.obj.
std::vector<std::filesystem::path> PieceFiles(const std::filesystem::path& object) {
  const std::filesystem::path folder =
      object.parent_path() / (object.stem().string() + kPiecesEnding);
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// @throws InputError  if a file is not a solid.
sim::GraspWorld::Pieces ReadPieces(const std::filesystem::path& object) {
  sim::GraspWorld::Pieces pieces;
  for (const std::filesystem::path& file : PieceFiles(object)) {
    const object::ObjectFile piece = object::ReadObject(file);
    const auto* solid = dynamic_cast<const object::Polyhedron*>(piece.object.get());
    if (solid == nullptr) throw InputError(file.string() + ": expected a solid, found a polygon");
    pieces.push_back(solid->vertices());
  }
  return pieces;
}

/// A hand with an object of one size.
struct PreparedGrasps {
  std::string object_path;
  double scale = 1;
  SharedObject object;
  std::unique_ptr<sim::GraspWorld> world;
  std::unique_ptr<sim::GraspGeometry> geometry;
  std::string why;  ///< reason why the world could not be made; made only once, because it is slow
};

Json ResultJson(const sim::ProtocolResult& result) {
  Json json = {{"protocol", std::string(sim::GraspProtocolName(result.protocol))},
               {"verdict", result.passed() ? "pass" : "fail"}};
  if (!result.passed()) json["reason"] = std::string(sim::GraspFaultName(result.fault));
  if (result.quality) json["quality"] = *result.quality;
  if (result.moved_m) json["moved_mm"] = Rounded(kMillimetres * *result.moved_m);
  if (result.rotated_deg) json["rotated_deg"] = Rounded(*result.rotated_deg);
  if (!result.seconds.empty()) {
    json["seconds"] = Json::array();
    for (const auto& seconds : result.seconds) {
      json["seconds"].push_back(seconds ? Json(Rounded(*seconds)) : Json(nullptr));
    }
  }
  if (!result.resisted_N.empty()) {
    json["resisted_N"] = Json::array();
    for (const double force : result.resisted_N) json["resisted_N"].push_back(Rounded(force));
  }
  return json;
}

Json VerdictJson(const sim::HandGrasp& grasp, const std::string& hand,
                 const sim::GraspVerdict& verdict, const std::string& likely_cause) {
  const sim::GraspFault fault = verdict.fault();
  const bool passed = fault == sim::GraspFault::kNone;
  Json json = {{"format", "regrasp-hand-grasp-report"},
               {"version", 1},
               {"verdict", passed ? "pass" : "fail"},
               {"id", grasp.id}};
  if (!passed) json["reason"] = std::string(sim::GraspFaultName(fault));
  if (!likely_cause.empty()) json["likely_cause"] = likely_cause;
  if (!grasp.set.empty()) json["set"] = grasp.set;
  json["object"] = {{"file", grasp.object_file}, {"scale", grasp.scale}};
  json["hand"] = hand;
  if (grasp.claimed) json["claimed"] = *grasp.claimed;
  if (grasp.score) json["score"] = *grasp.score;
  json["distance_mm"] = Rounded(kMillimetres * verdict.distance_m);
  json["links"] = Json::array();
  for (const sim::LinkTouch& touch : verdict.touches) {
    if (touch.distance > sim::GraspGeometry::kContactDistance) continue;
    json["links"].push_back({{"link", touch.name},
                             {"contacts", touch.contacts.size()},
                             {"distance_mm", Rounded(kMillimetres * touch.distance)}});
  }
  json["protocols"] = Json::array();
  for (const sim::ProtocolResult& result : verdict.results) {
    json["protocols"].push_back(ResultJson(result));
  }
  return json;
}

class EvaluateLines {
 public:
  explicit EvaluateLines(const EvaluateOptions& options)
      : options_(options),
        files_(SortEvaluateOutputs(options)),
        finder_(options.object),
        hand_(sim::ReadWholeHand(options.hand)) {}

  int Run() {
    CheckFiles();
    common_ = CommonDigest("");
    LinesRun run;
    run.program = kEvaluateName;
    run.content = "reports";
    run.input = options_.grasps;
    run.output = files_.reports;
    run.shard = options_.shard;
    run.digest = [this](const std::string& source) { return CommonDigest(source); };
    run.jobs = options_.jobs;
    run.fresh = options_.fresh;
    run.quiet = options_.quiet;
    run.work.group = [](const Line& line) { return ObjectText(line); };
    run.work.prepare = [this](const Line& line) { Prepare(line); };
    run.work.work = [this](const Line& line) {
      return GuardLine(line, [&] { return Evaluate(line); });
    };
    run.work.inputs = [this](const Line& line) {
      const std::optional<ObjectOfLine> object = ObjectOf(line);
      return EntryDigest(common_ + PiecesDigest(object, line), line, object, finder_);
    };
    run.work.complete = [this](const Line& line, std::string_view record) {
      return HasImage(line, record);
    };
    const int code = RunLinesFile(run);
    if (code <= kExitBadInput) WriteEvaluateFiles(files_, options_);
    return code;
  }

 private:
  void CheckFiles() const {
    OutputFiles outputs;
    for (const std::string& file :
         {files_.reports, files_.reports + kPartEnding, files_.table, files_.arrays, files_.page}) {
      outputs.Add("--output", file);
    }
    if (!options_.images.empty()) {
      outputs.folders.push_back({"--images", options_.images, IsGraspImageName});
    }
    CheckOutputsDiffer(
        {{"--grasps", options_.grasps}, {"--hand", options_.hand}, {"--object", options_.object}},
        outputs);
    CheckOutputsWritable(outputs);
    if (!options_.images.empty()) std::filesystem::create_directories(options_.images);
  }

  [[nodiscard]] std::string CommonDigest(const std::string& source) const {
    InputsDigest digest;
    digest.Add("version", ProgramVersion()).Add("build", BuildId());
    digest.Add("source", source).Add("hand", hand_.sha256);
    for (const sim::GraspProtocol protocol : options_.protocols) {
      digest.Add("protocol", sim::GraspProtocolName(protocol));
    }
    digest.Add("mu", FormatDouble(options_.test.mu));
    digest.Add("mass", FormatDouble(options_.test.mass_kg));
    if (!options_.images.empty()) digest.Add("images", options_.images);
    return digest.Finish();
  }

  /// Return the object's member as text, without parsing. Equal texts are the same object and size.
  static std::string ObjectText(const Line& line) {
    const std::size_t begin = line.text.find(R"("object")");
    if (begin == std::string::npos) return "";
    return line.text.substr(begin, line.text.find('}', begin) - begin);
  }

  static std::optional<ObjectOfLine> ObjectOf(const Line& line) {
    try {
      return ObjectOfLine{sim::ParseHandGrasp(line.text, line.name).object_file};
    } catch (const InputError&) {
      return std::nullopt;  // the child process reports the error
    }
  }

  /// Return the digest of the convex pieces of an object; empty without pieces.
  std::string PiecesDigest(const std::optional<ObjectOfLine>& object, const Line& line) {
    if (!object) return "";
    try {
      const std::string path = finder_.Find(object->name, "", line.name);
      const auto [at, is_new] = pieces_.try_emplace(path);
      if (!is_new) return at->second;
      for (const std::filesystem::path& file : PieceFiles(path)) {
        at->second += Sha256(ReadFile(file));
      }
      return at->second;
    } catch (const InputError&) {
      return "";  // the child process reports the error
    }
  }

  void Prepare(const Line& line) {
    try {
      static_cast<void>(WorldOf(sim::ParseHandGrasp(line.text, line.name), line));
    } catch (const InputError&) {
      // The process of each line reports the error.
    }
  }

  /// Return the world of a grasp, which is made once per object and size.
  PreparedGrasps& WorldOf(const sim::HandGrasp& grasp, const Line& line) {
    const std::string path = finder_.Find(grasp.object_file, "", line.name);
    for (auto at = worlds_.begin(); at != worlds_.end(); ++at) {
      if (at->object_path != path || at->scale != grasp.scale) continue;
      worlds_.splice(worlds_.begin(), worlds_, at);
      return ValidWorld();
    }
    PreparedGrasps made;
    made.object_path = path;
    made.scale = grasp.scale;
    made.object = objects_.Get(path, [&] {
      object::Reading reading;
      reading.shells = object::Shells::kUnion;
      return object::ReadObject(path, reading);
    });
    const auto* solid = dynamic_cast<const object::Polyhedron*>(made.object->object.get());
    if (solid == nullptr) throw InputError(path + ": expected a solid, found a polygon");
    sim::CheckGraspScale(grasp, hand_, *solid, line.name);
    try {
      made.world = std::make_unique<sim::GraspWorld>(hand_, *solid, grasp.scale, ReadPieces(path));
      made.geometry = std::make_unique<sim::GraspGeometry>(*made.world, *solid, grasp.scale);
    } catch (const InputError& error) {
      made.why = error.what();
    }
    if (worlds_.size() >= kMostWorlds) worlds_.pop_back();
    worlds_.push_front(std::move(made));
    return ValidWorld();
  }

  /// Return the first world. @throws InputError  if it could not be made.
  PreparedGrasps& ValidWorld() {
    if (!worlds_.front().why.empty()) throw InputError(worlds_.front().why);
    return worlds_.front();
  }

  std::string Evaluate(const Line& line) {
    const sim::HandGrasp grasp = sim::ParseHandGrasp(line.text, line.name);
    PreparedGrasps& prepared = WorldOf(grasp, line);
    const object::Object& object = *prepared.object->object;
    sim::CheckGraspConventions(grasp, hand_, object, *prepared.world, line.name);
    const sim::GraspVerdict verdict = sim::TestHandGrasp(
        grasp, object, *prepared.geometry, options_.protocols, options_.test, *prepared.world);
    std::string cause;
    if (verdict.distance_m > sim::GraspGeometry::kContactDistance) {
      cause = sim::LikelyConvention(grasp, *prepared.geometry, *prepared.world);
    }
    if (!options_.images.empty()) DrawImage(line, grasp, verdict, object, *prepared.world);
    return FormatRecord(line.entry, VerdictJson(grasp, hand_.name, verdict, cause));
  }

  [[nodiscard]] std::filesystem::path ImageOf(const Line& line) const {
    return std::filesystem::path(options_.images) / GraspImageName(line.entry);
  }

  /// Return whether the image of a record still exists, if it has one.
  [[nodiscard]] bool HasImage(const Line& line, std::string_view record) const {
    const bool is_drawn =
        !options_.images.empty() && record.find(R"("distance_mm":)") != std::string_view::npos;
    return !is_drawn || std::filesystem::exists(ImageOf(line));
  }

  /// Write the image of a grasp.
  /// @throws EnvironmentError  if it cannot be drawn or written.
  void DrawImage(const Line& line, const sim::HandGrasp& grasp, const sim::GraspVerdict& verdict,
                 const object::Object& object, sim::GraspWorld& world) const {
    world.Place(grasp.grasp);
    render::GraspScene scene;
    scene.hand = kinematics::VisualsAt(*hand_.compiled, hand_.palm, world.joint_positions());
    scene.palm = grasp.grasp.palm;
    scene.scale = grasp.scale;
    for (const sim::LinkTouch& touch : verdict.touches) {
      for (const auto& contact : touch.contacts) scene.contacts.push_back(contact.point);
    }
    const sim::GraspFault fault = verdict.fault();
    const std::string caption =
        OneLine(grasp.id) +
        (fault == sim::GraspFault::kNone ? ": pass" : ": " + std::string(GraspFaultName(fault)));
    render::WritePng(ImageOf(line), render::DrawGraspScene(scene, object, caption, kImageSize));
  }

  EvaluateOptions options_;
  EvaluateFiles files_;
  ObjectFinder finder_;
  sim::WholeHand hand_;
  ObjectCache objects_;
  std::list<PreparedGrasps> worlds_;           ///< most recently used first
  std::map<std::string, std::string> pieces_;  ///< digests of the pieces by object path
  std::string common_;                         ///< digest of the inputs of all lines
};

}  // namespace

int RunEvaluate(const EvaluateOptions& options) { return EvaluateLines(options).Run(); }

}  // namespace regrasp::apps
