// Run a corpus and a fixed number of its mutations through a fuzz target, the same on every
// machine. This is a fuzzer without coverage feedback and without randomness between runs.

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "hostile_input.h"
#include "mutation.h"
#include "planner/base/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace regrasp;

constexpr std::uint64_t kSeed = 7;

/// Time limit, s, after which an alarm ends the program: the slowest inputs take tenths of a second
/// under the sanitizers.
constexpr unsigned int kHang_s = 120;

std::vector<std::string> ReadCorpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry);
  std::ranges::sort(files);
  std::vector<std::string> inputs;
  for (const auto& file : files) inputs.push_back(ReadFile(file));
  return inputs;
}

/// Run the target on an input that is stored in a file meanwhile, so that it remains if the program
/// ends.
/// @returns true if a reader accepted it.
bool Run(const std::string& input, const std::filesystem::path& finding) {
  WriteFile(finding, input);
  const int read_before = TallyOfHostileInputs().read;
  alarm(kHang_s);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  alarm(0);
  return TallyOfHostileInputs().read > read_before;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: " << argv[0] << " CORPUS MUTATIONS FILE-FOR-A-FINDING\n";
    return 2;
  }
  const std::vector<std::string> inputs = ReadCorpus(argv[1]);
  const int mutations = std::atoi(argv[2]);
  const std::filesystem::path finding = argv[3];
  std::cout << "An input that ends the program is left in " << finding << std::endl;
  // Mutations of accepted inputs reach more code; those of rejected ones are usually rejected
  // again.
  std::vector<std::string> good;
  for (const std::string& input : inputs) {
    if (Run(input, finding)) good.push_back(input);
  }
  if (good.empty()) {
    std::cerr << "no input of the corpus is read\n";
    return 1;
  }
  std::mt19937_64 random(kSeed);
  for (int k = 0; k < mutations; ++k) {
    Run(Mutate(good[random() % good.size()], inputs, random), finding);
  }
  std::filesystem::remove(finding);
  const HostileTally tally = TallyOfHostileInputs();
  std::cout << inputs.size() << " inputs, " << mutations << " mutations: " << tally.read
            << " read, " << tally.refused << " refused\n";
  if (tally.read == 0 || tally.refused == 0) {
    std::cerr << "inputs of one kind only: nothing was tested\n";
    return 1;
  }
  return 0;
}
