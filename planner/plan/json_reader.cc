#include "planner/plan/json_reader.h"

#include <cmath>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp {

void JsonReader::Fail(const std::string& what) const {
  throw InputError(file_ + ": " + (pointer_.empty() ? "the file" : pointer_) + ": " + what);
}

JsonReader JsonReader::Member(const char* key) const {
  if (!value_.is_object()) Fail(std::string("expected an object, found ") + value_.type_name());
  const auto member = value_.find(key);
  if (member == value_.end()) Fail(std::string("\"") + key + "\" is missing");
  return {*member, file_, pointer_ + "/" + key};
}

std::vector<JsonReader> JsonReader::Elements() const {
  if (!value_.is_array()) Fail(std::string("expected an array, found ") + value_.type_name());
  std::vector<JsonReader> elements;
  elements.reserve(value_.size());
  for (std::size_t i = 0; i < value_.size(); ++i) {
    elements.emplace_back(value_[i], file_, pointer_ + "/" + std::to_string(i));
  }
  return elements;
}

std::string JsonReader::String() const {
  if (!value_.is_string()) Fail(std::string("expected a string, found ") + value_.type_name());
  return value_.get<std::string>();
}

double JsonReader::Number() const {
  if (!value_.is_number()) Fail(std::string("expected a number, found ") + value_.type_name());
  const double number = value_.get<double>();
  if (!std::isfinite(number) || std::abs(number) > kLargestNumber) {
    Fail("the number " + FormatDouble(number) + " is too large");
  }
  return number;
}

int JsonReader::Integer(int lower, int upper) const {
  const double number = Number();
  if (!value_.is_number_integer() || number < lower || number > upper) {
    Fail("expected an integer from " + std::to_string(lower) + " to " + std::to_string(upper) +
         ", found " + FormatDouble(number));
  }
  return static_cast<int>(number);
}

Eigen::Vector3d JsonReader::Vector(int dimension) const {
  const std::vector<JsonReader> elements = Elements();
  if (static_cast<int>(elements.size()) != dimension) {
    Fail("expected " + std::to_string(dimension) + " numbers, found " +
         std::to_string(elements.size()));
  }
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int i = 0; i < dimension; ++i) vector[i] = elements[i].Number();
  return vector;
}

void JsonReader::ExpectFormat(const std::string& format) const {
  const std::string found = Member("format").String();
  if (found != format) {
    Member("format").Fail("expected \"" + format + "\", found \"" + found + "\"");
  }
  static_cast<void>(Member("version").Integer(1, 1));
}

Json VectorJson(const Eigen::Vector3d& vector, int dimension) {
  Json json = Json::array();
  // Adding 0 turns −0 into 0, which reads better.
  for (int i = 0; i < dimension; ++i) json.push_back(vector[i] + 0.0);
  return json;
}

}  // namespace regrasp
