#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "planner/base/error.h"
#include "planner/kinematics/mujoco_model.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::kinematics {
namespace convert_model_test {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class ConvertModelTest : public FolderTest {
 protected:
  CompiledModel Compile(const std::string& text) const {
    return CompileModel(Write("model.xml", text));
  }
  std::string Refusal(const std::string& text) const {
    try {
      (void)Compile(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  }
};

/// Return a model of one revolute joint with inertia 0.04 kg m² and one actuator, with extra
/// elements.
std::string Revolute(const std::string& settings, const std::string& joint,
                     const std::string& actuator) {
  return "<mujoco>" + settings + R"(<worldbody><body name="b"><inertial pos="0 0 0" mass="1"
    diaginertia="0.04 0.04 0.04"/><joint name="j" axis="0 0 1" )" +
         joint + R"(/><geom type="sphere" size="0.1"/></body></worldbody><actuator>)" + actuator +
         "</actuator></mujoco>";
}

std::vector<std::string> Attributes(const ModelText& text) {
  std::vector<std::string> attributes;
  for (const Conversion& conversion : text.conversions) {
    attributes.push_back(conversion.element + " " + conversion.attribute);
  }
  return attributes;
}

double Bias(const CompiledModel& compiled, int i) { return compiled.model->actuator_biasprm[i]; }

TEST_F(ConvertModelTest, AModelOfThisVersionIsLeftAsItIs) {
  const CompiledModel compiled =
      Compile(Revolute("", R"(range="-30 60" limited="true")", R"(<position joint="j" kp="2"/>)"));
  EXPECT_THAT(compiled.text.conversions, IsEmpty());
  EXPECT_EQ(Bias(compiled, 1), -2);
}

TEST_F(ConvertModelTest, PositionGainsOfAClassBecomeAGeneralActuator) {
  const std::string defaults =
      R"(<default><position kp="3" kv="0.5"/><default class="soft"><position kp="2"/></default>
         </default>)";
  const CompiledModel compiled =
      Compile(Revolute(defaults, "", R"(<position name="a" joint="j" class="soft"/>)"));
  EXPECT_EQ(compiled.model->actuator_gainprm[0], 2);
  EXPECT_EQ(Bias(compiled, 1), -2);
  EXPECT_EQ(Bias(compiled, 2), -0.5);
  EXPECT_THAT(Attributes(compiled.text), Contains("position kv"));
}

/// Independent calculation: the critical damping of a mass m on a spring k is 2 √(k m).
TEST_F(ConvertModelTest, ADampingRatioIsThatOfTheInertiaThatTheActuatorMoves) {
  const CompiledModel compiled = Compile(
      Revolute("", R"(armature="0.05")", R"(<position joint="j" kp="4" dampratio="0.5"/>)"));
  EXPECT_NEAR(Bias(compiled, 2), -0.5 * 2 * std::sqrt(4 * 0.09), 1e-9);
  const CompiledModel geared = Compile(Revolute(
      "", R"(armature="0.05")", R"(<position joint="j" kp="4" gear="3" dampratio="0.5"/>)"));
  EXPECT_NEAR(Bias(geared, 2), -0.5 * 2 * std::sqrt(4 * 0.09 / 9), 1e-9);
}

TEST_F(ConvertModelTest, InheritedRangesAreRadians) {
  const CompiledModel compiled =
      Compile(Revolute("", R"(range="-30 60")", R"(<position joint="j" inheritrange="1"/>)"));
  EXPECT_NEAR(compiled.model->actuator_ctrlrange[0], compiled.model->jnt_range[0], 1e-12);
  EXPECT_NEAR(compiled.model->actuator_ctrlrange[1], compiled.model->jnt_range[1], 1e-12);
  EXPECT_NEAR(compiled.model->jnt_range[1], std::numbers::pi / 3, 1e-12);
  EXPECT_EQ(compiled.model->actuator_ctrllimited[0], 1);
  EXPECT_EQ(compiled.model->jnt_limited[0], 1);
  EXPECT_THAT(Attributes(compiled.text), Contains("compiler autolimits"));
}

TEST_F(ConvertModelTest, ForcesOfAJointLimitItsActuatorByTheGear) {
  const CompiledModel compiled = Compile(
      Revolute("", R"(actuatorfrcrange="-1 2")", R"(<motor joint="j" gear="-2" name="a"/>)"));
  EXPECT_EQ(compiled.model->actuator_forcerange[0], -1);
  EXPECT_EQ(compiled.model->actuator_forcerange[1], 0.5);
  EXPECT_THAT(Attributes(compiled.text), Contains("joint actuatorfrcrange"));
}

TEST_F(ConvertModelTest, SettingsAreRenamedOrLeftOutAndListed) {
  const CompiledModel compiled =
      Compile(Revolute(R"(<option integrator="implicitfast" ccd_iterations="70" ls_iterations="9">
               <flag eulerdamp="disable"/></option>)",
                       "", R"(<motor joint="j"/>)"));
  EXPECT_EQ(compiled.model->opt.integrator, mjINT_IMPLICIT);
  EXPECT_EQ(compiled.model->opt.mpr_iterations, 70);
  EXPECT_THAT(Attributes(compiled.text),
              testing::UnorderedElementsAre("option integrator", "option ccd_iterations",
                                            "option ls_iterations", "flag eulerdamp"));
  EXPECT_EQ(compiled.text.conversions[0].line, 1);
}

