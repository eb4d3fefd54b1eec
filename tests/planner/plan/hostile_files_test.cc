// Deliberately broken plan and grasp files. The only allowed results are an InputError with one
// line that names the file, and a plan that the checker accepts.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "sample_plans.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/project_path.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace hostile_files_test {

struct Outcome {
  bool read = false;
  std::string message;
};

void ExpectOneLineAbout(const std::string& message, const std::string& name) {
  EXPECT_EQ(message.rfind(name + ": ", 0), 0u) << message;
  EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
  EXPECT_GT(message.size(), name.size() + 2);
}

/// Read a plan, and check it if `check` is given.
Outcome TryPlan(const std::string& text, const object::Object* check = nullptr) {
  try {
    const Plan plan = ParsePlan(text, "hostile.json");
    if (check != nullptr && plan.dimension == check->dimension()) {
      static_cast<void>(CheckPlan(*check, plan));
    }
    return {true, ""};
  } catch (const InputError& error) {
    ExpectOneLineAbout(error.what(), "hostile.json");
    return {false, error.what()};
  }
}

Outcome TryGrasp(const std::string& text, const object::Object& object) {
  try {
    static_cast<void>(ParseGrasp(text, "hostile.json", object));
    return {true, ""};
  } catch (const InputError& error) {
    ExpectOneLineAbout(error.what(), "hostile.json");
    return {false, error.what()};
  }
}

std::string GraspText() {
  return R"({"format": "regrasp-grasp", "version": 1, "contacts": [
    {"point": [1, 0.2, 0], "normal": [-1, 0, 0]}, {"point": [0.1, -1, 0.5]},
    {"point": [1, 1, 0.5], "normal": [0, -1, 0]}]})";
}

std::vector<std::filesystem::path> Corpus(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path root = ProjectPath("tests/data/plans") / folder;
  for (const auto& entry : std::filesystem::directory_iterator(root)) files.push_back(entry);
  std::ranges::sort(files);
  return files;
}

TEST(HostileFiles, GoodFilesOfTheCorpusAreRead) {
  int read = 0;
  for (const auto& file : Corpus("plan_good")) {
    EXPECT_NO_THROW(static_cast<void>(ReadPlan(file))) << file;
    ++read;
  }
  EXPECT_GT(read, 2);
  for (const auto& file : Corpus("grasp_good")) {
    EXPECT_NO_THROW(static_cast<void>(ReadGrasp(file, MakeCube()))) << file;
    ++read;
  }
  EXPECT_GT(read, 4);
}

TEST(HostileFiles, BadFilesOfTheCorpusAreRefused) {
  int refused = 0;
  for (const auto& file : Corpus("plan_bad")) {
    SCOPED_TRACE(file.string());
    try {
      static_cast<void>(ReadPlan(file));
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      ExpectOneLineAbout(error.what(), file.string());
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
  const int plans = refused;
  for (const auto& file : Corpus("grasp_bad")) {
    SCOPED_TRACE(file.string());
    try {
      static_cast<void>(ReadGrasp(file, MakeCube()));
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      ExpectOneLineAbout(error.what(), file.string());
      ++refused;
    }
  }
  EXPECT_GT(refused, plans + 4);
}

TEST(HostileFiles, TruncatedAnywhereIsRefused) {
  const std::string plan = FormatPlan(SquarePlan());
  int refused = 0;
  // Every length without the final newline and brace.
  for (std::size_t length = 0; length + 1 < plan.size(); ++length) {
    refused += !TryPlan(plan.substr(0, length)).read;
  }
  EXPECT_EQ(refused, std::ssize(plan) - 1);
  const object::Polyhedron cube = MakeCube();
  const std::string grasp = GraspText();
  ASSERT_TRUE(TryGrasp(grasp, cube).read);
  for (std::size_t length = 0; length < grasp.size(); ++length) {
    EXPECT_FALSE(TryGrasp(grasp.substr(0, length), cube).read) << length;
  }
}

TEST(HostileFiles, RandomBytesAreRefusedOrHarmless) {
  const object::Polyhedron cube = MakeCube();
  const std::string plan = FormatPlan(CubePlan());
  const std::string grasp = GraspText();
  std::mt19937 random(11);
  int refused = 0, read = 0;
  const auto corrupt = [&](std::string text) {
    for (int flips = 1 + static_cast<int>(random() % 3); flips > 0; --flips) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    return text;
  };
  for (int i = 0; i < 3000; ++i) {
    ++(TryPlan(corrupt(plan)).read ? read : refused);
    ++(TryGrasp(corrupt(grasp), cube).read ? read : refused);
  }
  EXPECT_EQ(refused + read, 6000);
  EXPECT_GT(refused, 3000);
  EXPECT_GT(read, 0);
}

/// Collect the JSON pointers of all members and elements of a value.
void CollectPointers(const Json& value, const Json::json_pointer& at,
                     std::vector<Json::json_pointer>& pointers) {
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      pointers.push_back(at / key);
      CollectPointers(member, at / key, pointers);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      pointers.push_back(at / i);
      CollectPointers(value[i], at / i, pointers);
    }
  }
}

