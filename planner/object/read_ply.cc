#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <span>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

static_assert(std::endian::native == std::endian::little, "values are swapped from big to little");

namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct TypeName {
  std::string_view name, other_name;
  Type type;
};
constexpr auto kTypes = std::to_array<TypeName>({{"char", "int8", Type::kInt8},
                                                 {"uchar", "uint8", Type::kUint8},
                                                 {"short", "int16", Type::kInt16},
                                                 {"ushort", "uint16", Type::kUint16},
                                                 {"int", "int32", Type::kInt32},
                                                 {"uint", "uint32", Type::kUint32},
                                                 {"float", "float32", Type::kFloat32},
                                                 {"double", "float64", Type::kFloat64}});

struct Property {
  std::string name;
  Type type = Type::kFloat64;
  std::optional<Type> count_type;  ///< type of a list's length; none if it is not a list
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { kAscii, kLittle, kBig } format = Format::kAscii;
  std::vector<Element> elements;
  std::size_t body = 0;  ///< offset of the values
};

bool IsFloat(Type type) { return type == Type::kFloat32 || type == Type::kFloat64; }

std::string Name(const Element& element, long long index) {
  if (element.name == "face") return "facet " + std::to_string(index);
  return (element.name == "vertex" ? "vertex" : Quoted(element.name)) + " " + std::to_string(index);
}

/// Reader of header lines. The header ends with a line end, directly followed by binary values.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Header Read() {
    if (NextLine() != "ply") Fail("not a PLY file, expected \"ply\"");
    for (;;) {
      if (header_.body >= bytes_.size()) Fail("header: truncated");
      const std::string_view line = NextLine();
      if (line == "end_header") break;
      TextScanner words(line, name_);
      ReadStatement(words);
    }
    if (!has_format_) Fail("format not found");
    return std::move(header_);
  }

 private:
  std::string_view NextLine() {
    ++line_;
    const std::size_t first = header_.body;
    const std::size_t last = std::min(bytes_.find_first_of("\r\n", first), bytes_.size());
    header_.body = std::min(last + 1, bytes_.size());
    if (bytes_.substr(last).starts_with("\r\n")) ++header_.body;
    return bytes_.substr(first, last - first);
  }

  void ReadStatement(TextScanner& words) {
    const std::string keyword(words.Next().value_or("comment"));
    if (keyword == "comment" || keyword == "obj_info") return;
    if (keyword == "format") return ReadFormat(Word(words));
    if (keyword == "element") {
      const std::string name = Word(words);
      const auto count = ParseInteger(Word(words));
      if (!count || *count < 0)
        Fail("element " + Quoted(name) +
             ": the number of elements must be an integer of at least 0");
      header_.elements.push_back({name, *count, {}});
    } else if (keyword == "property") {
      if (header_.elements.empty()) Fail("a property must follow an element");
      ReadProperty(words);
    } else {
      Fail("expected a statement of a PLY header, found " + Quoted(keyword));
    }
  }

  void ReadFormat(const std::string& format) {
    has_format_ = true;
    if (format == "ascii") {
      header_.format = Header::Format::kAscii;
    } else if (format == "binary_little_endian") {
      header_.format = Header::Format::kLittle;
    } else if (format == "binary_big_endian") {
      header_.format = Header::Format::kBig;
    } else {
      Fail("expected format ascii, binary_little_endian or binary_big_endian, found " +
           Quoted(format));
    }
  }

  void ReadProperty(TextScanner& words) {
    Property property;
    std::string type = Word(words);
    if (type == "list") {
      property.count_type = FindType(Word(words));
      if (IsFloat(*property.count_type)) Fail("the length of a list must be an integer");
      type = Word(words);
    }
    property.type = FindType(type);
    property.name = Word(words);
    header_.elements.back().properties.push_back(property);
  }

  Type FindType(const std::string& word) const {
    const auto found = std::ranges::find_if(
        kTypes, [&](const TypeName& type) { return word == type.name || word == type.other_name; });
    if (found == kTypes.end()) Fail("expected a type of PLY, found " + Quoted(word));
    return found->type;
  }

  std::string Word(TextScanner& words) const {
    const auto word = words.Next();
    if (!word) Fail("expected another word, found the end of the line");
    return std::string(*word);
  }

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(name_ + ": line " + std::to_string(line_) + ": " + message);
  }

  std::string_view bytes_;
  const std::string& name_;
  Header header_;
  bool has_format_ = false;
  int line_ = 0;
};

/// Reader of the values after the header, in any of the formats. All types fit into a double.
class ValueReader {
 public:
  ValueReader(std::string_view body, Header::Format format, const std::string& name)
      : body_(body), format_(format), name_(name), words_(body, name) {}

