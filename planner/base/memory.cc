#include "planner/base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include "planner/base/number.h"

namespace regrasp {

namespace {

/// Usable share of the memory. The other half is for the system, other programs and other data of
/// the process.
constexpr double kUsableShare = 0.5;

/// Files with the memory limit of the control group, in version 2 and version 1 of the kernel's
/// interface. Without a limit, version 2 has "max", and version 1 a number larger than any memory.
constexpr std::array kGroupLimits = {"/sys/fs/cgroup/memory.max",
                                     "/sys/fs/cgroup/memory/memory.limit_in_bytes"};

}  // namespace

double UsableMemory() {
  double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
  for (const char* path : kGroupLimits) {
    double of_group = 0;
    if (std::ifstream(path) >> of_group) bytes = std::min(bytes, of_group);
  }
  return kUsableShare * bytes;
}

std::string FormatBytes(double bytes) {
  constexpr auto kUnits = std::to_array<std::pair<double, const char*>>(
      {{1e12, " TB"}, {1e9, " GB"}, {1e6, " MB"}, {1e3, " kB"}});
  for (const auto& [unit, name] : kUnits) {
    if (bytes >= unit) return FormatShort(bytes / unit, 3) + name;
  }
  return FormatShort(bytes, 3) + " bytes";
}

std::string MemoryComplaint(const MemoryNeed& need, double limit) {
  if (need.bytes() <= limit) return "";
  int fitting = 0;
  for (int step = need.count; step > 0; step /= 2) {
    while (need.bytes_for(fitting + step) <= limit) fitting += step;
  }
  return need.what + ": " + std::to_string(need.count) + " " + need.units + " require about " +
         FormatBytes(need.bytes()) + ", limit " + FormatBytes(limit) +
         " (half of the memory); about " + std::to_string(fitting) + " " + need.units + " fit";
}

}  // namespace regrasp
