#include "planner/object/body_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/fixtures/models.h"
#include "tests/fixtures/moved.h"
#include "tests/fixtures/project_path.h"
#include "tests/fixtures/solids.h"

namespace regrasp::object {
namespace body_measures_test {

using testing::HasSubstr;

TEST(BodyMeasures, OfACubeOfSixCentimetresAreThoseOfWater) {
  const ObjectFile cube = ReadModel("cube.obj");
  const BodyMeasures body = MeasureBody(*cube.object, 1);
  EXPECT_NEAR(body.mass_kg, 0.216, 1e-9);
  EXPECT_EQ(body.thickness_m, 0);
  EXPECT_EQ(MeasuresText(body), "10.4 cm across, 216 g");
  EXPECT_NEAR(MeasureBody(*cube.object, 1, 2 * kUsualDensity).mass_kg, 0.432, 1e-9);
}

/// The files contain the same tetrahedron, 1 m along each axis, in named units. Coordinates are
/// read in metres.
TEST(BodyMeasures, FilesSayTheirUnit) {
  for (const auto& [name, unit] :
       {std::tuple("centimetres.dae", "centimetres"), {"millimetres.fbx", "millimetres"}}) {
    const ObjectFile file = ReadObject(ProjectPath(std::string("tests/data/objects/good/") + name));
    EXPECT_NEAR(file.object->diameter(), std::sqrt(2), 1e-6) << name;
    EXPECT_THAT(UnitText(file.unit), HasSubstr(unit)) << name;
    EXPECT_THAT(UnitText(file.unit), HasSubstr("read as metres")) << name;
  }
  EXPECT_EQ(UnitText(ReadModel("cube.obj").unit), "");
}

TEST(BodyMeasures, OfAPolygonAreThoseOfAPrism) {
  const ObjectFile square = ReadModel("square.wkt");
  const BodyMeasures body = MeasureBody(*square.object, 1);
  EXPECT_NEAR(body.thickness_m, square.object->diameter() / 4, 1e-12);
  EXPECT_THAT(MeasuresText(body), HasSubstr(" thick, "));
  EXPECT_NEAR(MeasureBody(*square.object, 1, kUsualDensity, 2 * body.thickness_m).mass_kg,
              2 * body.mass_kg, 1e-12);
}

TEST(Width, IsThatOfTheNarrowestSideInEveryPose) {
  const Polyhedron box = MakeBox({0.02, 0.05, 0.12});
  EXPECT_NEAR(MeasureWidth(box), 0.02, 1e-12);
  Eigen::Affine3d moved = Eigen::Affine3d::Identity();
  moved.rotate(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()));
  moved.pretranslate(Eigen::Vector3d(0.3, 0, -1));
  EXPECT_NEAR(MeasureWidth(Moved(box, moved)), 0.02, 1e-12);
  EXPECT_NEAR(MeasureWidth(Moved(box, moved * Eigen::Scaling(3.0))), 0.06, 1e-12);
  for (const char* model : {"prism.obj", "tetrahedron.obj", "duck500.obj"}) {
    const Polyhedron solid = ReadSolidModel(model);
    EXPECT_GT(MeasureWidth(solid), 0) << model;
    EXPECT_LT(MeasureWidth(solid), solid.diameter()) << model;
  }
}

TEST(BodyMeasures, GrowWithTheScaleAndSaySoInOtherUnits) {
  const ObjectFile cube = ReadModel("cube.obj");
  EXPECT_EQ(MeasuresText(MeasureBody(*cube.object, 10)), "1.04 m across, 216 kg");
  EXPECT_EQ(MeasuresText(MeasureBody(*cube.object, 0.01)), "1.04 mm across, 216 µg");
  EXPECT_EQ(MeasuresText(MeasureBody(*cube.object, 1000)), "104 m across, 2.16e+08 kg");
}

TEST(BodyMeasures, WarnOfASizeThatHandsDoNotGraspAndNameTheScale) {
  for (const double usual : {kSmallestUsual, 0.1, kLargestUsual}) {
    EXPECT_EQ(SizeWarning({usual, 0, 1}, 1), "") << usual;
  }
  for (const double unusual : {0.99 * kSmallestUsual, 1.01 * kLargestUsual}) {
    EXPECT_THAT(SizeWarning({unusual, 0, 1}, 1), HasSubstr("--scale")) << unusual;
  }
}

TEST(BodyMeasures, TheWarningGuessesTheUnitInWhichAHandWouldGraspIt) {
  const auto guess = [](double units, double scale) {
    return SizeWarning({units * scale, 0, 1}, scale);
  };
  EXPECT_THAT(
      guess(163, 1),
      HasSubstr(
          "163 m across, 1 kg; help: if the file is in millimetres, pass --scale 0.001 (16.3 cm"));
  EXPECT_THAT(guess(20, 1), HasSubstr("millimetres, pass --scale 0.001 (2 cm"));
  EXPECT_THAT(guess(19, 1), HasSubstr("centimetres, pass --scale 0.01 (19 cm"));
  EXPECT_THAT(guess(400, 1), HasSubstr("in millimetres"));
  EXPECT_THAT(guess(0.1, 0.001), HasSubstr("metres, pass --scale 1 (10 cm"));
  EXPECT_THAT(guess(401, 1), HasSubstr("pass the length of a file unit in metres with --scale"));
  EXPECT_THAT(guess(0.001, 1), HasSubstr("pass the length of a file unit in metres with --scale"));
  // As millimetres it is only 3 mm; centimetres are suggested before inches.
  EXPECT_THAT(guess(3, 1), HasSubstr("centimetres, pass --scale 0.01 (3 cm"));
}

}  // namespace body_measures_test
}  // namespace regrasp::object
