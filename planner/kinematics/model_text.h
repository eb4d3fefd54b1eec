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
/// Elements that affect the hand are converted (convert_mjcf.h, convert_urdf.h). Elements that
/// affect neither its motion nor its visuals are removed. All conversions are listed. A model that
/// requires no conversion keeps its text except for the layout.
/// @throws InputError  if the file is not XML, is neither MJCF nor URDF, includes itself, or has an
///     element that cannot be converted (replicate, attach) or unexpanded xacro. The message names
///     the file and line.
[[nodiscard]] ModelText ReadModelText(const std::filesystem::path& path);

}  // namespace regrasp::kinematics
