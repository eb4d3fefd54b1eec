#include "apps/hand_grasp_end.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "planner/base/error.h"
#include "planner/base/json.h"

namespace regrasp::apps {
namespace {

constexpr char kHandGraspFormat[] = "regrasp-hand-grasp";

bool IsFile(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

/// Return the name of a grasp; empty if the line has none.
std::string IdOf(const Json& line) {
  if (!line.is_object() || !line.contains("id") || !line["id"].is_string()) return "";
  return line["id"].get<std::string>();
}

}  // namespace

std::string FileOfEnd(const std::string& value) {
  if (IsFile(value)) return value;
  for (std::size_t colon = value.find(':'); colon != std::string::npos;
       colon = value.find(':', colon + 1)) {
    if (IsFile(value.substr(0, colon))) return value.substr(0, colon);
  }
  return value;
}

bool IsHandGrasp(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_object() && json.value("format", Json()) == kHandGraspFormat;
}

std::optional<NamedHandGrasp> FindHandGrasp(const std::string& option, const std::string& value) {
  const std::string path = FileOfEnd(value);
  if (!IsFile(path)) return std::nullopt;
  const bool is_named = path.size() < value.size();
  const std::string id = is_named ? value.substr(path.size() + 1) : "";
  std::ifstream file(path);
  std::string line;
  std::string found;
  int found_line = 0;
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1 && !IsHandGrasp(line)) return std::nullopt;
    // Other grasps need not be valid, and large files are searched without parsing all lines.
    const bool may_match =
        is_named ? line.find(id) != std::string::npos || line.find('\\') != std::string::npos
                 : line.find_first_not_of(" \t\r") != std::string::npos;
    if (!may_match) continue;
    if (is_named && IdOf(Json::parse(line, nullptr, false)) != id) continue;
    if (found_line > 0) {
      const std::string what = is_named ? " grasps with the name " + id : " grasps";
      throw InputError(option + ": " + path + ": expected FILE:NAME of one grasp, found several" +
                       what);
    }
    found = line;
    found_line = number;
  }
  if (found_line == 0) {
    throw InputError(option + ": " + path + ": grasp " + id + " not found");
  }
  const std::string name = path + ": line " + std::to_string(found_line);
  return NamedHandGrasp{sim::ParseHandGrasp(found, name), name};
}

}  // namespace regrasp::apps
