#include "planner/plan/json_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/plan/goal_set_io.h"

namespace regrasp::plan {

namespace {

/// Largest length of a value in messages.
constexpr std::size_t kLongestQuote = 60;

std::string Range(int lower, int upper) {
  if (lower == upper) return std::to_string(lower);
  return "a whole number from " + std::to_string(lower) + " to " + std::to_string(upper);
}

}  // namespace

void JsonReader::Fail(const std::string& what) const {
  throw InputError(file_ + ": " + (pointer_.empty() ? "" : pointer_ + ": ") + what);
}

void JsonReader::FailType(const char* expected) const {
  Fail(std::string("expected ") + expected + ", found " + Quoted());
}

std::string JsonReader::Quoted() const {
  if (value_.is_object()) return "a JSON object";
  if (value_.is_array()) return "a JSON array";
  std::string text = value_.dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace);
  if (text.size() > kLongestQuote) text = text.substr(0, kLongestQuote) + "...";
  return text;
}

JsonReader JsonReader::Member(const char* key) const {
  if (!value_.is_object()) FailType("a JSON object");
  const auto member = value_.find(key);
  if (member == value_.end()) Fail(std::string("member \"") + key + "\" not found");
  return {*member, file_, pointer_ + "/" + key};
}

std::vector<JsonReader> JsonReader::Elements() const {
  if (!value_.is_array()) FailType("a JSON array");
  std::vector<JsonReader> elements;
  elements.reserve(value_.size());
  for (std::size_t i = 0; i < value_.size(); ++i) {
    elements.emplace_back(value_[i], file_, pointer_ + "/" + std::to_string(i));
  }
  return elements;
}

std::string JsonReader::String() const {
  if (!value_.is_string()) FailType("a string");
  return value_.get<std::string>();
}

std::string JsonReader::Name() const {
  constexpr unsigned char kSpace = 0x20, kDelete = 0x7f;
  std::string name = String();
  const bool is_plain =
      std::ranges::none_of(name, [](unsigned char c) { return c < kSpace || c == kDelete; });
  if (!is_plain) Fail("expected a name without control characters, found " + Quoted());
  return name;
}

std::string JsonReader::OneOf(std::initializer_list<const char*> choices) const {
  const std::string found = String();
  std::string expected;
  for (const char* choice : choices) {
    if (found == choice) return found;
    expected += std::string(expected.empty() ? "\"" : " or \"") + choice + "\"";
  }
  Fail("expected " + expected + ", found " + Quoted());
}

double JsonReader::Number() const {
  if (!value_.is_number()) FailType("a number");
  const double number = value_.get<double>();
  if (!(std::abs(number) <= kLargestNumber)) Fail("too large, found " + Quoted());
  return number;
}

int JsonReader::Integer(int lower, int upper) const {
  const double number = Number();
  if (number != std::floor(number) || number < lower || number > upper) {
    Fail("expected " + Range(lower, upper) + ", found " + Quoted());
  }
  return static_cast<int>(number);
}

std::uint64_t JsonReader::Unsigned() const {
  if (!value_.is_number_unsigned()) FailType("a whole number of 64 bits");
  return value_.get<std::uint64_t>();
}

Eigen::Vector3d JsonReader::Vector(int dimension) const {
  const std::vector<JsonReader> elements = Elements();
  if (elements.size() != static_cast<std::size_t>(dimension)) {
    Fail("expected " + std::to_string(dimension) + " numbers, found " +
         std::to_string(elements.size()));
  }
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int i = 0; i < dimension; ++i) vector[i] = elements[i].Number();
  return vector;
}

void JsonReader::ExpectOnly(std::initializer_list<std::string_view> names) const {
  if (!value_.is_object()) FailType("a JSON object");
  for (const auto& [name, member] : value_.items()) {
    if (std::ranges::find(names, name) != names.end()) continue;
    Fail("unknown member " + Json(name).dump(-1, ' ', true, Json::error_handler_t::replace));
  }
}

void JsonReader::ExpectFormat(const char* format) const {
  static_cast<void>(Member("format").OneOf({format}));
  static_cast<void>(Member("version").Integer(1, 1));
}

Json VectorJson(const Eigen::Vector3d& vector, int dimension) {
  Json json = Json::array();
  // Adding 0 turns −0 into 0, which is easier to read.
  for (int i = 0; i < dimension; ++i) json.push_back(vector[i] + 0.0);
  return json;
}

grasp::Contact ReadContact(const JsonReader& json, int dimension) {
  return {json.Member("point").Vector(dimension), json.Member("normal").Vector(dimension)};
}

