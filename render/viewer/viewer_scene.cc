#include "render/viewer/viewer_scene.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr double kLargestCode = 65535;
constexpr double kNormalScale = 127;

/// Number of triangles up to which the mesh of a link is not simplified.
constexpr int kSmallLink = 1000;

/// Return the bytes of integers, least significant byte first.
template <typename Integer>
std::string LittleEndian(const std::vector<Integer>& values) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(Integer));
  for (const Integer value : values) {
    for (std::size_t byte = 0; byte < sizeof(Integer); ++byte) {
      bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * byte) & 0xff);
    }
  }
  return bytes;
}

/// Return a number with six significant digits; 0 if it is not finite.
double Rounded(double value) {
  if (!std::isfinite(value) || value == 0) return 0;
  const double unit = std::pow(10.0, 6 - std::ceil(std::log10(std::abs(value))));
  return std::isfinite(unit) && unit > 0 ? std::round(value * unit) / unit : 0;
}

Json VectorJson(const Vector3d& v) { return {Rounded(v.x()), Rounded(v.y()), Rounded(v.z())}; }

/// A table of numbers, one row per sample, that is written column by column.
class SampleTable {
 public:
  explicit SampleTable(std::size_t columns) : columns_(columns) {}

  void AddRow(const std::vector<double>& row) {
    if (row.size() != columns_.size()) {
      throw std::invalid_argument("SampleTable: rows of different sizes");
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      columns_[i].push_back(std::isfinite(row[i]) ? row[i] : 0);
    }
  }

  /// Columns with different values have codes; all others have only their value.
  [[nodiscard]] Json Format() const {
    Json low = Json::array();
    Json high = Json::array();
    std::vector<std::uint16_t> codes;
    for (const std::vector<double>& column : columns_) {
      const auto [least, largest] = std::ranges::minmax(column);
      const double from = Rounded(least);
      const double to = Rounded(largest);
      low.push_back(from);
      high.push_back(to);
      if (from == to) continue;
      for (const double value : column) {
        const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
        codes.push_back(static_cast<std::uint16_t>(std::lround(share * kLargestCode)));
      }
    }
    return {{"low", low}, {"high", high}, {"codes", Base64(LittleEndian(codes))}};
  }

 private:
  std::vector<std::vector<double>> columns_;
};

/// Collects the different vertices of a mesh.
class VertexIndex {
 public:
  VertexIndex(const Vector3d& low, double unit) : low_(low), unit_(unit) {}

  std::uint32_t IndexOf(const Vector3d& p, const Vector3d& normal) {
    Key key;
    for (int i = 0; i < 3; ++i) {
      const double code = unit_ > 0 ? std::round((p[i] - low_[i]) / unit_) : 0;
      key[i] = static_cast<int>(std::clamp(code, 0.0, kLargestCode));
      key[3 + i] = static_cast<int>(std::lround(std::clamp(normal[i], -1.0, 1.0) * kNormalScale));
    }
    const auto [found, is_new] = indices_.try_emplace(key, static_cast<std::uint32_t>(count()));
    if (is_new) {
      for (int i = 0; i < 3; ++i) {
        positions_.push_back(static_cast<std::uint16_t>(key[i]));
        normals_.push_back(static_cast<std::int8_t>(key[3 + i]));
      }
    }
    return found->second;
  }
  [[nodiscard]] std::size_t count() const { return positions_.size() / 3; }
  [[nodiscard]] const std::vector<std::uint16_t>& positions() const { return positions_; }
  [[nodiscard]] const std::vector<std::int8_t>& normals() const { return normals_; }

 private:
  using Key = std::array<int, 6>;

  Vector3d low_;
  double unit_;
  std::map<Key, std::uint32_t> indices_;
  std::vector<std::uint16_t> positions_;
  std::vector<std::int8_t> normals_;
};

Json MeshJson(const ShadedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& corners : mesh.triangles) {
    for (const Vector3d& p : corners) box.extend(p);
  }
  const Vector3d low = box.isEmpty() ? Vector3d(Vector3d::Zero()) : Vector3d(box.min());
  const double unit = box.isEmpty() ? 0 : box.sizes().maxCoeff() / kLargestCode;
  VertexIndex vertices(low, unit);
  std::vector<std::uint32_t> indices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> triangle;
    for (int i = 0; i < 3; ++i) {
      triangle[i] = vertices.IndexOf(mesh.triangles[t][i], mesh.normals[t][i]);
    }
    const auto& [a, b, c] = triangle;
    if (a == b || b == c || c == a) continue;
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  }
  const bool wide = vertices.count() > kLargestCode;
  const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
  return {{"low", VectorJson(low)},
          {"unit", unit},
          {"wide", wide},
          {"positions", Base64(LittleEndian(vertices.positions()))},
          {"normals", Base64(LittleEndian(vertices.normals()))},
          {"indices", Base64(wide ? LittleEndian(indices) : LittleEndian(narrow))}};
}

