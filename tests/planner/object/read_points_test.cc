#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "planner/object/read_object.h"

namespace regrasp::object {
namespace read_points_test {

using Eigen::Vector3d;

const std::vector<Vector3d> kPoints = {{0.25, -1, 2}, {3, 4.5, -6}, {1e-3, 0, 7}};

/// Write the header of a PCD file of kPoints with a field between y and z.
std::string PcdHeaderOf(const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y rgb z\nSIZE 8 8 4 8\nTYPE F F U F\nCOUNT 1 1 2 1\n"
         "WIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA " +
         data + "\n";
}

TEST(ReadPoints, XyzTakesTheFirstThreeNumbersOfALine) {
  const PolygonSoup cloud =
      ReadXyz("0.25 -1 2 0 0 1\r\n3 4.5 -6 255 255 0 9\n\n1e-3 0 7\n", "cloud.xyz");
  EXPECT_EQ(cloud.vertices, kPoints);
  EXPECT_TRUE(cloud.facets.empty());
}

TEST(ReadPoints, PcdInTextIsReadByItsFieldsWithoutPointsThatAreNone) {
  const std::string text =
      PcdHeaderOf("ascii") + "0.25 -1 7 8 2\n3 4.5 0 0 -6\nnan nan 0 0 nan\n1e-3 0 9 9 7\n";
  EXPECT_EQ(ReadPcd(text, "cloud.pcd").vertices, kPoints);
}

TEST(ReadPoints, PcdInBinaryIsTheSame) {
  std::string bytes = PcdHeaderOf("binary");
  const auto append = [&](double value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Vector3d& point :
       {kPoints[0], Vector3d(Vector3d::Constant(std::nan(""))), kPoints[1], kPoints[2]}) {
    append(point.x());
    append(point.y());
    bytes.append(8, '\x7f');
    append(point.z());
  }
  EXPECT_EQ(ReadPcd(bytes, "cloud.pcd").vertices, kPoints);
}

}  // namespace read_points_test
}  // namespace regrasp::object