  double Read(Type type, const std::string& what) {
    if (format_ == Header::Format::kAscii) {
      const auto word = words_.Next();
      if (!word) FailAtEnd(what);
      const auto value = ParseDouble(*word);
      if (!value || (!IsFloat(type) && *value != std::floor(*value))) {
        throw InputError(name_ + ": " + what + ": expected " +
                         (IsFloat(type) ? "a finite number" : "an integer") + ", found " +
                         Quoted(*word));
      }
      return *value;
    }
    switch (type) {
      case Type::kInt8:
        return ReadBinary<std::int8_t>(what);
      case Type::kUint8:
        return ReadBinary<std::uint8_t>(what);
      case Type::kInt16:
        return ReadBinary<std::int16_t>(what);
      case Type::kUint16:
        return ReadBinary<std::uint16_t>(what);
      case Type::kInt32:
        return ReadBinary<std::int32_t>(what);
      case Type::kUint32:
        return ReadBinary<std::uint32_t>(what);
      case Type::kFloat32:
        return ReadBinary<float>(what);
      case Type::kFloat64:
        return ReadBinary<double>(what);
    }
    return 0;
  }

  [[nodiscard]] bool AtEnd() {
    return format_ == Header::Format::kAscii ? !words_.Next() : position_ == body_.size();
  }

 private:
  template <class T>
  double ReadBinary(const std::string& what) {
    std::array<char, sizeof(T)> bytes;
    if (body_.size() - position_ < bytes.size()) FailAtEnd(what);
    std::memcpy(bytes.data(), body_.data() + position_, bytes.size());
    position_ += bytes.size();
    if (format_ == Header::Format::kBig) std::ranges::reverse(bytes);
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  [[noreturn]] void FailAtEnd(const std::string& what) const {
    throw InputError(name_ + ": truncated inside " + what);
  }

  std::string_view body_;
  Header::Format format_;
  const std::string& name_;
  TextScanner words_;
  std::size_t position_ = 0;
};

void ReadVertex(ValueReader& values, const Element& element, long long index, PolygonSoup& soup,
                const std::string& name) {
  const std::string what = Name(element, index);
  Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
  for (const Property& property : element.properties) {
    if (property.count_type) throw InputError(name + ": " + what + ": lists not supported");
    const double value = values.Read(property.type, what);
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() != 1 || axis == std::string_view::npos) continue;
    if (!std::isfinite(value)) {
      throw InputError(name + ": " + what + ": coordinates must be finite, found " +
                       FormatDouble(value));
    }
    vertex[static_cast<int>(axis)] = value;
  }
  soup.vertices.push_back(vertex);
}

bool IsVertexIndices(const Property& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Read the length of a list; negative lengths of signed types are rejected.
long long ReadCount(ValueReader& values, const Property& property, const std::string& what,
                    const std::string& name) {
  const double count = values.Read(*property.count_type, what);
  if (count < 0 || count > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(name + ": " + what + ": length of a list not supported, found " +
                     FormatDouble(count));
  }
  return static_cast<long long>(count);
}

/// Read the vertex indices of a polygon or of strips. @param lowest  smallest valid index.
std::vector<int> ReadIndices(ValueReader& values, const Element& element, long long index,
                             int lowest, const std::string& name) {
  const std::string what = Name(element, index);
  std::vector<int> indices;
  for (const Property& property : element.properties) {
    const bool wanted = IsVertexIndices(property);
    const long long count = property.count_type ? ReadCount(values, property, what, name) : 1;
    for (long long k = 0; k < count; ++k) {
      const double value = values.Read(property.type, what);
      if (!wanted) continue;
      if (!(value >= lowest && value <= std::numeric_limits<int>::max())) {
        throw MeshError(MeshDefect::kIndexOutOfRange,
                        name + ": " + what + ": vertex index " + FormatDouble(value) +
                            " must be at least " + std::to_string(lowest) + " and at most " +
                            std::to_string(std::numeric_limits<int>::max()));
      }
      indices.push_back(static_cast<int>(value));
    }
  }
  return indices;
}

constexpr int kStripEnd = -1;

/// Add the triangles of strips.
///
/// Each vertex after the second one makes a triangle with the two vertices before it, and every
/// second triangle is reversed. Triangles with a repeated vertex only connect two parts of a strip.
void AddStrips(std::span<const int> indices, PolygonSoup& soup) {
  std::size_t first = 0;  // start of the current strip
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const int c = indices[k];
    if (c == kStripEnd) first = k + 1;
    if (c == kStripEnd || k < first + 2) continue;
    const int a = indices[k - 2], b = indices[k - 1];
    if (a == b || b == c || c == a) continue;
    const bool turned = (k - first) % 2 == 1;
    soup.facets.push_back(turned ? std::vector{b, a, c} : std::vector{a, b, c});
  }
}

