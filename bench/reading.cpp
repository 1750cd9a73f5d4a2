// What reading a large dataset costs: the text, its statements, the model whose every argument is checked, and beside
// that the system of equations; time of the processor, and memory as a multiple of the size of the text.
//
//     reading dense 100         100 MB, of any kind that large_dataset.h has
//     reading exported 100 FILE writes the dataset only, for `dynalin check FILE`
#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "base/read_file.h"
#include "elements/catalogue.h"
#include "large_dataset.h"
#include "peak_memory.h"
#include "system/system.h"

namespace {

using namespace dynalin;

class Steps {
 public:
  explicit Steps(std::size_t bytes) : megabytes_(static_cast<double>(bytes) / 1e6) {}
  void done(const char* step) {
    const std::clock_t now = std::clock();
    const double seconds = static_cast<double>(now - last_) / CLOCKS_PER_SEC;
    last_ = now, sum_ += seconds;
    print(step, seconds);
  }
  void so_far(const char* what) const { print(what, sum_); }

 private:
  void print(const char* what, double seconds) const {
    fmt::print("{:<12} {:8.2f} s {:8.1f} MB/s {:8.2f} times the text\n", what, seconds, megabytes_ / seconds,
               peak_megabytes() * 1024 * 1024 / 1e6 / megabytes_);
  }

  double megabytes_, sum_ = 0;
  std::clock_t last_ = std::clock();
};

int measure(const std::string& file) {
  auto read = read_file(file);
  if (!read) return fmt::print(stderr, "{}: {}\n", file, read.error()), 1;
  Steps steps(read->size());
  const auto source = std::make_shared<const SourceText>(file, std::move(*read));
  steps.done("text");
  auto parsed = parse_dataset(source);
  const auto dataset = std::make_shared<Dataset>(std::move(parsed.value));
  steps.done("statements");
  auto built = build_model(dataset, catalogue(), {.read_once = dataset});  // as the program reads
  if (parsed.diagnostics.has_errors() || built.diagnostics.has_errors()) {
    fmt::print(stderr, "{}{}", render(parsed.diagnostics, 3), render(built.diagnostics, 3));
    return 1;
  }
  dataset->release_arguments();
  steps.done("model");
  steps.so_far("read");
  const auto system = System::make(std::move(built.value));
  steps.done("system");
  steps.so_far("together");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const auto kind = argc > 2 ? LargeDataset::kind_called(argv[1]) : std::nullopt;
  if (!kind) {
    fmt::print(stderr, "usage: reading {} MEGABYTES [FILE]\n", fmt::join(LargeDataset::names, "|"));
    return 3;
  }
  const std::string file = argc > 3 ? argv[3] : "reading.adm";
  std::ofstream(file, std::ios::binary)
      << LargeDataset(*kind, static_cast<std::size_t>(1e6 * std::stod(argv[2]))).take();
  if (argc > 3) return 0;
  const int status = measure(file);
  std::remove(file.c_str());
  return status;
}
