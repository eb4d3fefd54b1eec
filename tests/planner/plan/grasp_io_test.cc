#include "planner/plan/grasp_io.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/error.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace grasp_io_test {

std::string File(const std::string& contacts) {
  return R"({"format": "regrasp-grasp", "version": 1, "contacts": [)" + contacts + "]}";
}

std::string Complaint(const std::string& contacts, const object::Object& object) {
  try {
    static_cast<void>(ParseGrasp(File(contacts), "grasp.json", object));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GraspIo, PlacesContactsOnTheirFaces) {
  const object::Polyhedron cube = MakeCube();
  const grasp::Grasp grasp = ParseGrasp(
      File(R"({"point": [1.0000001, 0.2, 0], "normal": [-1, 0.0001, 0]}, {"point": [0, 0.5, -1]})"),
      "grasp.json", cube);
  ASSERT_EQ(grasp.size(), 2u);
  EXPECT_EQ(grasp[0].p, Eigen::Vector3d(1, 0.2, 0));
  EXPECT_EQ(grasp[0].n, Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(grasp[1].n, Eigen::Vector3d(0, 0, 1));
  for (const grasp::Contact& contact : grasp)
    EXPECT_EQ(cube.inward_normal(contact.face), contact.n);
}

TEST(GraspIo, ReadsWhatItWrites) {
  const object::Polygon square = MakeSquare();
  const grasp::Grasp grasp =
      ParseGrasp(File(R"({"point": [1, 0.3]}, {"point": [-0.1, -1]})"), "g", square);
  const std::string text = FormatGrasp(grasp, 2);
  const grasp::Grasp again = ParseGrasp(text, "g", square);
  ASSERT_EQ(again.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].p, grasp[i].p);
    EXPECT_EQ(again[i].n, grasp[i].n);
  }
  EXPECT_EQ(FormatGrasp(again, 2), text);
}

TEST(GraspIo, TheNormalChoosesTheFaceOnABorder) {
  const object::Polyhedron cube = MakeCube();
  const std::string edge = R"({"point": [1, 1, 0], "normal": )";
  EXPECT_EQ(ParseGrasp(File(edge + "[-1, 0, 0]}"), "g", cube)[0].n, Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(ParseGrasp(File(edge + "[0, -1, 0]}"), "g", cube)[0].n, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(
      Complaint(R"({"point": [1, 1, 0]})", cube).find("grasp.json: /contacts/0/point: on a b"), 0u);
}

TEST(GraspIo, RefusesContactsThatAreNotOnTheObject) {
  const object::Polyhedron cube = MakeCube();
  const object::Polygon square = MakeSquare();
  const std::string good = R"({"point": [1, 0, 0], "normal": [-1, 0, 0]})";
  ASSERT_EQ(Complaint(good, cube), "");
  EXPECT_EQ(
      Complaint(R"({"point": [1.001, 0, 0], "normal": [-1, 0, 0]})", cube),
      "grasp.json: /contacts/0/point: off the surface, expected at most 0.0001 % of the object's "
      "diameter, found 0.02887 % (0.001 in the object file's unit)");
  EXPECT_EQ(
      Complaint(R"({"point": [0.9, 0, 0]})", cube),
      "grasp.json: /contacts/0/point: off the surface, expected at most 0.0001 % of the object's "
      "diameter, found 2.887 % (0.1 in the object file's unit)");
  EXPECT_EQ(
      Complaint(R"({"point": [1e9, 0, 0]})", cube),
      "grasp.json: /contacts/0/point: off the surface, expected at most 0.0001 % of the object's "
      "diameter, found 2.887e+10 % (1e+09 in the object file's unit)");
  EXPECT_EQ(Complaint(good + R"(, {"point": [1, 0, 0], "normal": [1, 0, 0]})", cube)
                .find("grasp.json: /contacts/1/normal: the normal differs by 180.00°"),
            0u);
  EXPECT_EQ(Complaint(R"({"point": [1, 0, 0], "normal": [-2, 0, 0]})", cube),
            "grasp.json: /contacts/0/normal: the normal must have length 1, found 2, expected "
            "(-1, 0, 0)");
  EXPECT_EQ(Complaint(good, square), "grasp.json: /contacts/0/point: expected 2 numbers, found 3");
  EXPECT_EQ(Complaint("", cube), "grasp.json: /contacts: expected at least one contact");
}

}  // namespace grasp_io_test
}  // namespace regrasp::plan
