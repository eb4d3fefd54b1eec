#include "apps/batch/inputs_digest.h"

#include <filesystem>

#include "planner/base/error.h"

namespace regrasp::apps {

void InputsDigest::AddText(std::string_view text) {
  sum_.Add(std::to_string(text.size()) + ":");
  sum_.Add(text);
}

InputsDigest& InputsDigest::Add(std::string_view name, std::string_view value) {
  AddText(name);
  AddText(value);
  return *this;
}

InputsDigest& InputsDigest::AddAbsent(std::string_view name) {
  AddText(name);
  sum_.Add("-");
  return *this;
}

InputsDigest& InputsDigest::Add(std::string_view name, const Options& options) {
  Add(name, std::to_string(options.size()));
  for (const auto& [option, values] : options) {
    Add(option, std::to_string(values.size()));
    for (const std::string& value : values) AddText(value);
  }
  return *this;
}

std::string EntryDigest(const std::string& common, const Line& line,
                        const std::optional<ObjectOfLine>& object, ObjectFinder& finder) {
  InputsDigest digest;
  digest.Add("common", common).Add("entry", std::to_string(line.entry));
  digest.Add("line", Sha256(line.text));
  if (!object) return digest.AddAbsent("object").Finish();
  try {
    const std::string path = finder.Find(object->name, object->sha256, line.name);
    const std::string& sha256 = finder.DigestOf(path);
    digest.Add("object", std::filesystem::path(path).filename().string()).Add("sha256", sha256);
  } catch (const InputError&) {
    digest.AddAbsent("object");  // the validation itself reports the error
  }
  return digest.Add("repair", object->repair).Finish();
}

}  // namespace regrasp::apps
