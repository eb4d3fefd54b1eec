#include "planner/object/package_3mf.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/text_scanner.h"
#include "planner/object/xml_scan.h"

namespace regrasp::object {

namespace {

constexpr const char* kRelationships = "_rels/.rels";
constexpr std::string_view kModelType =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// Decode percent-encoded characters such as "%20".
std::string PercentDecoded(std::string_view text) {
  std::string decoded;
  while (!text.empty()) {
    unsigned char code = 0;
    const char* digits = text.data() + 1;
    const bool escaped = text.size() >= 3 && text[0] == '%' &&
                         std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    decoded += escaped ? static_cast<char>(code) : text[0];
    text.remove_prefix(escaped ? 3 : 1);
  }
  return decoded;
}

}  // namespace

std::string Package3mf::PartName(std::string_view target) {
  const std::string absolute = "/" + std::string(target);
  return std::filesystem::path(absolute).lexically_normal().relative_path().string();
}

std::string Package3mf::RootModel() {
  const std::string text = Read(kRelationships);
  std::optional<std::string> root;
  ScanXml(text, kRelationships, [&](const XmlTag& tag) {
    if (tag.name() != "Relationship" || tag.Find("Type") != kModelType) return;
    if (tag.Find("TargetMode") == "External") throw InputError("the model is outside the package");
    if (root) throw InputError("several relationships to a model, expected one");
    root = PartName(tag.Text("Target"));
  });
  if (!root) throw InputError(std::string(kRelationships) + ": no relationship to a model");
  return *root;
}

std::string Package3mf::Read(const std::string& part) {
  // Part names are not case-sensitive.
  for (const std::string& name : {part, PercentDecoded(part)}) {
    const auto is_it = [&](const std::string& entry) {
      return LowerCase(PartName(entry)) == LowerCase(name);
    };
    const std::vector<std::string> entries = archive_.names();
    const auto found = std::ranges::find_if(entries, is_it);
    if (found == entries.end()) continue;
    if (std::ranges::count_if(entries, is_it) > 1) {
      throw InputError(part + ": the archive has several files of this name");
    }
    if (auto text = archive_.Read(*found, kMaxInputBytes)) return *std::move(text);
  }
  throw InputError("the archive has no " + part);
}

}  // namespace regrasp::object
