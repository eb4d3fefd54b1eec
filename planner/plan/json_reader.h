#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "planner/base/json.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Numbers beyond this are refused: their squares must not overflow.
inline constexpr double kLargestNumber = 1e15;

/// A place in a JSON file that is being read: the value, and how messages call it.
///
/// Every reading function throws InputError "plan.json: /steps/3/place/0/normal: expected …". The
/// JSON value must outlive the reader.
class JsonReader {
 public:
  JsonReader(const Json& value, std::string file, std::string pointer = "")
      : value_(value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  [[nodiscard]] bool Has(const char* key) const { return value_.contains(key); }
  [[nodiscard]] bool IsNull() const { return value_.is_null(); }
  /// The member `key` of an object; missing is an error.
  [[nodiscard]] JsonReader Member(const char* key) const;
  /// The elements of an array.
  [[nodiscard]] std::vector<JsonReader> Elements() const;

  [[nodiscard]] std::string String() const;
  /// A string that is one of a few.
  [[nodiscard]] std::string OneOf(std::initializer_list<const char*> choices) const;
  /// A number no larger in size than kLargestNumber.
  [[nodiscard]] double Number() const;
  /// A whole number in [lower, upper], lower ≥ 0.
  [[nodiscard]] int Integer(int lower, int upper) const;
  /// A whole number of 64 bits, ≥ 0.
  [[nodiscard]] std::uint64_t Unsigned() const;
  /// `dimension` numbers; the third is 0 in the plane.
  [[nodiscard]] Eigen::Vector3d Vector(int dimension) const;

  /// Demands `"format": format` and `"version": 1`.
  void ExpectFormat(const char* format) const;

  /// The value as messages show it: one line, shortened.
  [[nodiscard]] std::string Quoted() const;
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  [[noreturn]] void FailType(const char* expected) const;

  const Json& value_;
  std::string file_;
  std::string pointer_;
};

/// Numbers of a vector as JSON, two in the plane.
[[nodiscard]] Json VectorJson(const Eigen::Vector3d& vector, int dimension);

/// Reads `{"point": […], "normal": […]}`, both of `dimension` numbers; further fields are ignored.
[[nodiscard]] grasp::Contact ReadContact(const JsonReader& json, int dimension);

/// Reads an array of contacts, each with its `finger` and, if it has one, its `region`.
[[nodiscard]] FingerGrasp ReadFingerGrasp(const JsonReader& json, int dimension);

/// Reads a finger's number. Numbers outside the hand are left to the checker.
[[nodiscard]] FingerIndex ReadFinger(const JsonReader& json);

[[nodiscard]] Json ContactJson(const grasp::Contact& contact, int dimension);
[[nodiscard]] Json GraspJson(const grasp::Grasp& grasp, int dimension);
[[nodiscard]] Json FingerGraspJson(const FingerGrasp& grasp, int dimension);

[[nodiscard]] Json ForcesJson(const std::vector<Eigen::Vector3d>& forces, int dimension);
[[nodiscard]] Json MotionSegmentsJson(const motion::MotionSegments& pieces, int dimension);
/// @throws InputError
[[nodiscard]] std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension);
/// A list of numbers where there is one of that name; otherwise empty. @throws InputError
[[nodiscard]] std::vector<double> ReadTorques(const JsonReader& json, const char* name);
[[nodiscard]] motion::MotionSegments ReadMotionSegments(const JsonReader& json, int dimension);

/// The parts of a plan's file that say how a hand moves (docs/plan.schema.json).
/// @throws InputError
[[nodiscard]] HandUse ReadHandUse(const JsonReader& json);
[[nodiscard]] HandPath ReadHandPath(const JsonReader& json);
[[nodiscard]] SwitchMotion ReadSwitchMotion(const JsonReader& json);

/// Doubles read back as the same bits.
[[nodiscard]] Json HandUseJson(const HandUse& hand);
[[nodiscard]] Json HandPathJson(const HandPath& path);
[[nodiscard]] Json SwitchMotionJson(const SwitchMotion& motion);

/// 64 lower-case hexadecimal digits.
[[nodiscard]] std::string ReadSha256(const JsonReader& json);

}  // namespace regrasp::plan
