#include "apps/converted_grasps.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "planner/base/error.h"

namespace regrasp::apps {

namespace {

constexpr char kConvert[] = "regrasp-convert";
constexpr std::array<std::string_view, 8> kThirdPartySuffixes = {".npy", ".npz", ".yaml", ".yml",
                                                                 ".xml", ".h5",  ".hdf5", ".json"};
/// Exit code of a child that cannot execute the program, as of shells.
constexpr int kNotFound = 127;

/// Return the program in the folder of this one, or its name, which is searched in PATH.
std::string ConvertProgram() {
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return kConvert;
  const std::filesystem::path neighbour = own.parent_path() / kConvert;
  return std::filesystem::exists(neighbour, error) ? neighbour.string() : kConvert;
}

}  // namespace

bool NeedsConversion(const std::string& grasps) {
  std::error_code error;
  if (std::filesystem::is_directory(grasps, error)) return true;
  std::string suffix = std::filesystem::path(grasps).extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a')
                                          : static_cast<char>(letter);
  });
  return std::ranges::find(kThirdPartySuffixes, suffix) != kThirdPartySuffixes.end();
}

int ConvertGrasps(const GraspSource& source, const std::string& output) {
  std::vector<std::string> words = {ConvertProgram(), "--hand=" + source.hand,
                                    "--output=" + output};
  if (!source.palm.empty()) words.push_back("--palm=" + source.palm);
  std::error_code error;
  if (std::filesystem::is_regular_file(source.object, error)) {
    words.push_back("--object=" + source.object);
  }
  words.insert(words.end(), {"--", source.grasps});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw EnvironmentError(std::string(kConvert) + ": " + std::strerror(errno));
  if (child == 0) {
    execvp(arguments[0], arguments.data());
    _exit(kNotFound);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw EnvironmentError(std::string(kConvert) + ": " + std::strerror(errno));
  }
  if (!WIFEXITED(status)) throw EnvironmentError(std::string(kConvert) + ": killed by a signal");
  if (WEXITSTATUS(status) == kNotFound) {
    throw EnvironmentError("--grasps " + source.grasps +
                           ": requires regrasp-convert, not found; "
                           "help: install python3-regrasp");
  }
  return WEXITSTATUS(status);
}

}  // namespace regrasp::apps
