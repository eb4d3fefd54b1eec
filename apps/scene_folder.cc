#include "apps/scene_folder.h"

#include <filesystem>
#include <system_error>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::apps {

void WriteSceneFolder(const std::string& folder, const std::vector<sim::SceneFile>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder + ": cannot be made: " + error.message());
  for (const sim::SceneFile& file : files) {
    WriteFile(std::filesystem::path(folder) / file.name, file.bytes);
  }
}

}  // namespace regrasp::apps