FingerIndex ReadFinger(const JsonReader& json) {
  return FingerIndex(json.Integer(0, std::numeric_limits<int>::max()));
}

namespace {

std::optional<double> ReadRegion(const JsonReader& contact) {
  if (!contact.Has("region")) return std::nullopt;
  const JsonReader region = contact.Member("region");
  const double half_width = region.Number();
  if (half_width < 0) region.Fail("expected a number from 0, found " + region.Quoted());
  return half_width;
}

}  // namespace

FingerGrasp ReadFingerGrasp(const JsonReader& json, int dimension) {
  FingerGrasp grasp;
  for (const JsonReader& element : json.Elements()) {
    grasp.push_back({ReadFinger(element.Member("finger")), ReadContact(element, dimension),
                     ReadRegion(element)});
  }
  return grasp;
}

Json ContactJson(const grasp::Contact& contact, int dimension) {
  Json json = Json::object();
  json["point"] = VectorJson(contact.p, dimension);
  json["normal"] = VectorJson(contact.n, dimension);
  return json;
}

Json GraspJson(const grasp::Grasp& grasp, int dimension) {
  Json json = Json::array();
  for (const grasp::Contact& contact : grasp) json.push_back(ContactJson(contact, dimension));
  return json;
}

Json FingerGraspJson(const FingerGrasp& grasp, int dimension) {
  Json json = Json::array();
  for (const FingerContact& held : grasp) {
    Json contact = Json::object();
    contact["finger"] = held.finger;
    contact.update(ContactJson(held.contact, dimension));
    if (held.region) contact["region"] = *held.region;
    json.push_back(std::move(contact));
  }
  return json;
}

Json ForcesJson(const std::vector<Eigen::Vector3d>& forces, int dimension) {
  Json json = Json::array();
  for (const Eigen::Vector3d& force : forces) json.push_back(VectorJson(force, dimension));
  return json;
}

Json MotionSegmentsJson(const motion::MotionSegments& pieces, int dimension) {
  Json json = Json::array();
  for (const motion::MotionSegment& piece : pieces) {
    json.push_back({{"from", piece.from},
                    {"to", piece.to},
                    {"start", ForcesJson(piece.start, dimension)},
                    {"end", ForcesJson(piece.end, dimension)}});
    if (piece.start_torques.empty()) continue;
    json.back()["start_torques"] = piece.start_torques;
    json.back()["end_torques"] = piece.end_torques;
  }
  return json;
}

std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension) {
  std::vector<Eigen::Vector3d> forces;
  for (const JsonReader& force : json.Elements()) forces.push_back(force.Vector(dimension));
  return forces;
}

std::vector<double> ReadTorques(const JsonReader& json, const char* name) {
  std::vector<double> torques;
  if (!json.Has(name)) return torques;
  for (const JsonReader& torque : json.Member(name).Elements()) torques.push_back(torque.Number());
  return torques;
}

motion::MotionSegments ReadMotionSegments(const JsonReader& json, int dimension) {
  motion::MotionSegments pieces;
  for (const JsonReader& piece : json.Elements()) {
    pieces.push_back({piece.Member("from").Number(), piece.Member("to").Number(),
                      ReadForces(piece.Member("start"), dimension),
                      ReadForces(piece.Member("end"), dimension),
                      ReadTorques(piece, "start_torques"), ReadTorques(piece, "end_torques")});
  }
  return pieces;
}

namespace {

constexpr std::size_t kSha256Digits = 64;
/// Largest deviation from 1 of the length of quaternions in files; they are normalized after the
/// check.
constexpr double kUnitTolerance = 1e-6;

std::vector<double> ReadNumbers(const JsonReader& json) {
  std::vector<double> numbers;
  for (const JsonReader& number : json.Elements()) numbers.push_back(number.Number());
  return numbers;
}

}  // namespace

Eigen::Isometry3d ReadPose(const JsonReader& json) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = json.Member("position").Vector(3);
  const JsonReader turn = json.Member("quaternion");
  const std::vector<double> wxyz = ReadNumbers(turn);
  if (wxyz.size() != 4) {
    turn.Fail("expected w, x, y and z, found " + std::to_string(wxyz.size()) + " numbers");
  }
  const Eigen::Quaterniond quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(std::abs(quaternion.norm() - 1) <= kUnitTolerance)) {
    turn.Fail("expected a quaternion of length 1, found length " +
              FormatShort(quaternion.norm(), 4));
  }
  pose.linear() = quaternion.normalized().toRotationMatrix();
  return pose;
}

