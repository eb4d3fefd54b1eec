#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

/// Header of a PCD file.
struct PcdHeader {
  std::map<std::string, std::vector<std::string>> lines;  ///< words of each line, by its first word
  std::size_t body = 0;                                   ///< offset of the points
};

/// Position and type of a field of a point.
struct PcdField {
  std::string name;
  std::size_t size = 4;
  char type = 'F';
  std::size_t count = 1;
};

PcdHeader ReadPcdHeader(std::string_view bytes, const std::string& name) {
  PcdHeader header;
  while (header.body < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', header.body), bytes.size());
    std::istringstream line(std::string(bytes.substr(header.body, end - header.body)));
    header.body = std::min(end + 1, bytes.size());
    std::string key;
    if (!(line >> key) || key[0] == '#') continue;
    std::vector<std::string>& words = header.lines[key];
    for (std::string word; line >> word;) words.push_back(word);
    if (key == "DATA") return header;
  }
  throw InputError(name + ": header: line DATA not found");
}

const std::vector<std::string>& LineOf(const PcdHeader& header, const std::string& key,
                                       std::size_t words, const std::string& name) {
  const auto found = header.lines.find(key);
  if (found == header.lines.end()) {
    throw InputError(name + ": header: line " + key + " not found");
  }
  if (found->second.size() == words) return found->second;
  throw InputError(name + ": header: line " + key + ": expected " + std::to_string(words) +
                   (words == 1 ? " value" : " values") + ", found " +
                   std::to_string(found->second.size()));
}

std::size_t ReadSize(const std::string& word, const std::string& key, const std::string& name) {
  constexpr long long kMost = 1'000'000'000;
  const auto value = ParseInteger(word);
  if (value && *value >= 1 && *value <= kMost) return static_cast<std::size_t>(*value);
  throw InputError(name + ": " + key + ": expected a count, found " + Quoted(word));
}

std::vector<PcdField> ReadFields(const PcdHeader& header, const std::string& name) {
  const auto fields = header.lines.find("FIELDS");
  if (fields == header.lines.end()) throw InputError(name + ": header: line FIELDS not found");
  const std::size_t n = fields->second.size();
  const auto& sizes = LineOf(header, "SIZE", n, name);
  const auto& types = LineOf(header, "TYPE", n, name);
  std::vector<PcdField> list;
  for (std::size_t i = 0; i < n; ++i) {
    PcdField field{fields->second[i], ReadSize(sizes[i], "SIZE", name), types[i][0], 1};
    if (header.lines.contains("COUNT")) {
      field.count = ReadSize(LineOf(header, "COUNT", n, name)[i], "COUNT", name);
    }
    list.push_back(field);
  }
  return list;
}

/// Find the index of the field of each axis.
std::array<std::size_t, 3> FindAxes(const std::vector<PcdField>& fields, const std::string& name) {
  std::array<std::size_t, 3> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::ranges::find(fields, kAxes[axis], &PcdField::name);
    const bool fits = found != fields.end() && found->type == 'F' && found->count == 1 &&
                      (found->size == sizeof(float) || found->size == sizeof(double));
    if (!fits) {
      throw InputError(name + ": header: expected a field " + std::string(kAxes[axis]) +
                       " of floating-point numbers");
    }
    places[axis] = static_cast<std::size_t>(found - fields.begin());
  }
  return places;
}

/// Add a point unless it is not finite: organized clouds store missing measurements so.
void AddPoint(const Eigen::Vector3d& point, PolygonSoup& cloud) {
  if (point.allFinite()) cloud.vertices.push_back(point);
}

void ReadPcdText(std::string_view text, const std::vector<PcdField>& fields, std::size_t points,
                 const std::string& name, PolygonSoup& cloud) {
  const std::array<std::size_t, 3> axes = FindAxes(fields, name);
  TextScanner scanner(text, name);
  for (std::size_t i = 0; i < points; ++i) {
    Eigen::Vector3d point = Eigen::Vector3d::Constant(std::nan(""));
    for (std::size_t f = 0; f < fields.size(); ++f) {
      for (std::size_t k = 0; k < fields[f].count; ++k) {
        const auto word = scanner.Next();
        if (!word) scanner.Fail("truncated inside point " + std::to_string(i));
        const auto axis = std::ranges::find(axes, f) - axes.begin();
        if (axis == 3) continue;
        if (const auto value = ParseDouble(*word)) point[axis] = *value;
      }
    }
    AddPoint(point, cloud);
  }
}

double ReadNumber(const char* at, std::size_t size) {
  static_assert(std::endian::native == std::endian::little, "PCD's binary numbers are");
  if (size == sizeof(double)) {
    double value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  float value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

void ReadPcdBinary(std::string_view bytes, const std::vector<PcdField>& fields, std::size_t points,
                   const std::string& name, PolygonSoup& cloud) {
  const std::array<std::size_t, 3> axes = FindAxes(fields, name);
  std::vector<std::size_t> offset;
  std::size_t row = 0;
  for (const PcdField& field : fields) {
    offset.push_back(row);
    row += field.size * field.count;
  }
  if (bytes.size() / row < points) {
    throw InputError(name + ": " + std::to_string(points) + " points of " + std::to_string(row) +
                     " bytes: truncated, found " + std::to_string(bytes.size()) + " bytes");
  }
  for (std::size_t i = 0; i < points; ++i) {
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] =
          ReadNumber(bytes.data() + i * row + offset[axes[axis]], fields[axes[axis]].size);
    }
    AddPoint(point, cloud);
  }
}

}  // namespace

PolygonSoup ReadXyz(std::string_view text, const std::string& name) {
  PolygonSoup cloud;
  TextScanner scanner(TextOf(text, name), name);
  while (const auto word = scanner.Next()) {
    const std::string what = "point " + std::to_string(cloud.vertices.size());
    Eigen::Vector3d point;
    const auto x = ParseDouble(*word);
    if (!x) scanner.Fail(what + ": expected a finite number, found " + Quoted(*word));
    point.x() = *x;
    for (const int axis : {1, 2}) {
      const auto next = scanner.NextOnLine();
      if (!next) scanner.Fail(what + ": expected three coordinates, found fewer");
      const auto value = ParseDouble(*next);
      if (!value) scanner.Fail(what + ": expected a finite number, found " + Quoted(*next));
      point[axis] = *value;
    }
    cloud.vertices.push_back(point);
    scanner.SkipLine();
  }
  return cloud;
}

PolygonSoup ReadPcd(std::string_view bytes, const std::string& name) {
  bytes = TextOf(bytes, name);
  const PcdHeader header = ReadPcdHeader(bytes, name);
  const std::vector<PcdField> fields = ReadFields(header, name);
  const std::size_t points = ReadSize(LineOf(header, "POINTS", 1, name)[0], "POINTS", name);
  const std::string& data = LineOf(header, "DATA", 1, name)[0];
  PolygonSoup cloud;
  if (data == "ascii") {
    ReadPcdText(bytes.substr(header.body), fields, points, name, cloud);
  } else if (data == "binary") {
    ReadPcdBinary(bytes.substr(header.body), fields, points, name, cloud);
  } else {
    throw InputError(
        name + ": DATA " + Quoted(data) +
        ": not supported; help: write it as ascii or binary (pcl_convert_pcd_ascii_binary)");
  }
  return cloud;
}

}  // namespace regrasp::object
