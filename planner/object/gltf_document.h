#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/json.h"

namespace regrasp::object {

/// A value in the JSON of a glTF file together with its JSON pointer, which messages name.
class GltfValue {
 public:
  GltfValue(const Json& json, std::string pointer) : json_(&json), pointer_(std::move(pointer)) {}

  [[nodiscard]] const std::string& pointer() const { return pointer_; }
  /// Return a member; nullopt if it is missing.
  /// @throws InputError  if this value is not an object.
  [[nodiscard]] std::optional<GltfValue> Find(const std::string& key) const;
  /// Return a member.
  /// @throws InputError  if the member is missing.
  [[nodiscard]] GltfValue Member(const std::string& key) const;
  /// Return the elements of the array `key`; empty if it is missing.
  [[nodiscard]] std::vector<GltfValue> Items(const std::string& key) const;
  /// Return the element with the given index of the array `key`.
  [[nodiscard]] GltfValue Item(const std::string& key, long long index) const;
  /// Return the numbers of the array `key`; nullopt if it is missing.
  /// @throws InputError  if there are not `size` finite numbers.
  [[nodiscard]] std::optional<std::vector<double>> Numbers(const std::string& key,
                                                           std::size_t size) const;

  /// Return the value as a non-negative integer.
  /// @throws InputError  if the value is not of that type, or is a negative or huge integer.
  [[nodiscard]] long long Count() const;
  [[nodiscard]] long long CountOr(const std::string& key, long long otherwise) const;
  [[nodiscard]] double Number() const;
  [[nodiscard]] std::string Text() const;
  [[nodiscard]] bool IsTrue() const { return json_->is_boolean() && json_->get<bool>(); }
  /// Return the names of the members of an object.
  [[nodiscard]] std::vector<std::string> Keys() const;

  /// Throw an InputError with the value's JSON pointer: "/nodes/3: …".
  [[noreturn]] void Fail(const std::string& problem) const;

 private:
  const Json* json_;
  std::string pointer_;
};

/// Document of a glTF 2.0 file with the numbers in its buffers.
///
/// No other file is opened: buffers are the binary chunk of a `.glb` file or base64 text. Source:
/// glTF 2.0 Specification (Khronos, 2021), sections 3.6 and 4.
class GltfDocument {
 public:
  /// @param bytes  bytes of a `.gltf` or `.glb` file; must outlive this object.
  /// @throws InputError  without the file's name, if they are not a glTF 2 document.
  explicit GltfDocument(std::string_view bytes);

  [[nodiscard]] GltfValue root() const { return {json_, ""}; }

  /// Read an accessor of positions: floats, or with KHR_mesh_quantization integers.
  /// @throws InputError  if it has another type, or reaches beyond its buffer.
  [[nodiscard]] std::vector<Eigen::Vector3d> Positions(long long accessor);

  /// Read an accessor of vertex indices.
  /// @throws InputError  same as Positions.
  [[nodiscard]] std::vector<long long> Indices(long long accessor);

 private:
  /// Layout of numbers in a buffer.
  struct Layout {
    long long component_type = 0;
    bool normalized = false;
    long long components = 1, count = 0;
  };

  void ReadContainer(std::string_view bytes);
  [[nodiscard]] std::string_view Buffer(long long index);
  [[nodiscard]] std::vector<double> ReadView(const GltfValue& user, const Layout& layout);
  [[nodiscard]] std::vector<double> ReadAccessor(const GltfValue& accessor, const Layout& layout);
  void ApplySparse(const GltfValue& sparse, const Layout& layout, std::vector<double>& values);

  Json json_;
  std::string_view binary_;  ///< binary chunk of a .glb file
  bool quantized_ = false;   ///< the file uses KHR_mesh_quantization
  std::map<long long, std::string> decoded_;
};

}  // namespace regrasp::object