Json PoseJson(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  return {{"position", VectorJson(pose.translation(), 3)},
          {"quaternion", {turn.w(), turn.x(), turn.y(), turn.z()}}};
}

namespace {

HandState ReadState(const JsonReader& json) {
  HandState state{ReadPose(json.Member("pose")), {}};
  for (const JsonReader& finger : json.Member("joints").Elements()) {
    state.joints.push_back(ReadNumbers(finger));
  }
  return state;
}

Json StateJson(const HandState& state) {
  return {{"pose", PoseJson(state.pose)}, {"joints", state.joints}};
}

}  // namespace

std::string ReadSha256(const JsonReader& json) {
  std::string digits = json.String();
  const auto is_digit = [](unsigned char c) { return std::isxdigit(c) && !std::isupper(c); };
  if (digits.size() != kSha256Digits || !std::ranges::all_of(digits, is_digit)) {
    json.Fail("expected 64 lower-case hexadecimal digits, found " + json.Quoted());
  }
  return digits;
}

/// Return a vector of length 1, up to rounding.
Eigen::Vector3d ReadUnitVector(const JsonReader& json) {
  constexpr double kRounding = 1e-6;
  const Eigen::Vector3d vector = json.Vector(3);
  if (!(std::abs(vector.norm() - 1) <= kRounding)) {
    json.Fail("the vector's length must be 1, found " + FormatShort(vector.norm(), 4));
  }
  return vector;
}

GravitySupport ReadGravitySupport(const JsonReader& json) {
  constexpr double kMostWeights = 1000;
  const JsonReader& disturbance = json.Member("disturbance");
  const JsonReader& force = json.Member("force");
  GravitySupport support{disturbance.Number(), force.Number()};
  if (!(support.disturbance > 0 && support.disturbance < 1)) {
    disturbance.Fail("expected a number between 0 and 1, found " + disturbance.Quoted());
  }
  if (!(support.force >= 1 && support.force <= kMostWeights)) {
    force.Fail("expected a number from 1 to 1000, found " + force.Quoted());
  }
  return support;
}

HandUse ReadHandUse(const JsonReader& json) {
  HandUse hand{json.Member("name").String(), json.Member("file").String(),
               ReadSha256(json.Member("sha256")), ReadState(json.Member("initial")),
               ReadPose(json.Member("goal"))};
  if (json.Has("goals")) hand.goals = ReadGoalMarks(json.Member("goals"));
  if (json.Has("up")) hand.up = ReadUnitVector(json.Member("up"));
  if (json.Has("gravity_support")) {
    if (!hand.up) json.Fail("gravity_support requires up");
    hand.gravity_support = ReadGravitySupport(json.Member("gravity_support"));
  }
  if (json.Has("mass_kg")) {
    const JsonReader& mass = json.Member("mass_kg");
    hand.mass_kg = mass.Number();
    if (!(*hand.mass_kg > 0)) mass.Fail("expected a positive number, found " + mass.Quoted());
  }
  return hand;
}

HandPath ReadHandPath(const JsonReader& json) {
  HandPath path;
  for (const JsonReader& state : json.Elements()) path.push_back(ReadState(state));
  if (path.empty()) json.Fail("expected at least one state of the hand");
  return path;
}

SwitchMotion ReadSwitchMotion(const JsonReader& json) {
  return {ReadHandPath(json.Member("place")), ReadHandPath(json.Member("release"))};
}

Json HandUseJson(const HandUse& hand) {
  Json json = {{"name", hand.name},
               {"file", hand.file},
               {"sha256", hand.sha256},
               {"initial", StateJson(hand.initial)},
               {"goal", PoseJson(hand.goal)}};
  if (!hand.goals.empty()) json["goals"] = GoalMarksJson(hand.goals);
  if (hand.up) json["up"] = VectorJson(*hand.up, 3);
  if (hand.gravity_support) {
    json["gravity_support"] = {{"disturbance", hand.gravity_support->disturbance},
                               {"force", hand.gravity_support->force}};
  }
  if (hand.mass_kg) json["mass_kg"] = *hand.mass_kg;
  return json;
}

Json HandPathJson(const HandPath& path) {
  Json json = Json::array();
  for (const HandState& state : path) json.push_back(StateJson(state));
  return json;
}

Json SwitchMotionJson(const SwitchMotion& motion) {
  return {{"place", HandPathJson(motion.place)}, {"release", HandPathJson(motion.release)}};
}

}  // namespace regrasp::plan