Json Without(const Json& json, const Json::json_pointer& pointer) {
  Json result = json;
  Json& parent = result[pointer.parent_pointer()];
  if (parent.is_array()) {
    parent.erase(static_cast<std::size_t>(std::stoul(pointer.back())));
  } else {
    parent.erase(pointer.back());
  }
  return result;
}

const std::vector<Json>& Replacements() {
  static const std::vector<Json> values = {
      nullptr, "text", "",   1e300, -1e300,        1e15,          -1, 0, 1e-300, true, 0.5, 7,
      90,      1e9,    -0.0, 2e-9,  Json::array(), Json::object()};
  return values;
}

TEST(HostileFiles, AnyPartLeftOutOrReplacedIsRefusedOrJudged) {
  const object::Polyhedron cube = MakeCube();
  const object::Polygon square = MakeSquare();
  int tried = 0, refused = 0;
  for (const bool planar : {false, true}) {
    const object::Object& object = planar ? static_cast<const object::Object&>(square) : cube;
    const Json plan = Json::parse(FormatPlan(planar ? SquarePlan() : CubePlan()));
    std::vector<Json::json_pointer> pointers;
    CollectPointers(plan, Json::json_pointer(), pointers);
    for (const Json::json_pointer& pointer : pointers) {
      refused += !TryPlan(Without(plan, pointer).dump(), &object).read;
      ++tried;
      for (const Json& value : Replacements()) {
        Json changed = plan;
        changed[pointer] = value;
        refused += !TryPlan(changed.dump(), &object).read;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 3000);
  EXPECT_GT(refused, tried / 2);
  EXPECT_LT(refused, tried);
}

TEST(HostileFiles, AnyPartOfAGraspLeftOutOrReplacedIsRefusedOrRead) {
  const object::Polyhedron cube = MakeCube();
  const Json grasp = Json::parse(GraspText());
  std::vector<Json::json_pointer> pointers;
  CollectPointers(grasp, Json::json_pointer(), pointers);
  int tried = 0, refused = 0;
  for (const Json::json_pointer& pointer : pointers) {
    refused += !TryGrasp(Without(grasp, pointer).dump(), cube).read;
    ++tried;
    for (const Json& value : Replacements()) {
      Json changed = grasp;
      changed[pointer] = value;
      refused += !TryGrasp(changed.dump(), cube).read;
      ++tried;
    }
  }
  EXPECT_GT(refused, tried / 2);
  EXPECT_LT(refused, tried);
}

TEST(HostileFiles, GraspsOfFarTooManyFingersAreJudged) {
  // Number of contacts; comparing all their pairs would take hours.
  constexpr int kContacts = 100'000;
  const object::Polyhedron cube = MakeCube();
  FingerGrasp crowd;
  for (int finger = 0; finger < kContacts; ++finger) {
    crowd.push_back({FingerIndex(finger), {{1, -1 + 2.0 * finger / kContacts, 0}, {-1, 0, 0}}});
  }
  Plan plan = CubePlan();
  plan.initial = crowd;
  EXPECT_EQ(CheckPlan(cube, plan).steps[0].reason, Reason::kTooManyFingers);
  plan = CubePlan();
  std::get<Switch>(plan.steps[0]).place = crowd;
  EXPECT_EQ(CheckPlan(cube, plan).steps[1].reason, Reason::kFingerNotFree);
  plan = CubePlan();
  std::get<Align>(plan.steps[2]).waypoints = {crowd, crowd};
  EXPECT_EQ(CheckPlan(cube, plan).steps[3].reason, Reason::kTooManyFingers);
  plan = CubePlan();
  plan.goal = ContactsOf(crowd);
  EXPECT_EQ(CheckPlan(cube, plan).steps[3].reason, Reason::kGoalNotReached);
}

TEST(HostileFiles, RequiredFieldsCannotBeLeftOut) {
  const Json plan = Json::parse(FormatPlan(CubePlan()));
  for (const char* pointer : {"/format",
                              "/version",
                              "/object",
                              "/object/file",
                              "/object/sha256",
                              "/object/scale",
                              "/object/dimension",
                              "/friction",
                              "/friction/half_angle_deg",
                              "/fingers",
                              "/planner",
                              "/initial",
                              "/initial/contacts",
                              "/initial/contacts/0/finger",
                              "/initial/contacts/0/point",
                              "/initial/contacts/0/normal",
                              "/steps",
                              "/steps/0/kind",
                              "/steps/0/place",
                              "/steps/0/release",
                              "/steps/2/waypoints",
                              "/steps/2/waypoints/0/contacts",
                              "/goal",
                              "/goal/contacts",
                              "/goal/contacts/0/normal"}) {
    const Json::json_pointer at(pointer);
    ASSERT_TRUE(plan.contains(at)) << pointer;
    const Outcome outcome = TryPlan(Without(plan, at).dump());
    EXPECT_FALSE(outcome.read) << pointer;
    EXPECT_NE(outcome.message.find("member \"" + at.back() + "\" not found"), std::string::npos)
        << outcome.message;
  }
}

}  // namespace hostile_files_test
}  // namespace regrasp::plan
