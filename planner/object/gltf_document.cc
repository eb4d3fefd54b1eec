#include "planner/object/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/text_scanner.h"
#include "planner/object/weld.h"

namespace regrasp::object {

namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr long long kMostElements = 3 * static_cast<long long>(kMaxFacets);

/// Codes of component types in glTF.
enum ComponentType : long long {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};

template <class T>
T TakeNumber(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Return the size in bytes of a component type; 0 for an unknown code.
std::size_t SizeOf(long long type) {
  if (type == kByte || type == kUnsignedByte) return 1;
  if (type == kShort || type == kUnsignedShort) return 2;
  return type == kUnsignedInt || type == kFloat ? 4 : 0;
}

double ReadComponent(const char* at, long long type, bool normalized) {
  switch (type) {
    case kByte: {
      const auto value = TakeNumber<std::int8_t>(at);
      return normalized ? std::max(value / 127.0, -1.0) : value;
    }
    case kUnsignedByte:
      return TakeNumber<std::uint8_t>(at) / (normalized ? 255.0 : 1.0);
    case kShort: {
      const auto value = TakeNumber<std::int16_t>(at);
      return normalized ? std::max(value / 32767.0, -1.0) : value;
    }
    case kUnsignedShort:
      return TakeNumber<std::uint16_t>(at) / (normalized ? 65535.0 : 1.0);
    case kUnsignedInt:
      return TakeNumber<std::uint32_t>(at);
    default:
      return TakeNumber<float>(at);
  }
}

int Base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::string> DecodeBase64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  unsigned int bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = Base64Digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<unsigned int>(digit)) & 0xFFFFFF;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

}  // namespace

std::optional<GltfValue> GltfValue::Find(const std::string& key) const {
  if (!json_->is_object()) Fail("expected an object, found " + std::string(json_->type_name()));
  const auto found = json_->find(key);
  if (found == json_->end()) return std::nullopt;
  return GltfValue(*found, pointer_ + "/" + key);
}

GltfValue GltfValue::Member(const std::string& key) const {
  if (auto value = Find(key)) return *value;
  Fail("member \"" + key + "\" not found");
}

std::vector<GltfValue> GltfValue::Items(const std::string& key) const {
  std::vector<GltfValue> items;
  const auto array = Find(key);
  if (!array) return items;
  if (!array->json_->is_array()) array->Fail("expected an array");
  for (const Json& item : *array->json_) {
    items.emplace_back(item, array->pointer_ + "/" + std::to_string(items.size()));
  }
  return items;
}

GltfValue GltfValue::Item(const std::string& key, long long index) const {
  const auto array = Find(key);
  const long long size = array && array->json_->is_array() ? std::ssize(*array->json_) : 0;
  if (index < 0 || index >= size) {
    throw InputError("/" + key + ": index " + std::to_string(index) +
                     " must be at least 0 and less than " + std::to_string(size) +
                     ", the number of elements");
  }
  return {(*array->json_)[static_cast<std::size_t>(index)],
          array->pointer_ + "/" + std::to_string(index)};
}

std::optional<std::vector<double>> GltfValue::Numbers(const std::string& key,
                                                      std::size_t size) const {
  if (!Find(key)) return std::nullopt;
  std::vector<double> numbers;
  for (const GltfValue& item : Items(key)) numbers.push_back(item.Number());
  if (numbers.size() == size) return numbers;
  Member(key).Fail("expected " + std::to_string(size) + " numbers, found " +
                   std::to_string(numbers.size()));
}

long long GltfValue::Count() const {
  constexpr double kMost = 1e15;
  const double value = Number();
  if (value < 0 || value > kMost || value != std::floor(value)) {
    Fail("expected a count, found " + FormatDouble(value));
  }
  return static_cast<long long>(value);
}

long long GltfValue::CountOr(const std::string& key, long long otherwise) const {
  const auto value = Find(key);
  return value ? value->Count() : otherwise;
}

double GltfValue::Number() const {
  if (!json_->is_number()) Fail("expected a number, found " + std::string(json_->type_name()));
  return json_->get<double>();
}

std::string GltfValue::Text() const {
  if (!json_->is_string()) Fail("expected a string, found " + std::string(json_->type_name()));
  return json_->get<std::string>();
}

std::vector<std::string> GltfValue::Keys() const {
  std::vector<std::string> keys;
  if (!json_->is_object()) Fail("expected an object, found " + std::string(json_->type_name()));
  for (const auto& item : json_->items()) keys.push_back(item.key());
  return keys;
}

