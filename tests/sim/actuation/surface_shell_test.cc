#include "sim/actuation/surface_shell.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "sim/actuation/penetration.h"
#include "tests/sim/actuation/edited_hand.h"
#include "tests/sim/actuation/stock_scene.h"

namespace regrasp::sim {
namespace surface_shell_test {

using Eigen::Vector3d;

/// A model of the project that is a solid.
class Model {
 public:
  explicit Model(const std::string& name)
      : file_(object::ReadObject(ProjectPath("models/" + name))) {}
  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*file_.object);
  }

 private:
  object::ObjectFile file_;
};

/// Return a plate of 0.1 m by 0.1 m by `thickness`.
object::Polyhedron Plate(double thickness) {
  object::PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back(0.1 * (i & 1), 0.1 * (i >> 1 & 1), thickness * (i >> 2));
  }
  soup.facets = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return object::Polyhedron::FromSoup(soup, "plate");
}

TEST(SurfaceShell, ConvexSolidsAreConvexAtEveryEdge) {
  EXPECT_TRUE(IsConvex(Model("cube.obj").solid()));
  EXPECT_TRUE(IsConvex(Model("prism.obj").solid()));
  EXPECT_FALSE(IsConvex(Model("l_block.obj").solid()));
  EXPECT_FALSE(IsConvex(Model("mug500.obj").solid()));
}

/// Return the number of sampled points of a piece outside the solid.
int PointsOutside(const ShellPiece& piece, const Penetration& inside, const Vector3d& centroid) {
  int outside = 0;
  const Vector3d centre = (piece[0] + piece[1] + piece[2] + piece[3]) / 4;
  for (const double share : {0.5, 0.98}) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const Vector3d edge = (piece[i] + piece[j]) / 2;
        outside += !inside.Contains(centroid + centre + share * (edge - centre));
      }
    }
  }
  return outside;
}

TEST(SurfaceShell, PiecesAreInsideAndHaveTheWholeSurface) {
  for (const char* name : {"cube.obj", "l_block.obj", "mug500.obj", "duck500.obj"}) {
    SCOPED_TRACE(name);
    const Model model(name);
    const double scale = 0.075 / model.solid().diameter();
    const Penetration inside(model.solid(), scale);
    const Vector3d centroid = scale * model.solid().mass_properties().centroid;
    std::vector<ShellPiece> pieces = SurfaceShell(model.solid(), scale);
    double area = 0;
    for (const ShellPiece& piece : pieces) {
      EXPECT_EQ(PointsOutside(piece, inside, centroid), 0);
      area += (piece[1] - piece[0]).cross(piece[2] - piece[0]).norm() / 2;
    }
    double expected = 0;
    for (FaceIndex face(0); face < model.solid().face_count(); ++face) {
      expected += scale * scale * model.solid().face_measure(face);
    }
    EXPECT_NEAR(area, expected, 1e-3 * expected);
    // Negative control: pieces that point outward are outside.
    for (ShellPiece& piece : pieces) {
      piece[3] = 2 * (piece[0] + piece[1] + piece[2]) / 3 - piece[3];
      EXPECT_GT(PointsOutside(piece, inside, centroid), 0);
    }
  }
}

TEST(SurfaceShell, PiecesOfAPlateAreThinnerThanThePlate) {
  const object::Polyhedron plate = Plate(0.001);
  for (const ShellPiece& piece : SurfaceShell(plate, 1)) {
    const Vector3d normal = (piece[1] - piece[0]).cross(piece[2] - piece[0]).normalized();
    const double depth = -normal.dot(piece[3] - piece[0]);
    EXPECT_LE(depth, normal.z() != 0 ? 0.001 : kShellDepth);
    EXPECT_GE(depth, 0.0003);
  }
}

class ShellInSceneTest : public EditedHandTest {};

/// A fingertip in the notch of the L-block touches its hull and not the object.
TEST_F(ShellInSceneTest, FingertipsCollideWithTheObjectAndNotWithItsHull) {
  const Model block("l_block.obj");
  const kinematics::HandFile hand = HandWith({});
  const mujoco::ModelPtr model = LoadStockScene(
      ExportHandScene(hand, block.solid(), 1, {.mu = kMu, .mass_kg = kMass}, {}), folder_);
  const mujoco::DataPtr data(mj_makeData(model.get()));
  const int tip = mj_name2id(model.get(), mjOBJ_GEOM, "regrasp_tip_0");
  const int object = mj_name2id(model.get(), mjOBJ_BODY, "regrasp_object");
  ASSERT_GE(tip, 0);
  const auto contacts_at = [&](const Vector3d& point) {
    mj_resetData(model.get(), data.get());
    mj_forward(model.get(), data.get());
    mjtNum* pose = data->qpos + model->jnt_qposadr[model->body_jntadr[object]];
    const Vector3d at =
        Vector3d(data->geom_xpos + 3 * tip) - point + block.solid().mass_properties().centroid;
    std::copy_n(at.data(), 3, pose);
    mj_forward(model.get(), data.get());
    return std::count_if(data->contact, data->contact + data->ncon, [&](const mjContact& contact) {
      return contact.geom1 == tip || contact.geom2 == tip;
    });
  };
  const double radius = model->geom_size[3 * tip];
  const double off = 0.04 + radius;
  EXPECT_EQ(contacts_at({off + 0.001, off + 0.001, 0}), 0);
  EXPECT_GT(contacts_at({off + 0.005, off - 1e-4, 0}), 0);
  EXPECT_GT(contacts_at({0.02, -radius + 1e-4, 0}), 0);
  EXPECT_EQ(contacts_at({0.02, -radius - 1e-3, 0}), 0);
}

}  // namespace surface_shell_test
}  // namespace regrasp::sim
