// Writes what a campaign begins with into a folder: TARGET.dict with the words of the program's own tables, and as
// inputs the worked examples of the manual.
//     fuzz_material FOLDER docs/elements
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "command/command_catalogue.h"
#include "dataset/dataset.h"
#include "elements/catalogue.h"
#include "expression/expression.h"
#include "expression/functions.h"
#include "nastran/directives.h"
#include "nastran_reader/card_fields.h"

namespace {

namespace fs = std::filesystem;
using namespace dynalin;
using Words = std::set<std::string>;

void write_dictionary(const fs::path& file, const std::vector<Words>& groups) {
  Words all;
  for (const Words& group : groups) all.insert(group.begin(), group.end());
  std::ofstream out(file);
  for (const std::string& word : all) {
    out << '"';
    for (const char c : word) {
      if (c == '"' || c == '\\')
        out << '\\' << c;
      else if (c < ' ')
        out << fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
      else
        out << c;
    }
    out << "\"\n";
  }
}

Words statement_words() {
  Words words;
  for (const std::string_view name : statement_names()) words.insert("\n" + std::string(name) + "/1,");
  for (const Kind* kind : catalogue()) {
    if (!kind->variant.empty()) words.insert(fmt::format("\n{}/1, {},", kind->statement, kind->variant));
    for (const ArgumentInfo& a : kind->arguments) words.insert(fmt::format(",{}{}", a.name, a.is_flag ? "" : "="));
  }
  return words;
}

Words expression_words() {
  Words words;
  const auto call = [&](std::string_view name, std::size_t arguments) {
    std::string text(name);
    for (std::size_t k = 0; k < arguments; ++k) text += k == 0 ? "(1" : ",2";
    words.insert(text + (arguments > 0 ? ")" : ""));
  };
  for (const auto family : {elementary_functions(), contact_functions(), series_functions()}) {
    for (const Function& f : family) call(f.name, f.minimum_arguments), call(f.name, f.maximum_arguments);
  }
  for (const AtomFunction& f : atom_functions()) call(f.name, f.minimum_arguments), call(f.name, f.maximum_arguments);
  for (const std::string_view name : functions_not_built()) call(name, 1);
  for (const char* text : {"IF(", ":", "**", "PI", "[1,2,3]", "AKISPL(1,0,1,1)", "CUBSPL(1,0,1)", "CURVE(1,0,1,1)",
                           "INTERP(1,3,1)", "DELAY(TIME,0.1,0)", "USER(1)", "\\"})
    words.insert(text);
  return words;
}

Words command_words() {
  Words words;
  for (const CommandKind& row : command_catalogue()) {
    words.insert(fmt::format("\n{}/", row.name));
    for (const ArgumentInfo& a : row.arguments) words.insert(fmt::format(",{}{}", a.name, a.is_flag ? "" : "="));
  }
  return words;
}

const Words signs = {"\n,", "&\n",   "!",      "\r\n", "\t", "=",          ":",          "'",       "\"",  ";",
                     "90D", "1E300", "1E-300", "0",    "-1", "2147483647", "2147483648", "\nEND\n", "NaN", "INF"};
const Words matrix_words = {
    "MATRIXx VERSION 700", "ADAMSMAT", "SPARSE",      "FULL",    "RORDER",     "CORDER",
    "(1P3E25.17)",         "(3F8.5)",  "(2I8,E14.6)", "1.5D+00", "2147483647", "    1    1    0"};
const Words facet_words = {"solid ",
                           "endsolid a\n",
                           "facet normal 0 0 1\n",
                           "outer loop\n",
                           "vertex 1 0 0\n",
                           "endloop\n",
                           "endfacet\n",
                           "\nv 0 1 0",
                           "\nf 1 2 3",
                           "\nf -1/1 -2/1 -3/1",
                           "\nl 1 2",
                           "\no a",
                           "\ng a b",
                           "\\\n",
                           "Version: 2\n",
                           "1 1 1.0\n",
                           "3 1 2 3\n",
                           "1E300"};
const Words finite_element_words = {"%%MatrixMarket matrix coordinate real symmetric\n",
                                    "general",
                                    "*NODE\n",
                                    "*RIGID BODY, REF NODE=",
                                    "ROT NODE=",
                                    "DMIG,KAAX,0,6,2,0\n",
                                    "DMIG,MAAX,",
                                    "GRID,",
                                    "1 1 2.0\n",
                                    "1.1\n",
                                    "1.D0",
                                    "1E300"};
const Words modal_words = {"** RECORD GROUP ", "** END OF FILE\n", "**\n", " R1.0 2 1 0 0 0\n", "1.D0", "1E300",
                           "-1E-300"};
const Words spline_words = {"[B]\n", "Z 1 2 3\n", "{", "$", "#", "1E300", "-1E-300", ","};

Words configuration_words() {
  Words words = {" = ", "{\n", "}\n", "$", "yes", "no", "45D", "1, 3, 45-52", "1.E-08", "verbatim {\n"};
  for (const std::string_view name : nastran::directive_names()) words.emplace(name);
  return words;
}

Words deck_words() {
  Words words = {
      "SOL 107\n",  "SOL 108\n",     "CEND\n",   "BEGIN BULK\n", "ENDDATA\n", "K2PP = ", "SET 1 = ", "SPC = 1\n",
      "MPC = 1\n",  "CMETHOD = 1\n", "SUBCASE ", "DISP = ALL\n", "INCLUDE '", "THRU",    "ENDT",     "*",
      "\n        ", "\n+",           "\n*",      ",123456",      "1.-7",      "1.D0",    "        "};
  for (const auto family :
       {nastran_reader::point_cards(), nastran_reader::element_cards(), nastran_reader::constraint_cards(),
        nastran_reader::matrix_cards(), nastran_reader::response_cards(), nastran_reader::drawing_cards()}) {
    for (const auto& kind : family) words.insert("\n" + std::string(kind.name) + ",");
  }
  return words;
}

// Fences ```adm and ```acf of the pages, each dataset with the commands behind it.
void write_inputs(const fs::path& folder, const fs::path& pages) {
  for (const char* target : {"dataset", "commands", "run"}) fs::create_directories(folder / target);
  for (const auto& page : fs::directory_iterator(pages)) {
    std::ifstream in(page.path());
    std::string language, dataset, text;
    int count = 0;
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("```")) {
        if (!language.empty()) text += line + "\n";
        continue;
      }
      if (language.empty()) {
        language = line.size() > 3 ? line.substr(3) : "text";
        text.clear();
        continue;
      }
      const std::string name = fmt::format("{}_{}", page.path().stem().string(), ++count);
      if (language == "adm") std::ofstream(folder / "dataset" / name) << (dataset = text);
      if (language == "acf") {
        std::ofstream(folder / "commands" / name) << text;
        std::ofstream(folder / "run" / name) << dataset + "####\n" + text;
      }
      language.clear();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: fuzz_material FOLDER PAGES\n", stderr), 3;
  const fs::path folder = argv[1];
  fs::create_directories(folder);
  const Words statements = statement_words(), expressions = expression_words(), commands = command_words();
  write_dictionary(folder / "dataset.dict", {statements, expressions, signs});
  write_dictionary(folder / "commands.dict", {commands, statements, signs});
  write_dictionary(folder / "expression.dict", {expressions, signs});
  write_dictionary(folder / "matrix.dict", {matrix_words});
  write_dictionary(folder / "spline.dict", {spline_words});
  write_dictionary(folder / "facets.dict", {facet_words});
  write_dictionary(folder / "configuration.dict", {configuration_words()});
  write_dictionary(folder / "deck.dict", {deck_words()});
  write_dictionary(folder / "finite_elements.dict", {finite_element_words});
  write_dictionary(folder / "modal_body.dict", {modal_words});
  write_dictionary(folder / "run.dict", {statements, expressions, commands, signs, {"\n####\n"}});
  write_inputs(folder, argv[2]);
}
