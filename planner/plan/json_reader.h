#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/json.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Largest absolute value of numbers, so that their squares do not overflow.
inline constexpr double kLargestNumber = 1e15;

/// Value in a JSON file that is being read, with its name in messages.
///
/// Every reading function throws InputError "plan.json: /steps/3/place/0/normal: expected …". The
/// JSON value must outlive the reader.
class JsonReader {
 public:
  JsonReader(const Json& value, std::string file, std::string pointer = "")
      : value_(value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  [[nodiscard]] bool Has(const char* key) const { return value_.contains(key); }
  [[nodiscard]] bool IsNull() const { return value_.is_null(); }
  [[nodiscard]] bool IsString() const { return value_.is_string(); }
  [[nodiscard]] bool IsArray() const { return value_.is_array(); }
  /// Require an object without members of other names.
  void ExpectOnly(std::initializer_list<std::string_view> names) const;
  /// Return the member `key` of an object, which is required.
  [[nodiscard]] JsonReader Member(const char* key) const;
  /// Return the elements of an array.
  [[nodiscard]] std::vector<JsonReader> Elements() const;

  [[nodiscard]] std::string String() const;
  /// Return a string without control characters, for messages.
  [[nodiscard]] std::string Name() const;
  /// Return a string that must be one of the choices.
  [[nodiscard]] std::string OneOf(std::initializer_list<const char*> choices) const;
  /// Return a number with absolute value at most kLargestNumber.
  [[nodiscard]] double Number() const;
  /// Return an integer in [lower, upper], lower ≥ 0.
  [[nodiscard]] int Integer(int lower, int upper) const;
  /// Return a 64-bit integer ≥ 0.
  [[nodiscard]] std::uint64_t Unsigned() const;
  /// Return `dimension` numbers as a vector; the third is 0 in the plane.
  [[nodiscard]] Eigen::Vector3d Vector(int dimension) const;

  /// Require `"format": format` and `"version": 1`.
  void ExpectFormat(const char* format) const;

  /// Return the value for messages: one line, shortened.
  [[nodiscard]] std::string Quoted() const;
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  [[noreturn]] void FailType(const char* expected) const;

  const Json& value_;
  std::string file_;
  std::string pointer_;
};

/// Return the numbers of a vector as JSON, two in the plane.
[[nodiscard]] Json VectorJson(const Eigen::Vector3d& vector, int dimension);

/// Read `{"point": […], "normal": […]}`, both of `dimension` numbers; further fields are ignored.
[[nodiscard]] grasp::Contact ReadContact(const JsonReader& json, int dimension);

/// Read an array of contacts, each with its `finger` and an optional `region`.
[[nodiscard]] FingerGrasp ReadFingerGrasp(const JsonReader& json, int dimension);

/// Read a finger number. The checker rejects numbers outside the hand.
[[nodiscard]] FingerIndex ReadFinger(const JsonReader& json);

[[nodiscard]] Json ContactJson(const grasp::Contact& contact, int dimension);
[[nodiscard]] Json GraspJson(const grasp::Grasp& grasp, int dimension);
[[nodiscard]] Json FingerGraspJson(const FingerGrasp& grasp, int dimension);

[[nodiscard]] Json ForcesJson(const std::vector<Eigen::Vector3d>& forces, int dimension);
[[nodiscard]] Json MotionSegmentsJson(const motion::MotionSegments& pieces, int dimension);
/// Read a list of forces.
/// @throws InputError  if the value is not a list of vectors.
[[nodiscard]] std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension);
/// Read a list of numbers; empty if there is no member of that name.
/// @throws InputError  if the member is not a list of numbers.
[[nodiscard]] std::vector<double> ReadTorques(const JsonReader& json, const char* name);
[[nodiscard]] motion::MotionSegments ReadMotionSegments(const JsonReader& json, int dimension);

[[nodiscard]] Eigen::Isometry3d ReadPose(const JsonReader& json);
[[nodiscard]] Json PoseJson(const Eigen::Isometry3d& pose);

/// Read the parts of a plan file that describe the motion of a hand (docs/plan.schema.json).
/// @throws InputError  if the value does not match the schema.
[[nodiscard]] HandUse ReadHandUse(const JsonReader& json);
[[nodiscard]] HandPath ReadHandPath(const JsonReader& json);
[[nodiscard]] SwitchMotion ReadSwitchMotion(const JsonReader& json);

/// Write a hand as JSON; doubles read back bit-identically.
[[nodiscard]] Json HandUseJson(const HandUse& hand);
[[nodiscard]] Json HandPathJson(const HandPath& path);
[[nodiscard]] Json SwitchMotionJson(const SwitchMotion& motion);

/// Read 64 lower-case hexadecimal digits.
[[nodiscard]] std::string ReadSha256(const JsonReader& json);

}  // namespace regrasp::plan
