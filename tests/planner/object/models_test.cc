#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::object {
namespace models_test {

using Eigen::Vector3d;

struct Model {
  std::string file;
  int faces;
  double diameter;  ///< diameter, m
  double volume;    ///< volume, m³, or area, m²; 0 if there is no closed form
};

const Model kModels[] = {
    {"cube.obj", 6, 0.06 * std::sqrt(3), 0.06 * 0.06 * 0.06},
    {"tetrahedron.obj", 4, 0.072 * std::sqrt(2), 0.072 * 0.072 * 0.072 / 3},
    {"prism.obj", 5, std::hypot(0.09, 0.08), std::sqrt(3) / 4 * 0.09 * 0.09 * 0.08},
    {"l_block.obj", 8, std::hypot(0.1, 0.1, 0.06), (0.01 - 0.0036) * 0.06},
    {"hole_block.obj", 10, std::hypot(0.1, 0.1, 0.06), (0.01 - 0.0025) * 0.06},
    {"u_channel.obj", 10, std::hypot(0.1, 0.08, 0.06), (0.1 * 0.02 + 2 * 0.06 * 0.02) * 0.06},
    {"pyramid.obj", 6, 0, 0},
    {"stone.obj", 20, 0, 0},
    {"square.wkt", 4, 0.06 * std::sqrt(2), 0.06 * 0.06},
    {"triangle.wkt", 3, 0.09, std::sqrt(3) / 4 * 0.09 * 0.09},
    {"polygon15.wkt", 15, 0, 0},
    {"polygon20.wkt", 20, 0, 0},
    {"polygon25.wkt", 25, 0, 0},
    {"polygon30.wkt", 30, 0, 0},
    {"polygon35.wkt", 35, 0, 0},
    {"polygon40.wkt", 40, 0, 0},
    {"polygon_hole.wkt", 21, 0, 0},
};

/// Models with many faces or edges; their names contain the number.
const Model kLargeModels[] = {
    {"body14.obj", 14, 0, 0},   {"body24.obj", 24, 0, 0},          {"body34.obj", 34, 0, 0},
    {"body36.obj", 36, 0, 0},   {"body38.obj", 38, 0, 0},          {"body40.obj", 40, 0, 0},
    {"body42.obj", 42, 0, 0},   {"body47.obj", 47, 0, 0},          {"body67.obj", 67, 0, 0},
    {"gear128.wkt", 128, 0, 0}, {"bottle200.wkt", 200, 0, 0},      {"wrench256.wkt", 256, 0, 0},
    {"leaf300.wkt", 300, 0, 0}, {"plate_holes160.wkt", 160, 0, 0},
};

/// Meshes of smooth objects; their names end with the number of triangles.
const std::array kMeshes = {"ellipsoid", "flask", "mug", "spanner", "star", "duck"};
const std::array kMeshTriangles = {500, 1000};

bool IsSolid(const Model& model) { return model.file.ends_with(".obj"); }

std::filesystem::path ModelPath(const std::string& file) { return ProjectPath("models") / file; }

/// Read the contacts of a grasp file, on the faces given there.
grasp::Grasp ReadModelGrasp(const Model& model, const Object& object, const std::string& which) {
  const auto path = ModelPath(model.file).replace_extension(which + ".json");
  grasp::Grasp grasp;
  const Json file = ParseJson(ReadFile(path), path.string());
  for (const Json& entry : file.at("contacts")) {
    grasp::Contact contact;
    for (int i = 0; i < object.dimension(); ++i) {
      contact.p[i] = entry.at("point").at(i);
      contact.n[i] = entry.at("normal").at(i);
    }
    const auto near = object.FacesNear(contact.p, kPointTolerance * object.diameter());
    EXPECT_EQ(near.size(), 1u) << path;
    contact.face = near.at(0);
    grasp.push_back(contact);
  }
  return grasp;
}

TEST(Models, EachReadsWithItsFacesAndSize) {
  for (const Model& model : kModels) {
    SCOPED_TRACE(model.file);
    const ObjectFile file = ReadObject(ModelPath(model.file));
    EXPECT_EQ(file.file, model.file);
    EXPECT_EQ(file.sha256.size(), 64u);
    const Object& object = *file.object;
    EXPECT_EQ(object.face_count(), model.faces);
    EXPECT_GE(object.diameter(), 0.05);
    EXPECT_LE(object.diameter(), 0.16);
    if (model.volume == 0) continue;
    EXPECT_NEAR(object.diameter(), model.diameter, 1e-9);
    EXPECT_NEAR(object.mass_properties().volume, model.volume, 1e-6 * model.volume);
  }
}

TEST(Models, LargeOnesHaveAsManyFacesAsTheirNamesSay) {
  int checked = 0;
  for (const Model& model : kLargeModels) {
    SCOPED_TRACE(model.file);
    const ObjectFile file = ReadObject(ModelPath(model.file));
    EXPECT_EQ(file.object->face_count(), model.faces);
    EXPECT_NE(model.file.find(std::to_string(model.faces)), std::string::npos);
    EXPECT_GE(file.object->diameter(), 0.08);
    EXPECT_LE(file.object->diameter(), 0.16);
    ++checked;
  }
  EXPECT_EQ(checked, 9 + 5);
}

TEST(Models, MeshesHaveAsManyTrianglesAsTheirNamesSay) {
  for (const std::string name : kMeshes) {
    for (const int triangles : kMeshTriangles) {
      const std::string file = name + std::to_string(triangles) + ".obj";
      SCOPED_TRACE(file);
      const ObjectFile read = ReadObject(ModelPath(file));
      const auto& solid = dynamic_cast<const Polyhedron&>(*read.object);
      EXPECT_EQ(std::ssize(solid.triangles()), triangles);
      // Nearly no neighbours are coplanar.
      EXPECT_GE(solid.face_count(), triangles - 5);
      EXPECT_GE(solid.diameter(), 0.08);
      EXPECT_LE(solid.diameter(), 0.16);
    }
  }
}

TEST(Models, EachSolidHasALineThatSaysWhatItIs) {
  int checked = 0;
  for (const Model& model : kModels) {
    if (!IsSolid(model)) continue;
    EXPECT_EQ(ReadFile(ModelPath(model.file)).find("# A"), 0u) << model.file;
    ++checked;
  }
  EXPECT_EQ(checked, 8);
}

TEST(Models, EveryModelIsInOneOfTheTables) {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ModelPath(""))) {
    if (!entry.is_regular_file()) continue;  // the folder models/hands
    const auto ending = entry.path().extension();
    found += ending != ".json" && ending != ".md";
  }
  EXPECT_EQ(found, std::ssize(kModels) + std::ssize(kLargeModels) +
                       std::ssize(kMeshes) * std::ssize(kMeshTriangles));
}

