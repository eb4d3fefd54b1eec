#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regrasp::kinematics {

/// An element of an XML file; text between elements is not kept.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< in the order of the file
  std::vector<XmlElement> children;
  std::string file;  ///< where it stands, for messages
  int line = 0;

  /// @returns nullptr where it has no such attribute; valid until the attributes change.
  [[nodiscard]] const std::string* Find(std::string_view attribute) const;
  void Set(std::string_view attribute, std::string value);
  void Remove(std::string_view attribute);
  /// @returns nullptr where it has none; the first of several.
  [[nodiscard]] const XmlElement* Child(std::string_view child) const;
};

/// @param file  how messages call it.
/// @throws InputError  it is no XML, or elements are nested deeper than any model's.
[[nodiscard]] XmlElement ParseXml(std::string_view text, const std::string& file);

/// Law: ParseXml of the text gives the same names, attributes and children.
[[nodiscard]] std::string FormatXml(const XmlElement& root);

/// What became of something in a model's file that MuJoCo, in the version that is linked here, does
/// not know.
struct Conversion {
  std::string file;
  int line = 0;
  std::string element;    ///< "position", "joint"
  std::string name;       ///< of the element, or its class; may be empty
  std::string attribute;  ///< empty: the whole element
  std::string outcome;    ///< "left out: …", "to ctrlrange, from the joint's range"
};

/// A joint of a URDF that follows another one: its angle is multiplier · other + offset.
struct Mimic {
  std::string joint;
  std::string follows;
  double multiplier = 1;
  double offset = 0;
};

/// An actuator whose damping is given as a share of the critical one, which is known when the model
/// is compiled.
struct DampingRatio {
  int actuator = 0;  ///< in the order of the model
  double ratio = 1;
};

/// A file of a mesh that the model names.
struct MeshFile {
  std::filesystem::path path;
  /// What the model's text calls it, where MuJoCo is handed its bytes under that name; empty where
  /// MuJoCo finds it.
  std::string alias;
};

/// The text of a model, as MuJoCo is given it.
struct ModelText {
  XmlElement root;
  std::vector<std::filesystem::path> files;  ///< of the model and what it includes
  std::vector<Conversion> conversions;
  std::vector<MeshFile> meshes;  ///< in the order of the text, each once
  std::vector<Mimic> mimics;
  /// Largest torque of each joint of a URDF, N m, by name; a joint without one, or with 0, is
  /// absent.
  std::map<std::string, double> efforts;
  std::vector<DampingRatio> damping_ratios;
};

/// Reads an MJCF (with the files that it includes) or URDF model and converts it to what MuJoCo,
/// as it is linked here, can read: newer versions have more.
///
/// What has an effect is converted (convert_mjcf.h, convert_urdf.h), what has none on how a hand
/// moves and what it looks like is left out, and all of it is listed. A model that needs nothing of
/// it stays word for word what it is, but for its layout.
/// @throws InputError  names the file and line: no XML, neither MJCF nor URDF, an include that
///                     leads to itself, an element that cannot be converted (replicate, attach),
///                     xacro that is not expanded.
[[nodiscard]] ModelText ReadModelText(const std::filesystem::path& path);

}  // namespace regrasp::kinematics
