// What reading a large dataset costs: the text, its statements, the model, the system of equations; time of the
// processor, and memory as a multiple of the size of the text.
//
//     reading exported 100      100 MB as pre-processors write it: an argument a line, banners, names in comments
//     reading dense 100         100 MB by hand: a statement a line, no comments
//     reading exported 100 FILE writes the dataset only, for `dynalin check FILE`
#include <fmt/format.h>

#include <cstring>
#include <ctime>
#include <fstream>
#include <random>

#include "base/read_file.h"
#include "elements/catalogue.h"
#include "peak_memory.h"
#include "system/system.h"

namespace {

using namespace dynalin;

// A row of parts, neighbours joined by a bushing and a force, each with markers, a request and a graphic.
class Text {
 public:
  Text(bool dense, std::size_t size) : dense_(dense) {
    text_.reserve(size + 4096);
    text_ += "large\n";
    statement("UNITS", "", {"FORCE=NEWTON", "MASS=KILOGRAM", "LENGTH=MILLIMETER", "TIME=SECOND"});
    statement("PART", "1", {"GROUND"});
    statement("MARKER", "1", {"PART=1"});
    for (int k = 2; text_.size() < size; ++k) part(k);
    text_ += "END\n";
  }
  std::string take() { return std::move(text_); }

 private:
  void statement(const std::string& name, const std::string& id, std::initializer_list<std::string> arguments) {
    if (!dense_) fmt::format_to(std::back_inserter(text_), "!{:30}adams_view_name='{}_{}'\n", "", name, id);
    fmt::format_to(std::back_inserter(text_), "{}/{}", name, id);
    for (std::string a : arguments) {
      const auto equals = a.find('=');
      if (!dense_ && equals != std::string::npos) a.replace(equals, 1, " = ");
      text_ += dense_ ? "," : "\n, ";
      text_ += a;
    }
    text_ += dense_ ? "\n" : "\n!\n";
  }
  std::string number() { return fmt::format("{:.6f}", std::uniform_real_distribution(-900.0, 900.0)(random_)); }
  std::string vector() { return number() + ", " + number() + ", " + number(); }
  std::string angles() { return number() + "D, " + number() + "D, " + number() + "D"; }

  void part(int k) {
    const int m = 10 * k, before = k > 2 ? m - 8 : 1;
    const auto id = [](int n) { return std::to_string(n); };
    const std::string i = "I=" + id(m + 1), j = "J=" + id(before), cm = "CM=" + id(m), owner = "PART=" + id(k);
    statement("PART", id(k),
              {"QG=" + vector(), "REULER=" + angles(), "MASS=1.2345", cm, "IP=1.0E+003, 1.1E+003, 1.2E+003"});
    statement("MARKER", id(m), {owner, "QP=0, 0, 0"});
    for (int n = 1; n <= 3; ++n) statement("MARKER", id(m + n), {owner, "QP=" + vector(), "REULER=" + angles()});
    statement("BUSHING", id(k),
              {i, j, "C=1.0, 1.0, 1.0", "K=1.0E+005, 1.0E+005, 1.0E+005", "CT=10, 10, 10",
               "KT=1.0E+006, 1.0E+006, 1.0E+006"});
    statement(
        "SFORCE", id(k),
        {"TRANSLATIONAL", i, j, fmt::format("FUNCTION=-12.5*(DM({0},{1})-100.0)\n, -0.35*VR({0},{1})", m + 1, before)});
    statement("REQUEST", id(k), {"DISPLACEMENT", i, j, "RM=1", "COMMENT=displacement of part " + id(k)});
    statement("GRAPHICS", id(k), {"CYLINDER", cm, "LENGTH=12.5", "RADIUS=3.0"});
  }

  bool dense_;
  std::string text_;
  std::mt19937 random_{1};
};

class Steps {
 public:
  explicit Steps(std::size_t bytes) : megabytes_(static_cast<double>(bytes) / 1e6) {}
  void done(const char* step) {
    const std::clock_t now = std::clock();
    const double seconds = static_cast<double>(now - last_) / CLOCKS_PER_SEC;
    last_ = now, sum_ += seconds;
    fmt::print("{:<12} {:8.2f} s {:8.1f} MB/s {:8.2f} times the text\n", step, seconds, megabytes_ / seconds,
               peak_megabytes() / megabytes_);
  }
  void all() const { fmt::print("{:<12} {:8.2f} s {:8.1f} MB/s\n", "together", sum_, megabytes_ / sum_); }

 private:
  double megabytes_, sum_ = 0;
  std::clock_t last_ = std::clock();
};

int measure(const std::string& file) {
  auto read = read_file(file);
  if (!read) return fmt::print(stderr, "{}: {}\n", file, read.error()), 1;
  Steps steps(read->size());
  const auto source = std::make_shared<const SourceText>(file, std::move(*read));
  steps.done("lines");
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
  const auto system = System::make(std::move(built.value));
  steps.done("system");
  steps.all();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool dense = argc > 1 && std::strcmp(argv[1], "dense") == 0;
  if (argc < 3 || (!dense && std::strcmp(argv[1], "exported") != 0)) {
    fmt::print(stderr, "usage: reading exported|dense MEGABYTES [FILE]\n");
    return 3;
  }
  const std::string file = argc > 3 ? argv[3] : "reading.adm";
  std::ofstream(file, std::ios::binary) << Text(dense, static_cast<std::size_t>(1e6 * std::stod(argv[2]))).take();
  if (argc > 3) return 0;
  const int status = measure(file);
  std::remove(file.c_str());
  return status;
}