TEST_F(ConvertModelTest, FramesPlaceWhatIsInThem) {
  const CompiledModel compiled = Compile(R"(<mujoco><worldbody>
      <frame name="f" pos="1 0 0" euler="0 0 90"><body name="b" pos="1 0 0"><geom size="0.1"/></body></frame>
      </worldbody></mujoco>)");
  const DataPtr data = AtRest(*compiled.model);
  const int body = mj_name2id(compiled.model.get(), mjOBJ_BODY, "b");
  ASSERT_GT(body, 0);
  EXPECT_NEAR(data->xpos[3 * body], 1, 1e-12);
  EXPECT_NEAR(data->xpos[3 * body + 1], 1, 1e-12);
}

TEST_F(ConvertModelTest, ActuatorsThatAreLeftOutTakeTheirControlsOfKeyframesAlong) {
  const CompiledModel compiled = Compile(
      R"(<mujoco><extension><plugin plugin="p"/></extension><worldbody><body><joint name="j"/>
         <geom size="0.1"/></body></worldbody><actuator><plugin plugin="p" joint="j"/></actuator>
         <keyframe><key name="k" qpos="0.5" ctrl="1"/></keyframe></mujoco>)");
  EXPECT_EQ(compiled.model->nu, 0);
  EXPECT_EQ(compiled.model->key_qpos[0], 0.5);
  EXPECT_THAT(Attributes(compiled.text),
              testing::UnorderedElementsAre("extension ", "plugin ", "key ctrl"));
}

TEST_F(ConvertModelTest, WhatIsPartOfTheHandIsRefusedInOneLine) {
  const std::string refusal = Refusal(
      R"(<mujoco><worldbody>
         <replicate count="3"><geom size="0.1"/></replicate></worldbody></mujoco>)");
  EXPECT_THAT(refusal, HasSubstr("model.xml: line 2: <replicate> is not supported by MuJoCo"));
  EXPECT_THAT(refusal, testing::Not(HasSubstr("\n")));
  EXPECT_THAT(
      Refusal(R"(<mujoco><worldbody><body><geom size="1"/><site name="a"/></body></worldbody>
                         <equality><weld site1="a" site2="b"/></equality></mujoco>)"),
      HasSubstr("line 2: <weld> between sites is not supported by MuJoCo"));
  EXPECT_THAT(Refusal("<mujoco><worldbody>"), HasSubstr("line 1: "));
  EXPECT_THAT(Refusal("<sdf/>"), HasSubstr("expected a model as MJCF"));
  EXPECT_THAT(Refusal("<mujoco><include/></mujoco>"),
              HasSubstr("<include>: requires the attribute file"));
  EXPECT_THAT(Refusal("<mujoco><include file=\"model.xml\"/></mujoco>"),
              HasSubstr("must be included once, found twice or recursively"));
  EXPECT_THAT(Refusal("<mujoco><worldbody><body><joint type=\"odd\"/></body></worldbody></mujoco>"),
              HasSubstr("rejected by MuJoCo"));
}

