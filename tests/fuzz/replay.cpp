// The main of a fuzz target without libFuzzer: runs it on files, and on all files of folders. An input that takes
// longer than the fuzzer allows is a finding here as well.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "target.h"

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double longest = 10;  // seconds

bool replay(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string bytes = text.str();
  std::fprintf(stderr, "%s\n", file.c_str());  // the last one is the culprit
  const Clock::time_point begin = Clock::now();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const std::chrono::duration<double> elapsed = Clock::now() - begin;
  if (elapsed.count() <= longest) return true;
  std::fprintf(stderr, "took %.1f s\n", elapsed.count());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fs::path> files;
  for (int k = 1; k < argc; ++k) {
    if (fs::is_directory(argv[k])) {
      for (const auto& entry : fs::directory_iterator(argv[k])) files.push_back(entry.path());
    } else if (fs::exists(argv[k])) {
      files.emplace_back(argv[k]);
    } else {
      std::fprintf(stderr, "there is no %s\n", argv[k]);
      return 1;
    }
  }
  std::sort(files.begin(), files.end());
  bool quick = true;
  for (const fs::path& file : files) quick = replay(file) && quick;
  std::printf("%zu inputs\n", files.size());
  return quick && !files.empty() ? 0 : 1;
}
