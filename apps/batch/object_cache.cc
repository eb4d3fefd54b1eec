#include "apps/batch/object_cache.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::apps {

namespace fs = std::filesystem;

SharedObject ObjectCache::Get(const std::string& key,
                              const std::function<object::ObjectFile()>& read) {
  auto place = std::ranges::find(places_, key, &Place::key);
  if (place == places_.end()) {
    Place taken{key, nullptr, ""};
    try {
      taken.object = std::make_shared<const object::ObjectFile>(read());
    } catch (const InputError& error) {
      taken.why = error.what();
    }
    if (places_.size() >= kMost) places_.pop_back();
    places_.push_front(std::move(taken));
  } else {
    places_.splice(places_.begin(), places_, place);
  }
  const Place& found = places_.front();
  if (!found.object) throw InputError(found.why);
  return found.object;
}

ObjectFinder::ObjectFinder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  is_folder_ = fs::is_directory(path_, error);
}

std::string ObjectFinder::Find(const std::string& name, const std::string& sha256,
                               const std::string& where) {
  if (!is_folder_) return path_;
  // Use only the file name, because a line must not reference files outside the folder.
  const fs::path file = fs::path(name).filename();
  const std::string path = (path_ / file).string();
  std::error_code error;
  const bool there = !file.empty() && fs::is_regular_file(path, error);
  if (there && (sha256.empty() || DigestOf(path) == sha256)) return path;
  const std::string other = sha256.empty() ? "" : FindByDigest(sha256);
  if (!other.empty()) return other;
  if (there) return path;
  throw InputError(where + ": /object/file: \"" + file.string() + "\" not found in " + path_ +
                   (sha256.empty() ? "" : ", nor a file with the digest " + sha256));
}

const std::string& ObjectFinder::DigestOf(const std::string& file) {
  const auto known = digests_.find(file);
  if (known != digests_.end()) return known->second;
  return digests_[file] = Sha256(ReadFile(file));
}

std::string ObjectFinder::FindByDigest(const std::string& sha256) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(path_, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file(error)) files.push_back(entry->path().string());
  }
  // Among files with the same bytes, always select the same one.
  std::ranges::sort(files);
  const auto found = std::ranges::find_if(
      files, [&](const std::string& file) { return DigestOf(file) == sha256; });
  return found == files.end() ? "" : *found;
}

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
