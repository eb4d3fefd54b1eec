#include "apps/grasp_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/zip_archive.h"

namespace regrasp::apps {

namespace {

constexpr char kPoints[] = "points";
constexpr char kNormals[] = "normals";
constexpr char kActive[] = "active";
constexpr char kActiveInVersion1[] = "holds";
constexpr char kFormatVersion[] = "format_version";

const NpzArray* Find(const std::vector<NpzArray>& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays, name, &NpzArray::name);
  return found == arrays.end() ? nullptr : &*found;
}

std::string ShapeText(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t length : shape)
    text += (text.empty() ? "" : ", ") + std::to_string(length);
  return "(" + text + ")";
}

void CheckFinite(const NpzArray& array, const std::string& file) {
  const auto found = std::ranges::find_if(array.values, [](double x) { return !std::isfinite(x); });
  if (found == array.values.end()) return;
  const auto at = static_cast<std::size_t>(found - array.values.begin());
  const std::size_t width = array.shape[2];
  throw InputError(file + ": " + array.name + "[" + std::to_string(at / (array.shape[1] * width)) +
                   ", " + std::to_string(at / width % array.shape[1]) + ", " +
                   std::to_string(at % width) + "] must be finite, found " + FormatDouble(*found));
}

/// Return vectors in space, with z = 0 if the array has only x and y.
std::vector<double> InSpace(const NpzArray& array) {
  if (array.shape[2] == 3) return array.values;
  std::vector<double> values;
  values.reserve(array.values.size() / 2 * 3);
  for (std::size_t i = 0; i < array.values.size(); i += 2) {
    values.insert(values.end(), {array.values[i], array.values[i + 1], 0});
  }
  return values;
}

using Shape = std::vector<std::size_t>;

/// Check the shape of an array of points.
/// @throws InputError  if it is not the shape of N grasps with k contacts.
void CheckShape(const Shape& shape, const std::string& file, int dimension) {
  constexpr std::size_t kMostContacts = 1000;
  if (shape.size() != 3 || shape[2] != static_cast<std::size_t>(dimension) || shape[1] < 1 ||
      shape[1] > kMostContacts) {
    throw InputError(file + ": points: expected shape (N, k, " + std::to_string(dimension) +
                     ") with k from 1 to " + std::to_string(kMostContacts) + ", found " +
                     ShapeText(shape));
  }
  if (shape[0] == 0)
    throw InputError(file + ": points: expected at least one grasp, found shape " +
                     ShapeText(shape));
}

/// Append the values of the active contacts of grasp g, with k contacts.
void AppendActive(const std::vector<double>& values, const std::vector<double>& active,
                  std::size_t g, std::size_t k, std::vector<double>& to) {
  for (std::size_t c = g * k; c < (g + 1) * k; ++c) {
    if (active[c] == 0) continue;
    to.insert(to.end(), &values[3 * c], &values[3 * c] + 3);
  }
}

/// Group grasps by their number of active contacts; drop those without any.
/// @param all     N grasps of k contacts.
/// @param active  (N, k) mask of active contacts.
std::vector<GraspGroup> SplitByCount(const GraspGroup& all, const std::vector<double>& active) {
  const auto k = static_cast<std::size_t>(all.contacts);
  std::vector<GraspGroup> groups(k);
  for (std::size_t g = 0; g < all.places.size(); ++g) {
    const auto begin = active.begin() + static_cast<std::ptrdiff_t>(g * k);
    const auto held = static_cast<std::size_t>(
        std::count_if(begin, begin + all.contacts, [](double a) { return a != 0; }));
    if (held == 0) continue;
    GraspGroup& group = groups[held - 1];
    group.contacts = static_cast<int>(held);
    group.places.push_back(g);
    for (std::size_t c = 0; c < k; ++c) {
      if (active[g * k + c] != 0) group.fingers.push_back(static_cast<int>(c));
    }
    AppendActive(all.points, active, g, k, group.points);
    if (!all.normals.empty()) AppendActive(all.normals, active, g, k, group.normals);
  }
  std::erase_if(groups, [](const GraspGroup& group) { return group.places.empty(); });
  return groups;
}

/// Return the mask of active contacts, or nullptr if the file has none.
/// Version 1 calls it `holds`.
/// @throws InputError  if the version is not supported, or if the file has the mask twice.
const NpzArray* FindActive(const std::vector<NpzArray>& arrays, const std::string& file) {
  const NpzArray* active = Find(arrays, kActive);
  const NpzArray* old = Find(arrays, kActiveInVersion1);
  const NpzArray* version = Find(arrays, kFormatVersion);
  if (version != nullptr) {
    if (version->values.size() != 1 || (version->values[0] != 1 && version->values[0] != 2)) {
      throw InputError(file + ": format_version: not supported, expected 1 or 2" +
                       (version->values.size() == 1
                            ? ", found " + FormatShort(version->values[0])
                            : ", found an array of shape " + ShapeText(version->shape)));
    }
    if (version->values[0] == 2) return active;
  }
  if (active != nullptr && old != nullptr) {
    throw InputError(
        file + ": active: cannot be used with holds, its name in version 1; help: remove holds");
  }
  return active != nullptr ? active : old;
}

}  // namespace

GraspTable ReadGrasps(const std::string& file, int dimension) {
  const std::vector<NpzArray> arrays = ReadNpz(
      ReadFile(file), file, {kPoints, kNormals, kActive, kActiveInVersion1, kFormatVersion});
  const NpzArray* points = Find(arrays, kPoints);
  const NpzArray* normals = Find(arrays, kNormals);
  const NpzArray* active = FindActive(arrays, file);
  if (points == nullptr) {
    throw InputError(file + ": points: array not found, expected shape (N, k, " +
                     std::to_string(dimension) + ")");
  }
  const Shape& shape = points->shape;
  CheckShape(shape, file, dimension);
  if (normals != nullptr && normals->shape != shape) {
    throw InputError(file + ": normals: expected shape " + ShapeText(shape) + ", as points" +
                     ", found " + ShapeText(normals->shape));
  }
  if (active != nullptr && active->shape != Shape{shape[0], shape[1]}) {
    throw InputError(file + ": " + active->name + ": expected shape " +
                     ShapeText({shape[0], shape[1]}) + " for points of shape " + ShapeText(shape) +
                     ", found " + ShapeText(active->shape));
  }
  CheckFinite(*points, file);
  GraspGroup all;
  all.contacts = static_cast<int>(shape[1]);
  all.places.resize(shape[0]);
  for (std::size_t g = 0; g < shape[0]; ++g) all.places[g] = g;
  for (std::size_t c = 0; c < shape[0] * shape[1]; ++c) {
    all.fingers.push_back(static_cast<int>(c % shape[1]));
  }
  all.points = InSpace(*points);
  if (normals != nullptr) {
    CheckFinite(*normals, file);
    all.normals = InSpace(*normals);
  }
  GraspTable table{shape[0], all.contacts, {}};
  if (active != nullptr) {
    table.groups = SplitByCount(all, active->values);
  } else {
    table.groups.push_back(std::move(all));
  }
  return table;
}

}  // namespace regrasp::apps
