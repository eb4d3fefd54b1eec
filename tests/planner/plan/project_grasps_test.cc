#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "planner/plan/projection.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace project_grasps_test {

using testing::ElementsAre;

class ProjectGraspsTest : public testing::Test {
 protected:
  object::ObjectFile cube_ = ReadModel("cube.obj");  // side 0.06
  std::vector<double> points_, normals_;

  void Add(const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    points_.insert(points_.end(), p.data(), p.data() + 3);
    normals_.insert(normals_.end(), n.data(), n.data() + 3);
  }
  void AddPair(const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    Add({-0.03, 0, 0}, {1, 0, 0});
    Add(p, n);
  }
};

TEST_F(ProjectGraspsTest, SaysOfEachGraspWhatLocateContactSays) {
  AddPair({0.03 + 1e-9, 0.01, 0.02}, {-1, 0, 0});  // on the surface except for rounding
  AddPair({0.031, 0.01, 0.02}, {-1, 0, 0});
  AddPair({0.03, 0.01, 0.02}, {1, 0, 0});
  AddPair({0.03, 0.03, 0.02}, {0, -1, 0});  // on an edge, so that the normal determines the face
  AddPair({-0.03, 1e-9, 0}, {1, 0, 0});
  const ProjectedGrasps projected = ProjectGrasps(*cube_.object, points_, normals_, 2);
  EXPECT_THAT(projected.reasons,
              ElementsAre(Reason::kNone, Reason::kOffSurface, Reason::kWrongNormal, Reason::kNone,
                          Reason::kCoincidentFingers));
  EXPECT_THAT(projected.contacts, ElementsAre(-1, 1, 1, -1, -1));
  for (std::size_t c = 0; c < points_.size() / 3; ++c) {
    const auto alone = ProjectContact(*cube_.object, {Eigen::Vector3d::Map(&points_[3 * c]),
                                                      Eigen::Vector3d::Map(&normals_[3 * c])});
    EXPECT_EQ(Eigen::Vector3d::Map(&projected.points[3 * c]), alone.contact.p);
    EXPECT_EQ(Eigen::Vector3d::Map(&projected.normals[3 * c]), alone.contact.n);
  }
}

TEST_F(ProjectGraspsTest, ANormalThatIsLeftOutIsThatOfTheOnlyFace) {
  AddPair({0.03, 0.01, 0.02}, {});
  AddPair({0.03, 0.03, 0.02}, {});
  AddPair({0.2, 0.01, 0.02}, {});
  const ProjectedGrasps projected = ProjectGrasps(*cube_.object, points_, {}, 2);
  EXPECT_THAT(projected.reasons,
              ElementsAre(Reason::kNone, Reason::kWrongNormal, Reason::kOffSurface));
  EXPECT_EQ(Eigen::Vector3d::Map(&projected.normals[3]), Eigen::Vector3d(-1, 0, 0));
}

TEST_F(ProjectGraspsTest, DoesNotDependOnTheThreads) {
  for (int i = 0; i < 2000; ++i) AddPair({0.03, 1e-5 * i, i % 7 == 0 ? 1.0 : 0.01}, {-1, 0, 0});
  const ProjectedGrasps one = ProjectGrasps(*cube_.object, points_, normals_, 2, 1);
  const ProjectedGrasps five = ProjectGrasps(*cube_.object, points_, normals_, 2, 5);
  EXPECT_EQ(one.reasons, five.reasons);
  EXPECT_EQ(one.points, five.points);
  EXPECT_EQ(one.normals, five.normals);
  EXPECT_EQ(std::ranges::count(one.reasons, Reason::kOffSurface), 286);
}

TEST_F(ProjectGraspsTest, AWallOfASealedCavityIsUnreachable) {
  const object::Polyhedron hollow = MakeHollowCube();
  int walls = 0;
  for (FaceIndex face{0}; face < hollow.face_count(); ++face) {
    const Eigen::Vector3d& n = hollow.inward_normal(face);
    const Eigen::Vector3d p = hollow.ClosestPoint(face, Eigen::Vector3d(0.1, 0.2, 0.3));
    const std::vector<double> point = {p.x(), p.y(), p.z()};
    const std::vector<double> normal = {n.x(), n.y(), n.z()};
    const bool enclosed = hollow.IsEnclosed(face);
    EXPECT_EQ(ProjectGrasps(hollow, point, normal, 1).reasons.front(),
              enclosed ? Reason::kUnreachable : Reason::kNone);
    walls += enclosed ? 1 : 0;
  }
  EXPECT_EQ(walls, 6);
}

TEST_F(ProjectGraspsTest, WrongNumbersOfValuesAreRefused) {
  AddPair({0.03, 0, 0}, {-1, 0, 0});
  EXPECT_THROW(static_cast<void>(ProjectGrasps(*cube_.object, points_, normals_, 4)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(ProjectGrasps(*cube_.object, points_, normals_, 0)),
               std::invalid_argument);
  normals_.pop_back();
  EXPECT_THROW(static_cast<void>(ProjectGrasps(*cube_.object, points_, normals_, 2)),
               std::invalid_argument);
}

}  // namespace project_grasps_test
}  // namespace regrasp::plan