void SkipRow(ValueReader& values, const Element& element, long long index,
             const std::string& name) {
  const std::string what = Name(element, index);
  for (const Property& property : element.properties) {
    const long long count = property.count_type ? ReadCount(values, property, what, name) : 1;
    for (long long k = 0; k < count; ++k) static_cast<void>(values.Read(property.type, what));
  }
}

bool Has(const Element& element, std::string_view property) {
  return std::ranges::find(element.properties, property, &Property::name) !=
         element.properties.end();
}

bool IsSurface(const Element& element) {
  return element.name == "face" || element.name == "tristrips";
}

bool HasFacets(const Element& element) { return IsSurface(element) && element.count > 0; }

/// Return whether an element of an unknown name may contain the surface.
///
/// Candidates are lists of integers and three integers per row. If no other element has polygons,
/// any list or integer is a candidate. The element "camera" describes the scanner of a point cloud.
bool MayBeSurface(const Element& element, bool has_facets) {
  if (element.count == 0 || element.name == "vertex" || IsSurface(element)) return false;
  constexpr std::ptrdiff_t kCorners = 3;
  const auto is_corner = [](const Property& p) { return !IsFloat(p.type) && p.name[0] == 'v'; };
  if (has_facets) {
    const auto is_list = [](const Property& p) { return p.count_type && !IsFloat(p.type); };
    return std::ranges::any_of(element.properties, is_list) ||
           std::ranges::count_if(element.properties, is_corner) >= kCorners;
  }
  const auto may_be_index = [](const Property& p) { return p.count_type || !IsFloat(p.type); };
  return element.name != "camera" && std::ranges::any_of(element.properties, may_be_index);
}

/// Check an element. Rejecting elements without properties also avoids a loop over a huge declared
/// number of rows that reads no byte.
void CheckElement(const Element& element, const std::string& name) {
  const std::string what = name + ": element " + Quoted(element.name);
  if (element.properties.empty() && element.count > 0)
    throw InputError(what + ": expected at least one property");
  std::set<std::string> names;
  for (const Property& property : element.properties) {
    if (!names.insert(property.name).second) {
      throw InputError(what + ": property " + Quoted(property.name) + ": must be unique");
    }
  }
  if (element.name == "vertex" && !(Has(element, "x") && Has(element, "y") && Has(element, "z"))) {
    throw InputError(what + ": requires the properties x, y and z");
  }
  if (!IsSurface(element)) return;
  const auto indices = std::ranges::find_if(element.properties, IsVertexIndices);
  if (indices == element.properties.end() || IsFloat(indices->type)) {
    throw InputError(what + ": requires an integer list vertex_indices");
  }
  if (std::ranges::count_if(element.properties, IsVertexIndices) > 1) {
    throw InputError(what + ": expected one list of vertex indices, found two");
  }
}

void CheckElements(const std::vector<Element>& elements, const std::string& name) {
  const bool has_facets = std::ranges::any_of(elements, HasFacets);
  std::set<std::string> names;
  for (const Element& element : elements) {
    if (!names.insert(element.name).second) {
      throw InputError(name + ": element " + Quoted(element.name) + ": must be unique");
    }
    CheckElement(element, name);
    if (MayBeSurface(element, has_facets)) {
      throw InputError(name + ": element " + Quoted(element.name) +
                       ": not supported, expected the surface in \"face\" or \"tristrips\"");
    }
  }
}

}  // namespace

PolygonSoup ReadPly(std::string_view bytes, const std::string& name) {
  bytes = TextOf(bytes, name);
  const Header header = HeaderReader(bytes, name).Read();
  CheckElements(header.elements, name);
  PolygonSoup soup;
  ValueReader values(bytes.substr(header.body), header.format, name);
  for (const Element& element : header.elements) {
    for (long long i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        ReadVertex(values, element, i, soup, name);
      } else if (element.name == "face") {
        soup.facets.push_back(ReadIndices(values, element, i, 0, name));
      } else if (element.name == "tristrips") {
        AddStrips(ReadIndices(values, element, i, kStripEnd, name), soup);
      } else {
        SkipRow(values, element, i, name);
      }
    }
  }
  if (!values.AtEnd()) throw InputError(name + ": unexpected data after the last element");
  if (soup.facets.empty() && std::ranges::any_of(header.elements, HasFacets)) {
    throw InputError(name + ": element \"tristrips\": expected at least one triangle");
  }
  return soup;
}

}  // namespace regrasp::object
