#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regrasp::kinematics {

/// Element of an XML file. Text between elements is not kept.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< attributes in file order
  std::vector<XmlElement> children;
  std::string file;  ///< file name in messages
  int line = 0;

  /// Return an attribute; nullptr if there is none. Valid until the attributes change.
  [[nodiscard]] const std::string* Find(std::string_view attribute) const;
  void Set(std::string_view attribute, std::string value);
  void Remove(std::string_view attribute);
  /// Return the first child with a name; nullptr if there is none.
  [[nodiscard]] const XmlElement* Child(std::string_view child) const;
};

/// Return an element that is not from a file.
[[nodiscard]] XmlElement MakeElement(std::string name,
                                     std::vector<std::pair<std::string, std::string>> attributes,
                                     std::vector<XmlElement> children = {});

/// Parse an XML file.
/// @param file  name of the file in messages.
/// @throws InputError  if the text is not XML, or elements are nested deeper than 200 levels.
[[nodiscard]] XmlElement ParseXml(std::string_view text, const std::string& file);

/// Format an element as XML.
/// Law: ParseXml of the text gives the same names, attributes and children.
[[nodiscard]] std::string FormatXml(const XmlElement& root);

/// Conversion of an element or attribute that the linked MuJoCo version does not know.
struct Conversion {
  std::string file;
  int line = 0;
  std::string element;    ///< element name: "position", "joint"
  std::string name;       ///< name of the element, or its class; can be empty
  std::string attribute;  ///< attribute; empty: the whole element
  std::string outcome;    ///< result: "left out: …", "to ctrlrange, from the joint's range"
};

/// URDF joint that follows another joint: angle = multiplier · angle of `follows` + offset.
struct Mimic {
  std::string joint;
  std::string follows;
  double multiplier = 1;
  double offset = 0;
};

/// Actuator with a damping ratio.
/// Its damping is known after compilation, because the critical damping depends on the inertia.
struct DampingRatio {
  int actuator = 0;  ///< index in the order of the model
  double ratio = 1;
};

/// Mesh file that a model names.
struct MeshFile {
  std::filesystem::path path;
  /// Name under which MuJoCo gets the mesh's bytes; empty if it finds the file.
  std::string alias;
};

/// Read a mesh file for MuJoCo, which reads only the first object of an OBJ file.
/// Joins all objects and groups of an OBJ file; other files are unchanged.
/// @throws InputError  if the file cannot be read.
[[nodiscard]] std::string ReadMeshFile(const std::filesystem::path& path);

/// Text of a model, as passed to MuJoCo.
struct ModelText {
  XmlElement root;
  std::vector<std::filesystem::path> files;  ///< files of the model and its includes
  std::vector<Conversion> conversions;
  std::vector<MeshFile> meshes;  ///< distinct meshes in text order
  std::vector<Mimic> mimics;
  /// Largest torque of each joint of a URDF model by name, N m. Joints without an `effort`, or with
  /// `effort` 0, are absent.
  std::map<std::string, double> efforts;
  std::vector<DampingRatio> damping_ratios;
};

/// Read an MJCF or URDF model and convert it to the linked MuJoCo version.
/// The includes of an MJCF model are read, too.
///
/// Elements that affect the hand are converted (ConvertMjcf, ConvertUrdf). Elements that
/// affect neither its motion nor its visuals are removed. All conversions are listed. A model that
/// requires no conversion keeps its text except for the layout.
/// @throws InputError  if the file is not XML, is neither MJCF nor URDF, includes itself, or has an
///     element that cannot be converted (replicate, attach) or unexpanded xacro. The message names
///     the file and line.
[[nodiscard]] ModelText ReadModelText(const std::filesystem::path& path);

/// Default classes of an MJCF model, which define attributes that elements omit.
class MjcfDefaults {
 public:
  /// Name of the root class.
  static constexpr char kMain[] = "main";

  /// @param root  root element; outlives this object and does not move its elements.
  explicit MjcfDefaults(const XmlElement& root);

  /// Return the class of an element: its own, otherwise `otherwise`.
  [[nodiscard]] static std::string ClassOf(const XmlElement& element, const std::string& otherwise);