TEST_F(ConvertModelTest, IncludedFilesStandInTheirPlaces) {
  Write("parts/gains.xml",
        R"(<mujocoinclude><default><position kp="3" kv="0.5"/></default></mujocoinclude>)");
  const CompiledModel compiled =
      Compile(Revolute(R"(<include file="parts/gains.xml"/>)", "", R"(<position joint="j"/>)"));
  EXPECT_EQ(Bias(compiled, 2), -0.5);
  ASSERT_EQ(compiled.text.files.size(), 2U);
  EXPECT_EQ(compiled.text.files[1], folder_ / "parts/gains.xml");
}

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
constexpr char kPyramid[] =
    "v 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\nv 0 0 2\n"
    "f 1 3 2\nf 1 4 3\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

TEST_F(ConvertModelTest, MeshesOfOneNameInTwoFoldersAreTwo) {
  Write("looks/part.obj", kTetrahedron);
  Write("shapes/part.obj", kPyramid);
  const CompiledModel compiled = Compile(
      R"(<robot name="r"><link name="a">
         <visual><geometry><mesh filename="package://hand/looks/part.obj"/></geometry></visual>
         <visual><geometry><mesh filename="looks/part.glb"/></geometry></visual>
         <collision><geometry><mesh filename="shapes/part.obj"/></geometry></collision>
         </link></robot>)");
  const mjModel& model = *compiled.model;
  ASSERT_EQ(model.ngeom, 2);
  EXPECT_EQ(model.nbody, 2) << "links that are fixed stay bodies";
  for (int geom = 0; geom < 2; ++geom) {
    const int mesh = model.geom_dataid[geom];
    EXPECT_EQ(model.mesh_facenum[mesh], model.geom_contype[geom] == 0 ? 4 : 6);
  }
  EXPECT_EQ(compiled.text.meshes.size(), 2U);
  EXPECT_THAT(Attributes(compiled.text), Contains("mesh filename"));
}

/// MuJoCo alone reads the first object of an OBJ file.
TEST_F(ConvertModelTest, AllObjectsOfAMeshAreRead) {
  const std::string second =
      "v 5 5 0\nv 4 5 0\nv 5 4 0\nv 5 5 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";
  Write("two.obj", "o first\n" + std::string(kTetrahedron) + "o second\n" + second);
  Write("groups.obj", "g first\n" + std::string(kTetrahedron) + "g second\n" + second);
  Write("joined.obj", kTetrahedron + second);
  Write("one.obj", "o first\n" + std::string(kTetrahedron));
  const auto faces = [&](const std::string& file, bool urdf) {
    const CompiledModel compiled = Compile(
        urdf ? R"(<robot name="r"><link name="a"><collision><geometry><mesh filename=")" + file +
                   R"("/></geometry></collision></link></robot>)"
             : R"(<mujoco><asset><mesh name="m" file=")" + file +
                   R"("/></asset><worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>)");
    return compiled.model->mesh_facenum[0];
  };
  for (const bool urdf : {true, false}) {
    EXPECT_EQ(faces("joined.obj", urdf), 8);
    EXPECT_EQ(faces("two.obj", urdf), 8);
    EXPECT_EQ(faces("groups.obj", urdf), 8);
    EXPECT_EQ(faces("one.obj", urdf), 4);
  }
}

TEST_F(ConvertModelTest, LooksThatMujocoDoesNotTakeAreLeftOut) {
  // One triangle has the wrong orientation.
  Write("look.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const CompiledModel compiled = Compile(
      R"(<robot name="r"><link name="a">
         <visual><geometry><mesh filename="look.obj"/></geometry></visual>
         <collision><geometry><sphere radius="1"/></geometry></collision></link></robot>)");
  EXPECT_EQ(compiled.model->ngeom, 1);
  EXPECT_THAT(Attributes(compiled.text), Contains("visual "));
}

TEST_F(ConvertModelTest, MimicsAreTaken) {
  const CompiledModel compiled = Compile(
      R"(<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>
         <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
         <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
         <limit lower="0" upper="1"/><mimic joint="i" multiplier="1.5" offset="0.1"/></joint>
         </robot>)");
  ASSERT_EQ(compiled.text.mimics.size(), 1U);
  EXPECT_EQ(compiled.text.mimics[0].follows, "i");
  EXPECT_EQ(compiled.text.mimics[0].multiplier, 1.5);
}

/// Return a URDF model of two links and a joint with the given elements.
std::string JointUrdf(const std::string& inside) {
  return "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"><inertial><mass "
         "value=\"1\"/><inertia "
         "ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n<joint "
         "name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 "
         "1\"/>\n" +
         inside + "</joint></robot>";
}

