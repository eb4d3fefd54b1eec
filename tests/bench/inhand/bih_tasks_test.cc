#include "bench/inhand/bih_tasks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::bench {
namespace bih_tasks_test {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kColumns[] = "Object,Initial palm pose,Desired palm pose\n";
constexpr char kLine[] =
    "Sugar box,\"0.01,0.02,0.03,0.4,-0.5,0.6\",\"-0.02,0.03,0.05,-1,0.7,2.5\"\n";

Eigen::Matrix3d About(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Return the rotation: roll about x, then pitch about y, then yaw about z, all about fixed axes.
Eigen::Matrix3d RollPitchYaw(double roll, double pitch, double yaw) {
  return About(Vector3d::UnitZ(), yaw) * About(Vector3d::UnitY(), pitch) *
         About(Vector3d::UnitX(), roll);
}

class Bih : public FolderTest {
 protected:
  Bih() { Write("meshes/004_sugar_box.obj", ReadFile(ProjectPath("models/l_block.obj"))); }

  BihTasks Read(const std::string& sheet) {
    return ReadBih(Write("sheet.csv", sheet), folder_ / "meshes");
  }
  std::string Complaint(const std::string& sheet) {
    try {
      (void)Read(sheet);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

/// Independent calculation: points of the object in the palm frame, before and after, instead of
/// poses.
TEST_F(Bih, DisplacesTheBodyAsThePalmSeesIt) {
  const BihTasks bih = Read(std::string(kColumns) + kLine);
  ASSERT_EQ(bih.tasks.size(), 1U);
  const Task& task = bih.tasks.front();
  EXPECT_EQ(task.name, "bih/sugar_box/1");
  EXPECT_EQ(task.body, "bih-sugar_box");
  const Eigen::Matrix3d before = RollPitchYaw(0.4, -0.5, 0.6);
  const Eigen::Matrix3d after = RollPitchYaw(-1, 0.7, 2.5);
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();  // pose of the object in the palm frame
  start.linear() = before.transpose();
  start.translation() = -(before.transpose() * Vector3d(0.01, 0.02, 0.03));
  const Eigen::Isometry3d goal = GoalPose(task, bih.bodies.front().centre(), start);
  for (const Vector3d& point : {Vector3d(0, 0, 0), Vector3d(0.1, -0.2, 0.3)}) {
    const Vector3d seen = after.transpose() * (point - Vector3d(-0.02, 0.03, 0.05));
    EXPECT_LT((goal * point - seen).norm(), 1e-12);
  }
}

TEST_F(Bih, CountsTasksOfAnObjectAndNamesThoseWithoutMesh) {
  const BihTasks bih =
      Read(std::string(kColumns) + kLine + "fork,\"0,0,0,0,0,0\",\"0,0,0.1,0,0,0\"\n" + kLine);
  ASSERT_EQ(bih.tasks.size(), 2U);
  EXPECT_EQ(bih.tasks.back().name, "bih/sugar_box/2");
  EXPECT_EQ(bih.bodies.size(), 1U);
  EXPECT_THAT(bih.without_mesh, ElementsAre("fork"));
}

TEST_F(Bih, RefusesSheetsOfAnotherForm) {
  EXPECT_THAT(Complaint("Object,Pose\nsugar box,b\n"), HasSubstr("there is no column \""));
  EXPECT_THAT(Complaint(std::string(kColumns) + "sugar box,\"1,2\",\"0,0,0,0,0,0\"\n"),
              HasSubstr("line 2: expected 6 numbers"));
  EXPECT_THROW((void)ReadBih(Write("s.csv", kColumns), folder_ / "nowhere"), InputError);
}

}  // namespace bih_tasks_test
}  // namespace regrasp::bench