  /// Return an attribute of an element; nullptr if there is none.
  /// If the element omits it, its class and the ancestors of the class are searched.
  /// @param tags  element names of the classes that can have the attribute.
  [[nodiscard]] const std::string* Find(const XmlElement& element, const std::string& default_class,
                                        const std::vector<const char*>& tags,
                                        const std::string& attribute) const;

 private:
  struct DefaultClass {
    std::string parent;
    std::vector<const XmlElement*> elements;
  };
  void Add(const XmlElement& element, const std::string& parent);

  std::map<std::string, DefaultClass> classes_;
};

/// Return why a file cannot be read as a mesh; empty if it is a file with contents.
[[nodiscard]] std::string WhyMeshIsMissing(const std::filesystem::path& path);

/// Location of the meshes of an MJCF model.
struct MeshPaths {
  std::filesystem::path folder;
  bool strips_path = false;  ///< whether folders in a mesh's file name are ignored

  [[nodiscard]] std::filesystem::path PathOf(const std::string& file) const {
    const std::filesystem::path path(file);
    return folder / (strips_path ? path.filename() : path);
  }
};

/// Remove missing or empty meshes from an MJCF model, together with the geoms that only show them.
/// These geoms neither collide nor have mass. Each removed geom is listed as a conversion.
/// @throws InputError  if a geom with such a mesh collides or has mass. The message names the line
///     and the file.
void DropMissingVisuals(const MeshPaths& paths, ModelText& text);

/// Convert MJCF of a newer MuJoCo version to the linked version, and list its mesh files.
/// Elements and attributes that the linked version's schema (MujocoSchema) lacks are converted:
///
/// | found | becomes |
/// | --- | --- |
/// | integrator implicitfast | implicit |
/// | ccd_iterations, ccd_tolerance | mpr_iterations, mpr_tolerance |
/// | compiler assetdir | meshdir and texturedir |
/// | no autolimits (true in newer versions) | autolimits true, if an element has a range |
/// | position kv, timeconst | general with gainprm, biasprm "0 −kp −kv", a filter |
/// | position dampratio | the same with kv = 2 ratio √(kp m), m the inertia that it moves |
/// | position inheritrange r | ctrlrange: that of the joint, r times as wide |
/// | joint actuatorfrcrange | forcerange of its actuators, by their gear |
/// | dyntype filterexact | filter |
/// | frame | a body without joints |
///
/// Attributes of default classes are included. All other unknown attributes, sensors, plugins and
/// solver settings are removed. Keyframes lose their controls if an actuator is removed. Visual
/// geoms whose mesh file is missing or empty are removed (DropMissingVisuals).
/// @throws InputError  if the model has replicate, attach or flexcomp, which are part of the hand
///     and cannot be converted; or if a mesh that a geom requires is missing or empty.
void ConvertMjcf(const std::filesystem::path& folder, ModelText& text);

/// Write the dampings of the actuators in `damping_ratios`.
/// @param dampings  dampings in the order of `damping_ratios`, N m s/rad.
void SetDampings(const std::vector<double>& dampings, ModelText& text);

/// Prepare a URDF model for MuJoCo.
/// Adds a `<compiler>` that keeps visual geoms and links fixed to other links, keeps the folders of
/// mesh paths, and accepts inertias that no rigid body has. Settings in the file take precedence.
///
/// MuJoCo identifies meshes by their file name without folders. Meshes with the same file name in
/// different folders, or with different scales, therefore get aliases (MeshFile). Paths such as
/// package://hand/meshes/x.stl are resolved next to the model and in the folders above it. Visual
/// meshes in formats that MuJoCo does not read, or with missing or empty files, are removed and
/// listed. MuJoCo ignores `<mimic>` and the attribute `effort` of joints; they become
/// ModelText::mimics and `ModelText::efforts`.
/// @throws InputError  if a collision mesh cannot be read, a value of `<mimic>` or an `effort` is
///     not a number, an `effort` is negative, or the model has a `<loop_joint>`.
void ConvertUrdf(const std::filesystem::path& folder, ModelText& text);

/// Remove all visual geoms, for models whose visual geoms MuJoCo rejects.
/// @param why  reason, for the list of conversions.
void DiscardVisuals(const std::string& why, ModelText& text);

}  // namespace regrasp::kinematics