void GltfValue::Fail(const std::string& problem) const {
  throw InputError((pointer_.empty() ? "" : pointer_ + ": ") + problem);
}

GltfDocument::GltfDocument(std::string_view bytes) {
  ReadContainer(bytes);
  const std::string version = root().Member("asset").Member("version").Text();
  const auto least = root().Member("asset").Find("minVersion");
  if (!version.starts_with("2.") || (least && least->Text() != "2.0")) {
    throw InputError("/asset/version: not supported, expected \"2.0\", found " + Quoted(version));
  }
  for (const GltfValue& used : root().Items("extensionsUsed")) {
    quantized_ = quantized_ || used.Text() == "KHR_mesh_quantization";
  }
}

void GltfDocument::ReadContainer(std::string_view bytes) {
  if (!bytes.starts_with(kMagic)) {
    json_ = ParseJson(bytes, "document");
    return;
  }
  if (bytes.size() < kGlbHeader) throw InputError("header: truncated");
  const auto version = TakeNumber<std::uint32_t>(bytes.data() + 4);
  const auto length = TakeNumber<std::uint32_t>(bytes.data() + 8);
  if (version != 2)
    throw InputError("header: version: expected 2, found " + std::to_string(version));
  if (length != bytes.size()) {
    throw InputError("header: length: expected " + std::to_string(bytes.size()) + " bytes, found " +
                     std::to_string(length));
  }
  std::optional<std::string_view> document;
  for (std::size_t at = kGlbHeader; at < bytes.size();) {
    const std::size_t left = bytes.size() - at;
    const std::size_t size = left < kChunkHeader ? left : TakeNumber<std::uint32_t>(&bytes[at]);
    if (left < kChunkHeader || size > left - kChunkHeader) {
      throw InputError("chunk: truncated");
    }
    const auto type = TakeNumber<std::uint32_t>(&bytes[at + 4]);
    const std::string_view chunk = bytes.substr(at + kChunkHeader, size);
    if (type == kJsonChunk && !document) document = chunk;
    if (type == kBinaryChunk && binary_.empty()) binary_ = chunk;
    at += kChunkHeader + size;
  }
  if (!document) throw InputError("header: JSON chunk not found");
  json_ = ParseJson(*document, "JSON chunk");
}

std::string_view GltfDocument::Buffer(long long index) {
  const GltfValue buffer = root().Item("buffers", index);
  const auto uri = buffer.Find("uri");
  if (!uri) {
    if (index == 0 && !binary_.empty()) return binary_;
    buffer.Fail("data not found");
  }
  const auto [place, is_new] = decoded_.try_emplace(index);
  if (!is_new) return place->second;
  const std::string text = uri->Text();
  constexpr std::string_view kEncoding = ";base64,";
  const std::size_t comma = text.find(kEncoding);
  if (!text.starts_with("data:") || comma == std::string::npos) {
    throw InputError("surface in another file, " + Quoted(text) +
                     ": not supported; help: convert the object to .glb or .ply");
  }
  auto bytes = DecodeBase64(std::string_view(text).substr(comma + kEncoding.size()));
  if (!bytes) uri->Fail("must be base64");
  return place->second = *std::move(bytes);
}

std::vector<double> GltfDocument::ReadView(const GltfValue& user, const Layout& layout) {
  const GltfValue view = root().Item("bufferViews", user.Member("bufferView").Count());
  if (const auto extensions = view.Find("extensions")) {
    for (const std::string& name : extensions->Keys()) {
      if (name.ends_with("meshopt_compression")) {
        extensions->Fail("extension " + Quoted(name) + " is not supported");
      }
    }
  }
  const std::string_view buffer = Buffer(view.Member("buffer").Count());
  const auto begin = static_cast<std::size_t>(view.CountOr("byteOffset", 0));
  const auto size = static_cast<std::size_t>(view.Member("byteLength").Count());
  if (begin > buffer.size() || size > buffer.size() - begin) {
    view.Fail("byteOffset + byteLength: expected at most " + std::to_string(buffer.size()) +
              " bytes, the size of the buffer, found " + std::to_string(begin + size));
  }
  const std::size_t component = SizeOf(layout.component_type);
  const std::size_t row = component * static_cast<std::size_t>(layout.components);
  const auto stride =
      static_cast<std::size_t>(view.CountOr("byteStride", static_cast<long long>(row)));
  const auto first = static_cast<std::size_t>(user.CountOr("byteOffset", 0));
  const auto count = static_cast<std::size_t>(layout.count);
  if (stride < row)
    view.Fail("byteStride: must be at least " + std::to_string(row) +
              ", the size of an element, found " + std::to_string(stride));
  const bool fits = count == 0 || (first <= size && row <= size - first &&
                                   (size - first - row) / stride >= count - 1);
  if (!fits) {
    user.Fail(std::to_string(count) + " elements with a stride of " + std::to_string(stride) +
              " bytes from byteOffset " + std::to_string(first) + " require more than the " +
              std::to_string(size) + " bytes of the buffer view");
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    const char* at = buffer.data() + begin + first + k * stride;
    for (long long c = 0; c < layout.components; ++c, at += component) {
      values.push_back(ReadComponent(at, layout.component_type, layout.normalized));
    }
  }
  return values;
}

