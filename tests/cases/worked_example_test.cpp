// The worked examples of the manual: every fenced dataset of a page in docs/elements is run with the commands behind
// it, and must have the eigenvalues that the page works out by hand.
//
//     ```adm           a whole dataset
//     ```acf           commands, the last of which is LINEAR/EIGENSOL
//     ```eigenvalues   a line each, cycles per unit time: "-0.5", or "-0.5 +/- 1.25" for a pair; all of them, any order
#include <fmt/format.h>

#include <cmath>

#include "cases/decks.h"
#include "places/source_tree.h"

namespace dynalin::cases::worked_example_test {
namespace {

namespace fs = std::filesystem;

struct Fence {
  std::string language, text;
};
std::vector<Fence> fences(const std::string& page) {
  std::vector<Fence> list;
  std::istringstream in(page);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) list.push_back({line.substr(3), ""});
    } else if (inside) {
      list.back().text += line + "\n";
    }
  }
  return list;
}

// A printed number and half a unit of its last digit.
struct Printed {
  double value = 0, half_unit = 0;
};
Printed read(const std::string& text) {
  const auto e = text.find_first_of("eE");
  const auto mantissa = text.substr(0, e);
  const auto point = mantissa.find('.');
  const int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  const int digits = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point) - 1;
  // A plain 0 stands for what is exactly zero: rounding of the other entries is all that may be left.
  return {std::stod(text), mantissa == "0" ? 1e-9 : 0.501 * std::pow(10.0, exponent - digits)};
}

struct Expected {
  Printed real, imaginary;
  bool fits(std::complex<double> v) const {
    return std::abs(v.real() - real.value) <= real.half_unit &&
           std::abs(v.imag() - imaginary.value) <= imaginary.half_unit;
  }
};
std::vector<Expected> eigenvalues(const std::string& text) {
  std::vector<Expected> list;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string real, sign, imaginary;
    words >> real >> sign >> imaginary;
    if (real.empty()) continue;
    Expected e{read(real), {}};
    if (sign == "+/-") {
      e.imaginary = read(imaginary);
      list.push_back(e);
      e.imaginary.value = -e.imaginary.value;
    }
    list.push_back(e);
  }
  return list;
}

class WorkedExample : public ProgramLibraryAndDecks, public ::testing::WithParamInterface<std::string> {};

TEST_P(WorkedExample, has_the_eigenvalues_of_its_page) {
  const auto list = fences(read_file(element_pages() / (GetParam() + ".md")));
  std::size_t examples = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k].language != "adm") continue;
    ++examples;
    ASSERT_LT(k + 2, list.size()) << "a dataset without commands and eigenvalues";
    ASSERT_EQ(list[k + 1].language, "acf");
    ASSERT_EQ(list[k + 2].language, "eigenvalues");
    const RunResult r = run(list[k].text, list[k + 1].text);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.out.find("warning"), std::string::npos) << r.out;
    auto values = r.eigenvalues(r.json.at("results").size() - 1);
    const auto expected = eigenvalues(list[k + 2].text);
    EXPECT_EQ(values.size(), expected.size());
    for (const auto& e : expected) {
      const auto found = std::find_if(values.begin(), values.end(), [&](auto v) { return e.fits(v); });
      EXPECT_NE(found, values.end()) << e.real.value << " +/- " << e.imaginary.value
                                     << " is not among what is left of\n"
                                     << r.out;
      if (found != values.end()) values.erase(found);
    }
  }
  EXPECT_GT(examples, 0u) << "every force and constraint has a worked example on its page";
}

// Pages with a dataset, and those of all forces and constraints.
std::vector<std::string> pages() {
  std::vector<std::string> list;
  for (const auto& entry : fs::directory_iterator(element_pages())) {
    const auto name = entry.path().stem().string();
    const bool required = fs::exists(element_sources() / "forces" / (name + ".cpp")) ||
                          fs::exists(element_sources() / "constraints" / (name + ".cpp"));
    if (required || read_file(entry.path()).find("```adm") != std::string::npos) list.push_back(name);
  }
  std::sort(list.begin(), list.end());
  return list;
}
INSTANTIATE_TEST_SUITE_P(page, WorkedExample, ::testing::ValuesIn(pages()),
                         [](const auto& page) { return page.param; });

}  // namespace
}  // namespace dynalin::cases::worked_example_test
