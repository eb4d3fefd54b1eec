#include "planner/plan/json_reader.h"

#include <cmath>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::plan {

namespace {

/// Messages show no more of a value than this.
constexpr std::size_t kLongestQuote = 60;

std::string Range(int lower, int upper) {
  if (lower == upper) return std::to_string(lower);
  return "a whole number from " + std::to_string(lower) + " to " + std::to_string(upper);
}

}  // namespace

void JsonReader::Fail(const std::string& what) const {
  throw InputError(file_ + ": " + (pointer_.empty() ? "" : pointer_ + ": ") + what);
}

void JsonReader::FailType(const char* expected) const {
  Fail(std::string("expected ") + expected + ", found " + Quoted());
}

std::string JsonReader::Quoted() const {
  if (value_.is_object()) return "a JSON object";
  if (value_.is_array()) return "a JSON array";
  std::string text = value_.dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace);
  if (text.size() > kLongestQuote) text = text.substr(0, kLongestQuote) + "...";
  return text;
}

JsonReader JsonReader::Member(const char* key) const {
  if (!value_.is_object()) FailType("a JSON object");
  const auto member = value_.find(key);
  if (member == value_.end()) Fail(std::string("\"") + key + "\" is missing");
  return {*member, file_, pointer_ + "/" + key};
}

std::vector<JsonReader> JsonReader::Elements() const {
  if (!value_.is_array()) FailType("a JSON array");
  std::vector<JsonReader> elements;
  elements.reserve(value_.size());
  for (std::size_t i = 0; i < value_.size(); ++i) {
    elements.emplace_back(value_[i], file_, pointer_ + "/" + std::to_string(i));
  }
  return elements;
}

std::string JsonReader::String() const {
  if (!value_.is_string()) FailType("a string");
  return value_.get<std::string>();
}

std::string JsonReader::OneOf(std::initializer_list<const char*> choices) const {
  const std::string found = String();
  std::string expected;
  for (const char* choice : choices) {
    if (found == choice) return found;
    expected += std::string(expected.empty() ? "\"" : " or \"") + choice + "\"";
  }
  Fail("expected " + expected + ", found " + Quoted());
}

double JsonReader::Number() const {
  if (!value_.is_number()) FailType("a number");
  const double number = value_.get<double>();
  if (!(std::abs(number) <= kLargestNumber)) Fail("the number " + Quoted() + " is too large");
  return number;
}

int JsonReader::Integer(int lower, int upper) const {
  const double number = Number();
  if (number != std::floor(number) || number < lower || number > upper) {
    Fail("expected " + Range(lower, upper) + ", found " + Quoted());
  }
  return static_cast<int>(number);
}

std::uint64_t JsonReader::Unsigned() const {
  if (!value_.is_number_unsigned()) FailType("a whole number of 64 bits");
  return value_.get<std::uint64_t>();
}

Eigen::Vector3d JsonReader::Vector(int dimension) const {
  const std::vector<JsonReader> elements = Elements();
  if (elements.size() != static_cast<std::size_t>(dimension)) {
    Fail("expected " + std::to_string(dimension) + " numbers, found " +
         std::to_string(elements.size()));
  }
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int i = 0; i < dimension; ++i) vector[i] = elements[i].Number();
  return vector;
}

void JsonReader::ExpectFormat(const char* format) const {
  static_cast<void>(Member("format").OneOf({format}));
  static_cast<void>(Member("version").Integer(1, 1));
}

Json VectorJson(const Eigen::Vector3d& vector, int dimension) {
  Json json = Json::array();
  // Adding 0 turns −0 into 0, which reads better.
  for (int i = 0; i < dimension; ++i) json.push_back(vector[i] + 0.0);
  return json;
}

}  // namespace regrasp::plan
