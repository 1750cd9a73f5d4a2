// Whatever the bytes are, reading ends, and nothing is read that is not there. Run with sanitizers.
#include <gtest/gtest.h>

#include <ctime>
#include <random>

#include "dataset/matrix_file.h"
#include "dataset/test_reading.h"

namespace dynalin::testing::robustness_test {
namespace {

const std::string deck = R"(Swing with an actuator
!                     adams_view_name='units'
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
ACCGRAV/
, JGRAV = -9806.65
PART/1, GROUND
ma/1, qp=0,0,0, zp =1,0,0 ! note
PART/2, MASS=2.5, CM=20; MARKER/20, PART=2, QP=10,0,0
, REULER=90D, 0D, -45.5D
PART/3, MASS=1, CM=30, IP=1E3,1E3
, 1E3, EXACT=X:Y:PSI
FLEX_BODY/5, MNF_FILE=../a b/link.mnf, CRATIO=IF(FXFREQ-100: 0.01, 0.02,
, 0.05)
SFORCE/1, TRANSLATION, I=20, J=1, FUNCTION=-12*(DM(20,1)-110)
, - 0.3*VR(20,1)
, + 0.0
GFORCE/89, I=1, RM=1, FX=20\FY=[1,2,3]*DXYZ(1)\FZ=60, JFLOAT=5
REQUEST/1, F2=DX(20,1)\F3=2**-1.0D+02\, C=Peter's force: x, y
MATRIX/1, FILE="in,1.mat" NAME=ac
STRING/1, STRING='a ! b'
tfsiso/2, num=1, den=0,1, &
  u=20,x=21,y=22
Displacement integrator
SFROCE/1, I=((, =
MARKER/123456789
END
)";

const std::string matrices =
    "MATRIXx VERSION 700 2\nA              2    3BC             3    1\n"
    "A              2    3    0(3(1PE10.3))\n"
    " 1.000E+00-2.000E+00 3.000E+00\n 4.000E+00 5.000E+00 6.500E-01\n"
    "BC             3    1    0(1P3E25.17)\n 1.0 0.0D0 1.0e3\n";
const std::string tables =
    "ADAMSMAT   Floating platform\n2\nTRF STL\nTRF FULL RORDER 2 3 6 ( 3F8.5 )\n"
    " 1.36400 0.00000 2.00000\n-3.44000-1.50000 0.25000\n"
    "STL SPARSE 3 2 2 ( 2I8, 2(1E14.6) )\n       1       2  1.5E+00\n3 1 2\n";

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  constexpr std::string_view bits[] = {",",  "=", "(",   ")",  "\n,", "\n", "&\n", "!",   "'",  "\"",   "/",
                                       "\\", ":", "**",  ";",  "[",   "]",  "D",   "E",   "9",  ".",    "\r",
                                       "\t", "-", "END", "\f", " ",   "\n", "1E9", "(((", "C=", "FILE="};
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = below(std::min<std::size_t>(text.size() - at, 60) + 1);
    switch (below(6)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 4:
        text.insert(at, 1 + below(3), static_cast<char>(below(256)));
        break;
      default:
        text.insert(at, bits[below(std::size(bits))]);
    }
  }
  return text;
}

// Reads every value in every way and renders everything; returns the number of problems.
std::size_t use(const Parsed<Dataset>& parsed) {
  const SourceText& source = *parsed.value.source;
  Diagnostics diagnostics = parsed.diagnostics;
  const std::size_t limit = source.text().size();
  for (const Statement& statement : parsed.value.statements) {
    EXPECT_LE(statement.at.offset + statement.at.length, limit);
    for (const WrittenArgument& argument : statement.arguments) {
      EXPECT_LE(argument.value_span().offset + argument.value_span().length, limit);
      for (const Token& token : argument.value()) EXPECT_LE(token.offset + token.length, limit);
      read_real(argument, source, diagnostics);
      read_reals(argument, source, diagnostics, 3);
      read_integer(argument, source, diagnostics);
      read_integers(argument, source, diagnostics);
      read_word(argument, source, diagnostics);
      read_words(argument, source, diagnostics);
      read_text(argument, source, diagnostics);
    }
  }
  EXPECT_FALSE(render(diagnostics).empty() && diagnostics.has_errors());
  return diagnostics.items().size();
}

std::size_t read_and_use(const std::string& text) {
  const auto source = std::make_shared<SourceText>("a.adm", text);
  const std::size_t commands = use(parse_statements(source, statement_names()));
  return commands + use(parse_dataset(source));
}

TEST(reading, survives_every_truncation_of_a_dataset) {
  for (std::size_t length = 0; length <= deck.size(); ++length) read_and_use(deck.substr(0, length));
}

TEST(reading, survives_thousands_of_mutations_of_a_dataset) {
  std::mt19937 random(12345);
  for (int i = 0; i < 3000; ++i) read_and_use(mutated(deck, random));
}

TEST(reading, survives_random_bytes) {
  std::mt19937 random(54321);
  for (int i = 0; i < 500; ++i) {
    std::string text(random() % 400, ' ');
    for (char& c : text) c = static_cast<char>(random() % 256);
    read_and_use(text);
    read_and_use("title\nPART/1, A=" + text);
  }
}

// Longer than the length of a token can say.
TEST(reading, survives_words_and_numbers_of_any_length) {
  for (const char c : {'a', '1'}) {
    const std::string text =
        "title\nPART/1, GROUND\nVARIABLE/1, FUNCTION=" + std::string(Token::longest + 9, c) + "\nEND\n";
    const auto parsed = parse_dataset(std::make_shared<SourceText>("a.adm", text));
    ASSERT_EQ(parsed.value.statements.size(), 2u);
    EXPECT_EQ(parsed.value.statements[1].arguments.at(0).value().size(), 2u);
    EXPECT_EQ(parsed.value.statements[1].arguments.at(0).value_span().length, Token::longest + 9);
  }
}

TEST(reading, survives_mutations_of_matrix_files) {
  std::mt19937 random(777);
  for (int i = 0; i < 4000; ++i) {
    const SourceText file("in.mat", mutated(i % 2 == 0 ? matrices : tables, random));
    Diagnostics diagnostics;
    for (const char* name : {"A", "bc", "TRF", "STL", "", "X"}) {
      const auto matrix = read_matrix(file, name, Span{}, diagnostics);
      if (!matrix) continue;
      EXPECT_EQ(matrix->values.size(),
                static_cast<std::size_t>(matrix->rows) * static_cast<std::size_t>(matrix->columns));
    }
    render(diagnostics);
  }
}

// Of the processor alone, so that what else the machine does is no matter.
double seconds_to_read(std::size_t length) {
  const std::clock_t start = std::clock();
  for (const std::string piece : {"A=(,", ",",   "(",      "A=B ", "=",     "'",  "'\"", "\\",     "&", "\n,",  "1 ",
                                  "a ",   "!\n", "C=x,I=", "-",    "K=1,,", "**", ")",   "\n,A=1", ";", "\xFF", "9"}) {
    for (const std::string head : {"PART/1, ", "REQUEST/1, COMMENT=", "MATRIX/1, FILE=", "SFORCE/1, F=(", ""}) {
      std::string text = "title\n" + head;
      while (text.size() < length) text += piece;
      const auto parsed = read_whole(text);
      render(parsed.diagnostics);
    }
  }
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// A time that grew with the square of the length would be 64 times as long, and that of a single piece minutes.
TEST(reading, takes_time_in_proportion_to_the_length) {
  const double some = seconds_to_read(25'000);
  EXPECT_LE(seconds_to_read(200'000), 3 * 8 * some);
}

}  // namespace
}  // namespace dynalin::testing::robustness_test
