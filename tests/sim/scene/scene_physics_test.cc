// Only Coulomb friction at the fingers' point contacts holds the object in the exported scene. The
// test loads the scene like a MuJoCo user, and also loads tampered scenes.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/sim/mujoco_file.h"
#include "tests/sim/planar_cases.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace scene_physics_test {

/// Collects the faults of a scene.
class PhysicsAudit {
 public:
  explicit PhysicsAudit(const mjModel& model)
      : m_(model), object_(mj_name2id(&model, mjOBJ_BODY, "object")) {
    AuditOptions();
    for (int g = 0; g < m_.ngeom; ++g) AuditGeom(g);
    for (int d = 0; d < m_.nv; ++d) AuditFreedom(d);
    for (int j = 0; j < m_.njnt; ++j) AuditJoint(j);
    for (int a = 0; a < m_.nu; ++a) AuditActuator(a);
  }
  [[nodiscard]] const std::set<std::string>& faults() const { return faults_; }

 private:
  void Expect(bool right, const std::string& fault) {
    if (!right) faults_.insert(fault);
  }

  void AuditOptions() {
    Expect(m_.opt.cone == mjCONE_ELLIPTIC, "cones are not elliptic");
    Expect(m_.opt.disableflags == 0 && m_.opt.enableflags == 0,
           "a part of physics is switched off");
    const bool still = m_.opt.density == 0 && m_.opt.viscosity == 0;
    Expect(still, "a fluid holds bodies");
    Expect(m_.neq == 0, "a constraint holds bodies");
    Expect(m_.ntendon == 0, "a tendon holds bodies");
    Expect(m_.npair == 0, "a pair of geoms has physics of its own");
    Expect(m_.nmocap == 0, "a body is moved by hand");
  }

  void AuditGeom(int g) {
    if (m_.geom_contype[g] == 0 && m_.geom_conaffinity[g] == 0) return;
    Expect(m_.geom_condim[g] == 3, "contacts resist torsion");
    Expect(m_.geom_margin[g] == 0 && m_.geom_gap[g] == 0, "contacts act at a distance");
    const int finger = mj_name2id(&m_, mjOBJ_GEOM, "finger0");
    Expect(m_.geom_friction[3 * g] == m_.geom_friction[3 * finger], "a geom has other friction");
    const bool of_object = m_.geom_bodyid[g] == object_;
    // Fingers touch patches of the object, but not each other. Nothing touches the world.
    Expect(of_object ? m_.geom_contype[g] == 0 : m_.geom_conaffinity[g] == 0,
           "something else touches than fingers and patches");
    Expect(m_.geom_bodyid[g] != 0, "something else touches than fingers and patches");
  }

  void AuditFreedom(int d) {
    const bool free = m_.dof_damping[d] == 0 && m_.dof_frictionloss[d] == 0;
    Expect(free, "a joint resists by itself");
    Expect(m_.dof_armature[d] == 0, "a joint has inertia of its own");
  }

  void AuditJoint(int j) {
    Expect(m_.jnt_stiffness[j] == 0, "a joint resists by itself");
    Expect(m_.jnt_limited[j] == 0, "a joint is limited");
  }

  void AuditActuator(int a) {
    if (m_.actuator_trntype[a] != mjTRN_JOINT) {
      faults_.insert("an actuator acts on a body");
      return;
    }
    Expect(m_.jnt_bodyid[m_.actuator_trnid[2 * a]] != object_, "an actuator moves the object");
  }

  const mjModel& m_;
  int object_;
  std::set<std::string> faults_;
};

std::set<std::string> FaultsOf(const std::string& mjcf) {
  const ModelPtr model = LoadFromFile(mjcf);
  if (!model) return {"does not load"};
  return PhysicsAudit(*model).faults();
}

std::string CubeScene() {
  const CubeCase cube;
  return SceneMjcf(cube.object, MakePlan(cube.Start(), 25), {});
}

TEST(ScenePhysics, NothingButFrictionAtPointsHoldsTheObject) {
  EXPECT_EQ(FaultsOf(CubeScene()), std::set<std::string>());
}

TEST(ScenePhysics, NorAPlanarOne) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp grasp = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)};
  const std::string mjcf = SceneMjcf(square, MakePlanarPlan(grasp, 20), {});
  EXPECT_EQ(FaultsOf(mjcf), std::set<std::string>());
}

/// Change of the scene, and the expected finding of the audit.
struct Tampering {
  std::string what, from, to, fault;
};

const std::vector<Tampering> kTamperings = {
    {"pyramids", "cone=\"elliptic\"", "cone=\"pyramidal\"", "cones are not elliptic"},
    {"torsion", "condim=\"3\"", "condim=\"4\"", "contacts resist torsion"},
    {"damping", "<freejoint/>", "<joint type=\"free\" damping=\"0.1\"/>",
     "a joint resists by itself"},
    {"dry friction of a joint", "<freejoint/>", "<joint type=\"free\" frictionloss=\"0.1\"/>",
     "a joint resists by itself"},
    {"inertia of a joint", "<freejoint/>", "<joint type=\"free\" armature=\"0.1\"/>",
     "a joint has inertia of its own"},
    {"damped fingers", "type=\"slide\" damping=\"0\"", "type=\"slide\" damping=\"1\"",
     "a joint resists by itself"},
    {"a weld", "</mujoco>", "<equality><weld body1=\"object\"/></equality></mujoco>",
     "a constraint holds bodies"},
    {"adhesion", "<actuator>", "<actuator><adhesion body=\"object\" ctrlrange=\"0 1\" gain=\"1\"/>",
     "an actuator acts on a body"},
    {"a motor on the object", "<actuator>",
     "<actuator><motor joint=\"free\" gear=\"0 0 1 0 0 0\"/>", "an actuator moves the object"},
    {"a fluid", "<option ", "<option viscosity=\"1\" ", "a fluid holds bodies"},
    {"contacts at a distance", "margin=\"0\"", "margin=\"0.01\"", "contacts act at a distance"},
    {"rough patches", "<geom group=\"3\" ", "<geom group=\"3\" friction=\"2 1e-5 1e-5\" ",
     "a geom has other friction"},
    {"a floor", "<worldbody>",
     "<worldbody><geom type=\"plane\" size=\"1 1 1\" pos=\"0 0 -1\" contype=\"1\"/>",
     "something else touches than fingers and patches"}};

TEST(ScenePhysics, EveryTamperingIsSeenForWhatItIs) {
  std::string scene = CubeScene();
  // The number of stored controls equals the number of actuators.
  const std::string end = "</keyframe>";
  const std::size_t keyframe = scene.find("<keyframe>");
  scene.erase(keyframe, scene.find(end) + end.size() - keyframe);
  for (const Tampering& tampering : kTamperings) {
    SCOPED_TRACE(tampering.what);
    std::string mjcf = scene;
    if (tampering.what == "a motor on the object") {
      const std::string joint = "<freejoint/>";
      mjcf.replace(mjcf.find(joint), joint.size(), "<freejoint name=\"free\"/>");
    }
    const std::size_t at = mjcf.find(tampering.from);
    ASSERT_NE(at, std::string::npos);
    mjcf.replace(at, tampering.from.size(), tampering.to);
    const std::set<std::string> faults = FaultsOf(mjcf);
    EXPECT_TRUE(faults.contains(tampering.fault));
    EXPECT_EQ(faults.size(), 1u);
  }
  EXPECT_GE(kTamperings.size(), 10u);
}

}  // namespace scene_physics_test
}  // namespace regrasp::sim
