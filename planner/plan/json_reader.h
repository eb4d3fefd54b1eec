#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "planner/base/json.h"

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

}  // namespace regrasp::plan