Json EdgesJson(const std::vector<std::array<Vector3d, 2>>& edges) {
  SampleTable table(3);
  for (const auto& edge : edges) {
    for (const Vector3d& p : edge) table.AddRow({p.x(), p.y(), p.z()});
  }
  return edges.empty() ? Json(nullptr) : table.Format();
}

/// Return a text without invisible characters and bytes that are not UTF-8.
std::string Visible(std::string_view text) {
  std::string visible;
  while (!text.empty()) {
    const Utf8Character character = TakeCharacter(text);
    const bool shown = character.is_valid && !IsInvisible(character.code);
    visible += shown ? std::string(character.bytes) : "\xEF\xBF\xBD";  // U+FFFD
  }
  return visible;
}

std::string ColorText(Color color) {
  const std::string bytes = {static_cast<char>(color.r), static_cast<char>(color.g),
                             static_cast<char>(color.b)};
  std::string text = "#";
  for (const char byte : bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(byte);
    text += {kDigits[value / 16], kDigits[value % 16]};
  }
  return text;
}

Json PoseJson(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Vector3d& p = pose.translation();
  Json json = VectorJson(p);
  for (const double x : {q.x(), q.y(), q.z(), q.w()}) json.push_back(Rounded(x));
  return json;
}

/// Return the row of a sample: time, position and quaternion of the object, joints, and ten numbers
/// for each finger.
/// @param previous  quaternion of the sample before, whose sign is kept.
std::vector<double> RowOf(const ViewerSample& sample, Eigen::Quaterniond& previous) {
  Eigen::Quaterniond q(sample.X_WO.linear());
  if (q.dot(previous) < 0) q.coeffs() *= -1;
  previous = q;
  const Vector3d& p = sample.X_WO.translation();
  std::vector<double> row = {sample.time_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  row.insert(row.end(), sample.joints.begin(), sample.joints.end());
  for (const ViewerContact& contact : sample.contacts) {
    row.push_back(static_cast<double>(contact.state));
    for (const Vector3d* v : {&contact.point, &contact.inward, &contact.force}) {
      row.insert(row.end(), v->data(), v->data() + 3);
    }
  }
  return row;
}

Json SamplesJson(const ViewerScene& scene) {
  if (scene.samples.empty()) throw std::invalid_argument("FormatViewerScene: no sample");
  const bool turns = !scene.turned.empty();
  if (turns && scene.turned.size() != scene.samples.size()) {
    throw std::invalid_argument("FormatViewerScene: one angle per sample is required");
  }
  Eigen::Quaterniond previous = Eigen::Quaterniond::Identity();
  SampleTable table(8 + scene.joints.size() + 10 * scene.fingers.size() + (turns ? 1 : 0));
  for (std::size_t i = 0; i < scene.samples.size(); ++i) {
    std::vector<double> row = RowOf(scene.samples[i], previous);
    if (turns) row.push_back(scene.turned[i]);
    table.AddRow(row);
  }
  Json json = table.Format();
  json["count"] = scene.samples.size();
  return json;
}

Json StepsJson(const ViewerScene& scene) {
  Json steps = Json::array();
  for (const ViewerStep& step : scene.steps) {
    steps.push_back({{"number", step.number},
                     {"start", Rounded(step.start_s)},
                     {"end", Rounded(step.end_s)},
                     {"title", Visible(step.title)},
                     {"verdict", step.verdict},
                     {"reason", Visible(step.reason)},
                     {"margin", step.margin ? Json(Rounded(*step.margin)) : Json(nullptr)}});
  }
  return steps;
}

Json HandJson(const ViewerScene& scene) {
  if (scene.links.empty()) return nullptr;
  Json joints = Json::array();
  for (const ViewerJoint& joint : scene.joints) {
    joints.push_back({{"parent", joint.parent},
                      {"offset", VectorJson(joint.offset)},
                      {"axis", VectorJson(joint.axis)},
                      {"rest", Rounded(joint.rest)}});
  }
  double all = 0;
  for (const ViewerLink& link : scene.links) all += static_cast<double>(link.mesh.triangles.size());
  const double share = std::min(1.0, kMostHandTriangles / all);
  Json links = Json::array();
  for (const ViewerLink& link : scene.links) {
    const auto own = static_cast<double>(link.mesh.triangles.size());
    const double most = std::max<double>(share * own, kSmallLink);
    links.push_back({{"joint", link.joint},
                     {"finger", link.finger.valid() ? int{link.finger} : -1},
                     {"tip", link.is_fingertip},
                     {"mesh", MeshJson(SimplifyForViewer(link.mesh, static_cast<int>(most)))}});
  }
  return {{"pose", PoseJson(scene.X_WP)}, {"joints", joints}, {"links", links}};
}

Json FingersJson(const ViewerScene& scene) {
  Json fingers = Json::array();
  for (const ViewerFinger& finger : scene.fingers) {
    fingers.push_back({{"number", int{finger.finger}},
                       {"name", Visible(finger.name)},
                       {"color", ColorText(FingerColor(finger.finger))}});
  }
  return fingers;
}

Json FailureJson(const ViewerScene& scene) {
  if (!scene.failure) return nullptr;
  const ViewerFailure& failure = *scene.failure;
  Json marks = Json::array();
  for (const ViewerMark& mark : failure.marks) {
    if (!mark.from.allFinite() || !mark.to.allFinite()) continue;
    marks.push_back({{"from", VectorJson(mark.from)},
                     {"to", VectorJson(mark.to)},
                     {"expected", mark.expected},
                     {"text", Visible(mark.text)}});
  }
  return {{"heading", Visible(failure.heading)},
          {"fingers", failure.fingers},
          {"links", failure.links},
          {"marks", marks},
          {"before", failure.X_WO_before ? PoseJson(*failure.X_WO_before) : Json(nullptr)},
          {"beforeText", Visible(failure.ghost_text)}};
}

/// Escape characters that could end a script element or its XML.
std::string EscapeForScript(const std::string& ascii) {
  std::string text;
  text.reserve(ascii.size());
  for (const char c : ascii) {
    switch (c) {
      case '<':
        text += "\\u003c";
        break;
      case '>':
        text += "\\u003e";
        break;
      case '&':
        text += "\\u0026";
        break;
      default:
        text += c;
    }
  }
  return text;
}

/// Move vertices to the mean of their cell. Triangles within two cells disappear.
ShadedMesh MergeCells(const ShadedMesh& mesh, const Vector3d& low, double cell) {
  using Key = std::tuple<int, int, int>;
  struct Cell {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
  };
  const auto key_of = [&](const Vector3d& p) {
    const Vector3d at = (p - low) / cell;
    return Key(static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z()));
  };
  std::map<Key, Cell> cells;
  for (const auto& corners : mesh.triangles) {
    for (const Vector3d& p : corners) {
      Cell& found = cells[key_of(p)];
      found.sum += p;
      ++found.count;
    }
  }
  ShadedMesh merged;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Key, 3> keys;
    std::array<Vector3d, 3> corners;
    for (int i = 0; i < 3; ++i) {
      keys[i] = key_of(mesh.triangles[t][i]);
      const Cell& found = cells[keys[i]];
      corners[i] = found.sum / found.count;
    }
    if (keys[0] == keys[1] || keys[1] == keys[2] || keys[2] == keys[0]) continue;
    merged.Add(corners, mesh.normals[t]);
  }
  return merged;
}

}  // namespace