TEST_F(ConvertModelTest, NumbersOfJointsMayHaveASignAndSpaces) {
  const CompiledModel compiled = Compile(JointUrdf(R"(<limit lower="0" upper="1" effort=" 1.5 "/>
                   <mimic joint=" i" multiplier=" +1.1169 " offset=" -0.15"/>)"));
  ASSERT_EQ(compiled.text.mimics.size(), 1U);
  EXPECT_EQ(compiled.text.mimics[0].follows, "i");
  EXPECT_EQ(compiled.text.mimics[0].multiplier, 1.1169);
  EXPECT_EQ(compiled.text.mimics[0].offset, -0.15);
  EXPECT_EQ(compiled.text.efforts.at("j"), 1.5);
}

TEST_F(ConvertModelTest, WhatIsNoNumberOfAJointIsRefused) {
  for (const std::string wrong : {"", "1,1169", "abc", "nan", "1 2", "0x1"}) {
    for (const std::string attribute : {"multiplier", "offset"}) {
      EXPECT_THAT(Refusal(JointUrdf("<limit lower=\"0\" upper=\"1\"/><mimic joint=\"i\" " +
                                    attribute + "=\"" + wrong + "\"/>")),
                  HasSubstr("line 3: <mimic> of joint j: " + attribute +
                            ": expected a number, found \"" + wrong + "\""));
    }
    EXPECT_THAT(Refusal(JointUrdf("<limit lower=\"0\" upper=\"1\" effort=\"" + wrong + "\"/>")),
                HasSubstr("line 3: <limit> of joint j: effort: expected a number"));
  }
  EXPECT_THAT(Refusal(JointUrdf(R"(<limit lower="0" upper="1" effort="-1"/>)")),
              HasSubstr("expected a number of at least 0, found -1"));
  EXPECT_THAT(Refusal(JointUrdf(R"(<limit lower="0" upper="1"/><mimic multiplier="2"/>)")),
              HasSubstr("<mimic> of joint j: expected the attribute joint"));
}

/// MuJoCo converts a URDF once, when it compiles it; each replay uses this conversion.
TEST_F(ConvertModelTest, AUrdfIsConvertedToMjcfOnce) {
  const CompiledModel compiled = Compile(JointUrdf(R"(<limit lower="0" upper="1"/>)"));
  const ModelText text = MjcfOf(compiled);
  EXPECT_EQ(text.root.name, "mujoco");
  EXPECT_EQ(FormatXml(text.root),
            FormatXml(AsMjcf(compiled.text.files.front(), compiled.text).root));
  EXPECT_EQ(CompileText("model.xml", text)->njnt, 1);
  const CompiledModel mjcf = Compile(Revolute("", "", R"(<motor joint="j"/>)"));
  EXPECT_EQ(FormatXml(MjcfOf(mjcf).root), FormatXml(mjcf.text.root));
}

TEST_F(ConvertModelTest, AnEffortOfZeroOrNoneIsUnknown) {
  for (const char* effort : {"", "effort=\"0\"", "effort=\" 0.0\""}) {
    const CompiledModel compiled =
        Compile(JointUrdf("<limit lower=\"0\" upper=\"1\" " + std::string(effort) + "/>"));
    EXPECT_THAT(compiled.text.efforts, IsEmpty()) << effort;
  }
}

TEST_F(ConvertModelTest, XacroThatIsNotExpandedIsRefused) {
  const std::string declared = R"(<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">)";
  const std::string other = R"(<robot name="r" xmlns:x="http://wiki.ros.org/xacro">)";
  const std::string link = "<link name=\"a\"/></robot>";
  EXPECT_THAT(Refusal(declared + "\n<xacro:property name=\"l\" value=\"1\"/>" + link),
              HasSubstr("model.xml: line 2: <xacro:property>: xacro is not expanded"));
  EXPECT_THAT(Refusal(other + "<link name=\"b\"/><x:finger/>" + link), HasSubstr("<x:finger>"));
  EXPECT_THAT(Refusal(JointUrdf(R"(<limit lower="0" upper="${pi/2}"/>)")),
              HasSubstr("<limit> upper=\"${pi/2}\": xacro is not expanded"));
  EXPECT_THAT(Refusal("<robot name=\"$(arg name)\">" + link), HasSubstr("xacro is not expanded"));
  EXPECT_EQ(Compile(declared + link).model->nbody, 2) << "the declaration alone is harmless";
}