void GltfDocument::ApplySparse(const GltfValue& sparse, const Layout& layout,
                               std::vector<double>& values) {
  Layout part = layout;
  part.count = sparse.Member("count").Count();
  if (part.count > layout.count)
    sparse.Fail("count: expected at most " + std::to_string(layout.count) + ", found " +
                std::to_string(part.count));
  const GltfValue index = sparse.Member("indices");
  const long long type = index.Member("componentType").Count();
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt) {
    index.Fail("componentType: expected an unsigned integer, found " + std::to_string(type));
  }
  const std::vector<double> places = ReadView(index, {type, false, 1, part.count});
  const std::vector<double> replaced = ReadView(sparse.Member("values"), part);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] >= static_cast<double>(layout.count)) {
      index.Fail("index " + FormatDouble(places[k]) + " must be less than " +
                 std::to_string(layout.count) + ", the number of elements");
    }
    const auto row = static_cast<std::size_t>(layout.components);
    std::copy_n(replaced.begin() + static_cast<std::ptrdiff_t>(k * row), row,
                values.begin() + static_cast<std::ptrdiff_t>(places[k]) * layout.components);
  }
}

std::vector<double> GltfDocument::ReadAccessor(const GltfValue& accessor, const Layout& layout) {
  if (layout.count > kMostElements) accessor.Fail("too large, limit 3000000 elements");
  std::vector<double> values;
  if (accessor.Find("bufferView")) {
    values = ReadView(accessor, layout);
  } else {
    values.resize(static_cast<std::size_t>(layout.count * layout.components));
  }
  if (const auto sparse = accessor.Find("sparse")) ApplySparse(*sparse, layout, values);
  return values;
}

std::vector<Eigen::Vector3d> GltfDocument::Positions(long long index) {
  const GltfValue accessor = root().Item("accessors", index);
  const std::string type = accessor.Member("type").Text();
  if (type != "VEC3") accessor.Fail("type: expected \"VEC3\", found " + Quoted(type));
  const GltfValue component = accessor.Member("componentType");
  const auto normalized = accessor.Find("normalized");
  const Layout layout{component.Count(), normalized && normalized->IsTrue(), 3,
                      accessor.Member("count").Count()};
  const bool allowed =
      layout.component_type == kFloat ||
      (quantized_ && SizeOf(layout.component_type) > 0 && layout.component_type != kUnsignedInt);
  if (!allowed) {
    component.Fail("expected 5126 (float), found " + std::to_string(layout.component_type));
  }
  const std::vector<double> values = ReadAccessor(accessor, layout);
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t k = 0; k < values.size(); k += 3) {
    positions.emplace_back(values[k], values[k + 1], values[k + 2]);
    if (!positions.back().allFinite()) {
      accessor.Fail("vertex " + std::to_string(k / 3) + ": coordinates must be finite");
    }
  }
  return positions;
}

std::vector<long long> GltfDocument::Indices(long long index) {
  const GltfValue accessor = root().Item("accessors", index);
  const Layout layout{accessor.Member("componentType").Count(), false, 1,
                      accessor.Member("count").Count()};
  if (accessor.Member("type").Text() != "SCALAR" ||
      (layout.component_type != kUnsignedByte && layout.component_type != kUnsignedShort &&
       layout.component_type != kUnsignedInt)) {
    accessor.Fail("expected unsigned integers");
  }
  const std::vector<double> values = ReadAccessor(accessor, layout);
  return {values.begin(), values.end()};
}

}  // namespace regrasp::object