std::string Base64(std::string_view bytes) {
  // Three bytes become four characters; the encoder adds a zero.
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  text.resize(size);
  return text;
}

std::string ScriptHash(std::string_view script) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  EVP_Digest(script.data(), script.size(), digest.data(), &size, EVP_sha256(), nullptr);
  return "sha256-" + Base64({reinterpret_cast<const char*>(digest.data()), size});
}

ShadedMesh SimplifyForViewer(const ShadedMesh& mesh, int most) {
  if (static_cast<int>(mesh.triangles.size()) <= most) return mesh;
  Eigen::AlignedBox3d box;
  for (const auto& corners : mesh.triangles) {
    for (const Vector3d& p : corners) box.extend(p);
  }
  // A surface that fills its box has a few times cells² triangles.
  ShadedMesh merged;
  for (double cells = 2 * std::sqrt(most); cells >= 2; cells *= 0.8) {
    merged = MergeCells(mesh, box.min(), box.sizes().maxCoeff() / cells);
    if (static_cast<int>(merged.triangles.size()) <= most) break;
  }
  return merged;
}

std::string FormatViewerScene(const ViewerScene& scene) {
  const Json json = {
      {"object", MeshJson(SimplifyForViewer(scene.object, kMostViewerTriangles))},
      {"objectName", Visible(scene.object_name)},
      {"edges", EdgesJson(scene.edges)},
      {"centroid", VectorJson(scene.centroid)},
      {"diameter", Rounded(scene.diameter_m)},
      {"planar", scene.planar},
      {"frictionAngle", Rounded(scene.friction_angle)},
      {"hardFingers", scene.hard_fingers},
      {"fingerRadius",
       scene.finger_radius_m ? Json(Rounded(*scene.finger_radius_m)) : Json(nullptr)},
      {"hand", HandJson(scene)},
      {"fingers", FingersJson(scene)},
      {"steps", StepsJson(scene)},
      {"samples", SamplesJson(scene)},
      {"simulatedTime", scene.simulated_time},
      {"goalTurn", scene.goal_turn ? Json(Rounded(*scene.goal_turn)) : Json(nullptr)},
      {"toEye", VectorJson(scene.to_eye)},
      {"failure", FailureJson(scene)}};
  return EscapeForScript(json.dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace));
}

}  // namespace regrasp::render