TEST_F(ConvertModelTest, LooksThatAreMissingOrEmptyAreLeftOut) {
  Write("empty.obj", "");
  for (const std::string mesh :
       {"nowhere.stl", "empty.obj", "package://no/nowhere.obj", "package://"}) {
    const std::string geometry = "<geometry><mesh filename=\"" + mesh + "\"/></geometry>";
    const CompiledModel compiled =
        Compile("<robot name=\"r\"><link name=\"a\"><visual>" + geometry +
                "</visual><collision><geometry><sphere "
                "radius=\"1\"/></geometry></collision></link></robot>");
    EXPECT_EQ(compiled.model->ngeom, 1);
    EXPECT_THAT(Attributes(compiled.text), Contains("mesh filename"));
    EXPECT_THAT(compiled.text.meshes, IsEmpty());
    EXPECT_THAT(Refusal("<robot name=\"r\"><link name=\"a\"><collision>" + geometry +
                        "</collision></link></robot>"),
                HasSubstr("model.xml: line 1: mesh " + mesh));
  }
}

TEST_F(ConvertModelTest, LooksOfMjcfThatAreMissingOrEmptyAreLeftOut) {
  Write("parts/empty.obj", "");
  const auto model = [](const std::string& geom, const std::string& inertial) {
    return R"(<mujoco><compiler meshdir="parts"/><default><default class="look"><geom type="mesh"
        contype="0" conaffinity="0" density="0"/></default></default><asset><mesh name="n"
        file="nowhere.stl"/><mesh file="empty.obj"/></asset><worldbody><body childclass="look">)" +
           inertial + "<geom class=\"main\" type=\"sphere\" size=\"1\"/><geom type=\"mesh\" " +
           geom + "/></body></worldbody></mujoco>";
  };
  const std::string inertial = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)";
  for (const std::string mesh : {"mesh=\"n\"", "mesh=\"empty\""}) {
    const CompiledModel compiled = Compile(model(mesh, ""));
    EXPECT_EQ(compiled.model->ngeom, 1);
    EXPECT_EQ(compiled.model->nmesh, 0);
    EXPECT_THAT(Attributes(compiled.text), Contains("geom mesh"));
    EXPECT_THAT(Refusal(model(mesh + " contype=\"1\"", "")), HasSubstr("mesh " + mesh.substr(6, 1)))
        << "it collides";
    EXPECT_THAT(Refusal(model(mesh + " density=\"1000\"", "")), HasSubstr("model.xml: line "))
        << "it has a mass";
    EXPECT_EQ(Compile(model(mesh + " density=\"1000\"", inertial)).model->ngeom, 1);
  }
}

TEST_F(ConvertModelTest, PackagesAreFoundFromTheCurrentFolder) {
  Write("hand/part.obj", kTetrahedron);
  Write("hand/urdf/model.urdf",
        R"(<robot name="r"><link name="a"><collision><geometry>
           <mesh filename="package://hand/part.obj"/></geometry></collision></link></robot>)");
  const fs::path before = fs::current_path();
  fs::current_path(folder_ / "hand/urdf");
  int geoms = 0;
  EXPECT_NO_THROW(geoms = CompileModel("model.urdf").model->ngeom);
  fs::current_path(before);
  EXPECT_EQ(geoms, 1);
}

TEST(MujocoSchemaTest, KnowsWhatMayStandWhere) {
  const SchemaElement& schema = MujocoSchema();
  const SchemaElement* body = schema.Child("mujoco", "worldbody");
  ASSERT_NE(body, nullptr);
  EXPECT_EQ(body->Child("worldbody", "body"), body);
  EXPECT_EQ(body->Child("body", "worldbody"), body) << "one node stands for both";
  ASSERT_NE(body->Child("body", "joint"), nullptr);
  EXPECT_TRUE(body->Child("body", "joint")->attributes.contains("frictionloss"));
  EXPECT_FALSE(body->Child("body", "joint")->attributes.contains("kp"));
  EXPECT_EQ(body->Child("body", "actuator"), nullptr);
  EXPECT_GT(schema.Child("mujoco", "actuator")->children.size(), 5U);
}

}  // namespace convert_model_test
}  // namespace regrasp::kinematics
