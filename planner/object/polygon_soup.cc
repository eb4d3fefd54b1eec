#include "planner/object/polygon_soup.h"

#include <cstdint>
#include <cstring>

namespace regrasp::object {

namespace {

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
bool Take(std::string_view& bytes, T& value) {
  if (bytes.size() < sizeof value) return false;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return true;
}

void AppendText(std::string& bytes, const std::string& text) {
  Append(bytes, std::uint64_t{text.size()});
  bytes += text;
}

bool TakeText(std::string_view& bytes, std::string& text) {
  std::uint64_t size = 0;
  if (!Take(bytes, size) || bytes.size() < size) return false;
  text = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return true;
}

bool TakeVertices(std::string_view& bytes, PolygonSoup& soup) {
  std::uint64_t count = 0;
  if (!Take(bytes, count)) return false;
  for (std::uint64_t v = 0; v < count; ++v) {
    for (double& x : soup.vertices.emplace_back()) {
      if (!Take(bytes, x)) return false;
    }
  }
  return true;
}

bool TakeFacets(std::string_view& bytes, PolygonSoup& soup) {
  std::uint64_t count = 0;
  if (!Take(bytes, count)) return false;
  for (std::uint64_t f = 0; f < count; ++f) {
    std::uint64_t corners = 0;
    if (!Take(bytes, corners)) return false;
    std::vector<int>& facet = soup.facets.emplace_back();
    for (std::uint64_t k = 0; k < corners; ++k) {
      if (!Take(bytes, facet.emplace_back())) return false;
    }
  }
  return true;
}

}  // namespace

std::string SoupToBytes(const PolygonSoup& soup) {
  std::string bytes;
  AppendText(bytes, soup.unit);
  Append(bytes, std::uint64_t{soup.vertices.size()});
  for (const auto& vertex : soup.vertices) {
    for (const double x : vertex) Append(bytes, x);
  }
  Append(bytes, std::uint64_t{soup.facets.size()});
  for (const auto& facet : soup.facets) {
    Append(bytes, std::uint64_t{facet.size()});
    for (const int index : facet) Append(bytes, index);
  }
  return bytes;
}

std::optional<PolygonSoup> SoupFromBytes(std::string_view bytes) {
  PolygonSoup soup;
  if (!TakeText(bytes, soup.unit) || !TakeVertices(bytes, soup) || !TakeFacets(bytes, soup) ||
      !bytes.empty()) {
    return std::nullopt;
  }
  return soup;
}

}  // namespace regrasp::object
