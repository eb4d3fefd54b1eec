#include "sim/actuation/model_numbers.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <functional>

#include "planner/base/number.h"

namespace regrasp::sim {
namespace {

using kinematics::XmlElement;

/// Return the text of `count` numbers of the row `index` of an array.
std::string RowText(const mjtNum* values, int index, int count) {
  return NumbersText(values + std::ptrdiff_t{count} * index, count);
}

void WriteJoint(const mjModel& model, int joint, XmlElement& element) {
  const int type = model.jnt_type[joint];
  const int dof = model.jnt_dofadr[joint];
  if (type == mjJNT_FREE) return;
  element.Set("pos", RowText(model.jnt_pos, joint, 3));
  element.Set("armature", FormatDouble(model.dof_armature[dof]));
  element.Set("damping", FormatDouble(model.dof_damping[dof]));
  element.Set("frictionloss", FormatDouble(model.dof_frictionloss[dof]));
  element.Set("stiffness", FormatDouble(model.jnt_stiffness[joint]));
  element.Set("margin", FormatDouble(model.jnt_margin[joint]));
  element.Set("solreflimit", RowText(model.jnt_solref, joint, mjNREF));
  element.Set("solimplimit", RowText(model.jnt_solimp, joint, mjNIMP));
  element.Set("solreffriction", RowText(model.dof_solref, dof, mjNREF));
  element.Set("solimpfriction", RowText(model.dof_solimp, dof, mjNIMP));
  if (type == mjJNT_BALL) return;
  element.Set("axis", RowText(model.jnt_axis, joint, 3));
  element.Set("ref", FormatDouble(model.qpos0[model.jnt_qposadr[joint]]));
  element.Set("springref", FormatDouble(model.qpos_spring[model.jnt_qposadr[joint]]));
  element.Set("limited", model.jnt_limited[joint] != 0 ? "true" : "false");
  element.Set("range", RowText(model.jnt_range, joint, 2));
}

/// Write the numbers of a primitive geom. A mesh is skipped, since its frame differs from its
/// geom's.
void WriteGeom(const mjModel& model, int geom, XmlElement& element) {
  if (model.geom_type[geom] == mjGEOM_MESH || element.Find("mesh") != nullptr) return;
  element.Set("pos", RowText(model.geom_pos, geom, 3));
  element.Set("quat", RowText(model.geom_quat, geom, 4));
  element.Set("size", RowText(model.geom_size, geom, 3));
}

void WriteBody(const mjModel& model, int body, XmlElement& element) {
  int joint = model.body_jntadr[body];
  int geom = model.body_geomadr[body];
  if (body > 0) {
    element.Set("pos", RowText(model.body_pos, body, 3));
    element.Set("quat", RowText(model.body_quat, body, 4));
  }
  for (XmlElement& part : element.children) {
    if (part.name == "inertial") {
      part.attributes = {{"pos", RowText(model.body_ipos, body, 3)},
                         {"quat", RowText(model.body_iquat, body, 4)},
                         {"mass", FormatDouble(model.body_mass[body])},
                         {"diaginertia", RowText(model.body_inertia, body, 3)}};
    } else if (part.name == "joint" || part.name == "freejoint") {
      WriteJoint(model, joint++, part);
    } else if (part.name == "geom") {
      WriteGeom(model, geom++, part);
    }
  }
}

/// Write the numbers of bodies, which are numbered depth first.
void WriteBodies(const mjModel& model, XmlElement& parent, int& last) {
  WriteBody(model, last, parent);
  for (XmlElement& child : parent.children) {
    if (child.name != "body") continue;
    ++last;
    WriteBodies(model, child, last);
  }
}

void WriteEquality(const mjModel& model, int equality, XmlElement& element) {
  element.Set("solref", RowText(model.eq_solref, equality, mjNREF));
  element.Set("solimp", RowText(model.eq_solimp, equality, mjNIMP));
  const int type = model.eq_type[equality];
  if (type != mjEQ_JOINT && type != mjEQ_TENDON) return;
  element.Set("polycoef", NumbersText(model.eq_data + std::ptrdiff_t{mjNEQDATA} * equality, 5));
}

void WriteTendon(const mjModel& model, int tendon, XmlElement& element) {
  element.Set("stiffness", FormatDouble(model.tendon_stiffness[tendon]));
  element.Set("damping", FormatDouble(model.tendon_damping[tendon]));
  element.Set("frictionloss", FormatDouble(model.tendon_frictionloss[tendon]));
  element.Set("limited", model.tendon_limited[tendon] != 0 ? "true" : "false");
  element.Set("range", RowText(model.tendon_range, tendon, 2));
  int wrap = model.tendon_adr[tendon];
  for (XmlElement& part : element.children) {
    if (part.name == "joint") part.Set("coef", FormatDouble(model.wrap_prm[wrap]));
    ++wrap;
  }
}

void WriteActuator(const mjModel& model, int a, XmlElement& element) {
  element.Set("gear", RowText(model.actuator_gear, a, 6));
  if (model.actuator_gaintype[a] == mjGAIN_FIXED) element.Set("gaintype", "fixed");
  element.Set("gainprm", RowText(model.actuator_gainprm, a, mjNGAIN));
  element.Set("biasprm", RowText(model.actuator_biasprm, a, mjNBIAS));
  if (model.actuator_biastype[a] == mjBIAS_AFFINE) element.Set("biastype", "affine");
  element.Set("ctrllimited", model.actuator_ctrllimited[a] != 0 ? "true" : "false");
  if (model.actuator_ctrllimited[a] != 0) {
    element.Set("ctrlrange", RowText(model.actuator_ctrlrange, a, 2));
  } else {
    element.Remove("ctrlrange");
  }
  element.Set("forcelimited", model.actuator_forcelimited[a] != 0 ? "true" : "false");
  if (model.actuator_forcelimited[a] != 0) {
    element.Set("forcerange", RowText(model.actuator_forcerange, a, 2));
  }
}

/// Call `write` with the number of each element in all sections of a given name.
void ForSections(XmlElement& root, const std::string& name, int count,
                 const std::function<void(int, XmlElement&)>& write) {
  int index = 0;
  for (XmlElement& section : root.children) {
    if (section.name != name) continue;
    for (XmlElement& element : section.children) {
      if (index < count) write(index++, element);
    }
  }
}

}  // namespace

std::string NumbersText(const double* values, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i > 0 ? " " : "") + FormatDouble(values[i]);
  return text;
}

std::string NumbersText(const std::vector<double>& values) {
  return NumbersText(values.data(), static_cast<int>(values.size()));
}

void WriteModelNumbers(const mjModel& model, XmlElement& root) {
  for (XmlElement& section : root.children) {
    int last = 0;
    if (section.name == "worldbody") WriteBodies(model, section, last);
  }
  const auto with = [&](void (*write)(const mjModel&, int, XmlElement&)) {
    return [&model, write](int index, XmlElement& element) { write(model, index, element); };
  };
  ForSections(root, "equality", model.neq, with(WriteEquality));
  ForSections(root, "tendon", model.ntendon, with(WriteTendon));
  ForSections(root, "actuator", model.nu, with(WriteActuator));
}

}  // namespace regrasp::sim
