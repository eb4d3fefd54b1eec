#include "sim/actuation/hand_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/scene_model.h"

namespace regrasp::sim {
namespace {

/// Allocate memory for `contacts` contacts and the largest number of constraint rows. Rows are
/// those of contacts, range limits, joint friction and couplings. The memory is cleared whenever a
/// state is placed.
void SetRoom(int contacts, const HandPhysics& physics, mjModel& model) {
  const int tangents = physics.torsion_m > 0 ? 3 : 2;
  const int rows_of_contact = physics.pyramidal_cones ? 2 * tangents : 1 + tangents;
  constexpr int kRowsOfWeld = 6;  // largest number of rows of a coupling
  model.nconmax = contacts;
  model.njmax = rows_of_contact * contacts + kRowsOfWeld * model.neq +
                2 * (model.njnt + model.ntendon) + model.nv + model.ntendon;
}

/// Compiled scenes that were used last. To compile a hand with large meshes takes seconds, and many
/// replays differ only in later settings.
class CompiledScenes {
 public:
  /// Return a copy of the compiled scene of a hand and an object.
  static kinematics::ModelPtr Get(const kinematics::HandFile& file,
                                  const kinematics::ModelText& scene) {
    std::string text = kinematics::FormatXml(scene.root);
    static CompiledScenes scenes;
    const std::scoped_lock lock(scenes.mutex_);
    std::deque<Entry>& known = scenes.entries_;
    auto found = std::ranges::find_if(known, [&](const Entry& entry) {
      return entry.hand == file.compiled && entry.text == text;
    });
    if (found == known.end()) {
      kinematics::ModelPtr model =
          kinematics::CompileText(file.compiled->text.files.front(), scene);
      known.push_front({file.compiled, std::move(text), std::move(model)});
      if (known.size() > kMostKnown) known.pop_back();
      found = known.begin();
    }
    kinematics::ModelPtr copy(mj_copyModel(nullptr, found->model.get()));
    if (!copy) throw EnvironmentError("MuJoCo: not enough memory for the hand");
    return copy;
  }

 private:
  static constexpr std::size_t kMostKnown = 4;
  struct Entry {
    std::shared_ptr<const kinematics::CompiledModel> hand;
    std::string text;
    kinematics::ModelPtr model;
  };
  std::mutex mutex_;
  std::deque<Entry> entries_;
};

}  // namespace

HandScene::HandScene(const kinematics::HandFile& file, const object::Polyhedron& solid,
                     double scale, const HandWorldOptions& given)
    : hand(file.hand), links(file.hand), surface(file, given.tip, solid, scale), options(given) {
  model = CompiledScenes::Get(file, HandSceneText(file, solid, scale, options.mass_kg));
  SetRoom(surface.most_contacts(), options.physics, *model);
  data.reset(mj_makeData(model.get()));
  if (!data) throw EnvironmentError("MuJoCo: not enough memory for the hand");
  centroid = scale * solid.mass_properties().centroid;
  FindParts(file);
  CheckObjectMass(file);
  FindFrozen();
  FreezeJoints(frozen, *model);
  FindServos();
  SetTruePhysics();
  UpdateConstants(*model, *data);
  SetReplayOptions(-options.gravity_m_s2 * (palm.linear() * hand.up), options.physics, frozen,
                   *model);
  couplings.emplace(*model);
  // Contacts of links are violations that ExecutionMonitor finds, not forces. The engine checks
  // only named pairs, and there are none.
  model->opt.collision = mjCOL_PAIR;
  model->npair = 0;
  std::fill_n(model->geom_contype, model->ngeom, 0);
  std::fill_n(model->geom_conaffinity, model->ngeom, 0);
}

int HandScene::Id(int kind, const std::string& name) const {
  const int id = mj_name2id(model.get(), kind, name.c_str());
  if (id < 0) throw InputError("hand model: \"" + name + "\" not found");
  return id;
}

void HandScene::FindParts(const kinematics::HandFile& file) {
  object_body = Id(mjOBJ_BODY, kHandSceneObject);
  object_geom = model->body_geomadr[object_body];
  object_qpos = model->jnt_qposadr[model->body_jntadr[object_body]];
  mj_forward(model.get(), data.get());
  palm = kinematics::PoseAt(data->xpos, data->xmat, Id(mjOBJ_BODY, file.description.palm));
  for (const kinematics::Finger& finger : hand.fingers) {
    Finger& state = fingers.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) {
      state.joints.push_back(Id(mjOBJ_JOINT, joint.name));
    }
    state.tip_body = Id(mjOBJ_BODY, finger.tip.body);
    if (model->body_geomnum[state.tip_body] == 0) {
      throw InputError(file.description.model + ": body " + finger.tip.body + ": geom not found");
    }
    state.tip_geom = model->body_geomadr[state.tip_body];
  }
}

/// Check that the hand's model does not change the mass of the object.
void HandScene::CheckObjectMass(const kinematics::HandFile& file) const {
  constexpr double kTolerance = 1e-9;
  const double mass = model->body_mass[object_body];
  if (std::abs(mass - options.mass_kg) <= kTolerance * options.mass_kg) return;
  throw InputError(file.description.model +
                   ": the model's compiler settings change the mass of the object, expected " +
                   FormatShort(options.mass_kg) + " kg, found " + FormatShort(mass) + " kg");
}

/// Return whether a joint is revolute or prismatic.
bool HandScene::IsScalar(int joint) const {
  return model->jnt_type[joint] == mjJNT_HINGE || model->jnt_type[joint] == mjJNT_SLIDE;
}

/// Find the joints of no finger.
void HandScene::FindFrozen() {
  for (int joint = 0; joint < model->njnt; ++joint) {
    const bool of_finger = std::ranges::any_of(fingers, [&](const Finger& finger) {
      return std::ranges::find(finger.joints, joint) != finger.joints.end();
    });
    if (of_finger || model->jnt_bodyid[joint] == object_body) continue;
    if (IsScalar(joint)) frozen.push_back(joint);
  }
}

/// Find the actuator and the servo of each independent joint.
void HandScene::FindServos() {
  mj_forward(model.get(), data.get());
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const kinematics::Finger& finger = hand.fingers[i];
    for (int drive = 0; drive < finger.drives; ++drive) {
      fingers[i].drives.push_back(
          FindServo(finger, fingers[i].joints, drive, options.force_factor, *data, *model));
    }
  }
}

/// Set gains and joint friction that the controller does not know.
void HandScene::SetTruePhysics() {
  const HandPhysics& physics = options.physics;
  for (Finger& finger : fingers) {
    for (const DriveActuator& drive : finger.drives) {
      const int a = drive.actuator;
      model->actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a] *= physics.gain_factor;
      mjtNum* bias = model->actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
      for (int i = 0; i < 3; ++i) bias[i] *= physics.gain_factor;
    }
    for (const int joint : finger.joints) {
      model->dof_frictionloss[model->jnt_dofadr[joint]] += physics.joint_friction_Nm;
    }
  }
}

}  // namespace regrasp::sim