TEST(Models, GraspsLieInsideFacesWithTheirNormals) {
  int contacts = 0;
  for (const Model& model : kModels) {
    const double from_border = IsSolid(model) ? 0.008 : 0.003;  // m
    const ObjectFile file = ReadObject(ModelPath(model.file));
    for (const std::string which : {"start", "goal"}) {
      SCOPED_TRACE(model.file + " " + which);
      const grasp::Grasp grasp = ReadModelGrasp(model, *file.object, which);
      if (IsSolid(model)) {
        EXPECT_EQ(grasp.size(), 4u);
      } else {
        EXPECT_TRUE(grasp.size() == 2 || grasp.size() == 3);
      }
      for (const grasp::Contact& contact : grasp) {
        EXPECT_NEAR((file.object->inward_normal(contact.face) - contact.n).norm(), 0, 1e-6);
        EXPECT_GE(file.object->DistanceToBorder(contact.face, contact.p), from_border);
        ++contacts;
      }
    }
  }
  // Five of the planar grasps have two contacts, thirteen have three.
  EXPECT_EQ(contacts, 2 * 8 * 4 + 5 * 2 + 13 * 3);
}

TEST(Models, GraspsAreForceClosureAtTwentyDegreesWithAClearMargin) {
  constexpr double kFrictionAngle = Radians(20);
  for (const Model& model : kModels) {
    const ObjectFile file = ReadObject(ModelPath(model.file));
    const WrenchFrame frame = file.object->wrench_frame();
    for (const std::string which : {"start", "goal"}) {
      SCOPED_TRACE(model.file + " " + which);
      const grasp::Grasp grasp = ReadModelGrasp(model, *file.object, which);
      EXPECT_TRUE(grasp::IsForceClosure(grasp, frame, kFrictionAngle));
      const auto required = grasp::ComputeRequiredFrictionAngle(grasp, frame);
      ASSERT_TRUE(required.has_value());
      EXPECT_LE(Degrees(required->upper), 15);
      EXPECT_GE(grasp::ComputeQuality(grasp, frame, kFrictionAngle).lower, 0.02);
    }
  }
}

TEST(Models, StartAndGoalShareNoContact) {
  constexpr double kApart = 0.005;  // m
  int compared = 0;
  for (const Model& model : kModels) {
    const ObjectFile file = ReadObject(ModelPath(model.file));
    const grasp::Grasp start = ReadModelGrasp(model, *file.object, "start");
    const grasp::Grasp goal = ReadModelGrasp(model, *file.object, "goal");
    for (const grasp::Contact& a : start) {
      for (const grasp::Contact& b : goal) {
        EXPECT_TRUE((a.p - b.p).norm() >= kApart || a.face != b.face) << model.file;
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 8 * 16 + 9 * 4);
}

/// Count contacts at positions that are invisible from outside the object's convex hull.
int ContactsIn(const std::string& file, bool (*inside)(const grasp::Contact&)) {
  const Model& model =
      *std::ranges::find_if(kModels, [&](const Model& m) { return m.file == file; });
  const ObjectFile read = ReadObject(ModelPath(file));
  int count = 0;
  for (const std::string which : {"start", "goal"}) {
    const grasp::Grasp grasp = ReadModelGrasp(model, *read.object, which);
    count += static_cast<int>(std::ranges::count_if(grasp, inside));
  }
  return count;
}

TEST(Models, SomeContactsAreOnInnerFaces) {
  // The two faces at the inner corner of the L are 4 cm from the axes.
  EXPECT_GE(
      ContactsIn("l_block.obj",
                 [](const grasp::Contact& c) { return std::abs(-c.n.dot(c.p) - 0.04) < 1e-9; }),
      1);
  EXPECT_GE(ContactsIn("hole_block.obj",
                       [](const grasp::Contact& c) {
                         return std::abs(c.n.z()) < 0.5 &&
                                c.p.head<2>().cwiseAbs().maxCoeff() < 0.03;
                       }),
            1);
  // The walls of the channel face each other; its floor is 2 cm above the bottom.
  EXPECT_GE(ContactsIn("u_channel.obj",
                       [](const grasp::Contact& c) {
                         return std::abs(c.n.z()) < 0.5 && c.p.y() > 0.019 &&
                                std::abs(c.p.x() - 0.05) < 0.031;
                       }),
            2);
}

}  // namespace models_test
}  // namespace regrasp::object
