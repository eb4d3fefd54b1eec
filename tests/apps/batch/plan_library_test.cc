#include "apps/batch/plan_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace plan_library_test {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr char kPlan[] = R"({"format": "regrasp-plan", "version": 1})";

class PlanLibraryTest : public FolderTest {
 protected:
  static std::vector<std::string> Names(const PlanLibrary& library) {
    std::vector<std::string> names;
    for (const LibraryPlan& plan : library.plans) names.push_back(plan.name);
    return names;
  }

  static std::string Refusal(const std::vector<std::string>& paths) {
    try {
      (void)FindPlans(paths);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_F(PlanLibraryTest, AFolderGivesItsPlansByNameAndSaysWhatItSkips) {
  Write("b.json", kPlan);
  Write("a.json", kPlan);
  Write("notes.txt", kPlan);
  Write("c.json", R"({"format": "regrasp-grasp", "version": 1})");
  Write("d.json", R"({"name": "package"})");
  Write("e.json", "[1, 2]");
  fs::create_directories(folder_ / "f.json");
  const PlanLibrary library = FindPlans({folder_.string()});
  EXPECT_THAT(Names(library), ElementsAre("a", "b"));
  EXPECT_EQ(library.plans[0].path, folder_ / "a.json");
  ASSERT_EQ(library.skipped.size(), 4u);
  EXPECT_EQ(library.skipped[0].file, "c.json");
  EXPECT_EQ(library.skipped[0].why, "is a regrasp-grasp file");
  EXPECT_EQ(library.skipped[1].why, "format not found");
  EXPECT_EQ(library.skipped[2].why, "format not found");
  EXPECT_EQ(library.skipped[3].why, "is a folder");
}

TEST_F(PlanLibraryTest, PipesAndDevicesOfAFolderAreSkippedUnread) {
  Write("a.json", kPlan);
  ASSERT_EQ(mkfifo((folder_ / "b.json").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "c.json");
  fs::create_symlink("a.json", folder_ / "d.json");
  fs::create_symlink("nowhere.json", folder_ / "e.json");
  const PlanLibrary library = FindPlans({folder_.string()});
  EXPECT_THAT(Names(library), ElementsAre("a", "d", "e"));
  ASSERT_EQ(library.skipped.size(), 2u);
  for (const SkippedFile& file : library.skipped) EXPECT_EQ(file.why, "is not a regular file");
}

TEST_F(PlanLibraryTest, WhatCannotBeParsedMayHaveBeenAPlan) {
  Write("broken.json", R"({"format": "regrasp-plan", )");
  Write("empty.json", "");
  EXPECT_THAT(Names(FindPlans({folder_.string()})), ElementsAre("broken", "empty"));
}

TEST_F(PlanLibraryTest, FilesThatAreNamedArePlansInTheirOrder) {
  const std::string second = Write("x/second.json", "{}");
  const std::string first = Write("y/first.json", kPlan);
  Write("z/third.json", kPlan);
  const PlanLibrary library = FindPlans({second, first, (folder_ / "z").string(), "missing.json"});
  EXPECT_THAT(Names(library), ElementsAre("second", "first", "third", "missing"));
  EXPECT_TRUE(library.skipped.empty());
}

TEST_F(PlanLibraryTest, TwoPlansOfOneNameAreRefused) {
  const std::string one = Write("x/same.json", kPlan);
  const std::string other = Write("y/same.json", kPlan);
  EXPECT_THAT(Refusal({one, other}), HasSubstr("must have different names, found \"same\""));
  EXPECT_THAT(Refusal({one, one}), HasSubstr("must have different names"));
  EXPECT_THAT(Refusal({(folder_ / "x").string(), other}), HasSubstr("must have different names"));
}

TEST_F(PlanLibraryTest, AFolderWithoutPlansAndNamesThatAreNoFoldersAreRefused) {
  Write("x/grasp.json", R"({"format": "regrasp-grasp"})");
  EXPECT_THAT(Refusal({(folder_ / "x").string()}), HasSubstr("x: no plan found, expected *.json"));
  for (const char* name : {"..json", "...json", "summary.json.json", ".regrasp-run.json"}) {
    EXPECT_THAT(Refusal({Write(name, kPlan), "other.json"}),
                HasSubstr("must be usable as a folder name"))
        << name;
  }
}

TEST_F(PlanLibraryTest, PlansInSubfoldersAreNamedAndNotSearched) {
  Write("x/a/one.json", kPlan);
  Write("x/a/deep/two.json", kPlan);
  Write("x/b/grasp.json", R"({"format": "regrasp-grasp"})");
  const std::string folder = (folder_ / "x").string();
  EXPECT_THAT(Refusal({folder}),
              AllOf(HasSubstr("a/ is a subfolder with 2 plans; subfolders are not searched"),
                    HasSubstr("; help: give --plan " + folder + "/a"), Not(HasSubstr("b/"))));
  // With a plan next to them they are skipped by name.
  Write("x/three.json", kPlan);
  const PlanLibrary library = FindPlans({folder});
  EXPECT_THAT(Names(library), ElementsAre("three"));
  ASSERT_EQ(library.skipped.size(), 1u);
  EXPECT_EQ(library.skipped[0].file, "a/");
}

TEST_F(PlanLibraryTest, AFolderWithPlansInLinesSaysHowToNameThem) {
  Write("x/plans.jsonl", kPlan);
  EXPECT_THAT(Refusal({(folder_ / "x").string()}),
              HasSubstr("help: give --plan " + (folder_ / "x" / "plans.jsonl").string()));
}

}  // namespace plan_library_test
}  // namespace regrasp::apps
