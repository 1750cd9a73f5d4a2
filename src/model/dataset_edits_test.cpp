// What edits leave of the arguments of a statement, and what they say of the start.
#include "model/dataset_edits.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <sstream>

#include "elements/catalogue.h"

namespace dynalin::dataset_edits_test {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const Dataset> statements(const std::string& text) {
  auto parsed = parse_statements(std::make_shared<const SourceText>("text", text), statement_names());
  EXPECT_FALSE(parsed.diagnostics.has_errors()) << render(parsed.diagnostics);
  return std::make_shared<const Dataset>(std::move(parsed.value));
}

struct Edited {
  std::string arguments;  // as written, in order
  Restated restated;
  std::string problems;
};
Edited edit(const std::string& base, const std::string& by) {
  Diagnostics problems;
  const auto written = statements(by);
  DatasetEditor editor(statements(base), written, catalogue(), problems);
  for (const Statement& s : written->statements) editor.redefine(s);
  const EditedDataset out = std::move(editor).finish();
  std::string list;
  for (const WrittenArgument& w : out.dataset->statements.back().arguments)
    list += (list.empty() ? "" : " ") + std::string(w.name.text()) +
            (w.has_value ? "=" + std::string(w.value_span().text()) : "");
  return {list, out.restated, render(problems)};
}

TEST(DatasetEdits, leave_other_arguments_as_they_are) {
  EXPECT_EQ(edit("BUSHING/3, I=1, J=2, K=1,2,3", "BUSHING/3, C=4,5,6, J=9").arguments, "I=1 K=1,2,3 C=4,5,6 J=9");
  EXPECT_EQ(edit("BUSHING/3, I=1, J=2", "BUSHING/3, K=1,1,1\nBUSHING/3, K=2,2,2, LIST").arguments, "I=1 J=2 K=2,2,2");
  EXPECT_EQ(edit("PART/1, GROUND", "ACCGRAV/KGRAV=1").arguments, "KGRAV=1");
  EXPECT_EQ(edit("ACCGRAV/KGRAV=2, JGRAV=3", "ACCGRAV/KGRAV=1").arguments, "JGRAV=3 KGRAV=1");
  EXPECT_THAT(edit("PART/1, GROUND", "PART/2, MASS=1").problems, HasSubstr("PART/2 does not exist"));
}

TEST(DatasetEdits, that_change_nothing_leave_the_dataset_before) {
  const auto base = statements("BUSHING/3, I=1, J=2, K=1,2,3\nPART/2, MASS=1, QG=1,0,0\n");
  const auto is_base = [&](const std::string& by) {
    Diagnostics problems;
    const auto written = statements(by);
    DatasetEditor editor(base, written, catalogue(), problems);
    for (const Statement& s : written->statements) editor.redefine(s);
    return std::move(editor).finish().dataset == base;
  };
  EXPECT_TRUE(is_base("BUSHING/3, k=1,2,3, I=1"));
  EXPECT_TRUE(is_base("BUSHING/3, K=4,2,3\nBUSHING/3, K=1,2,3"));
  EXPECT_FALSE(is_base("BUSHING/3, K=1,2,4"));
  EXPECT_FALSE(is_base("BUSHING/3, C=1,2,3"));
  EXPECT_FALSE(is_base("PART/2, QG=1,0,0"));  // begins there once more
  EXPECT_FALSE(is_base("ACCGRAV/KGRAV=1"));
}

// However many have come and gone.
TEST(DatasetEdits, keep_the_texts_that_statements_point_into) {
  std::shared_ptr<const Dataset> now = statements("BUSHING/3, I=1, J=2, K=1,2,3\nPART/2, MASS=1\n");
  std::weak_ptr<const Dataset> first;
  for (int k = 1; k <= 20; ++k) {
    Diagnostics problems;
    const auto written = statements(fmt::format("BUSHING/3, K={},5,6\n", 10 + k));
    DatasetEditor editor(now, written, catalogue(), problems);
    editor.redefine(written->statements.front());
    now = std::move(editor).finish().dataset;
    if (k == 1) first = now;
  }
  EXPECT_EQ(now->origins.size(), 2u);
  EXPECT_TRUE(first.expired());
  EXPECT_EQ(now->statements.front().arguments.back().value_span().text(), "30,5,6");
}

TEST(DatasetEdits, take_what_another_argument_excludes) {
  struct Row {
    std::string before, by, after;
  };
  for (const auto& [before, by, after] : std::vector<Row>{
           {"MARKER/1, QP=1,2,3, ZP=0,0,1, XP=1,0,0, USEXP", "REULER=0,0,0", "QP=1,2,3 REULER=0,0,0"},
           {"MARKER/1, REULER=0,0,0", "USEXP, XP=1,0,0", "USEXP XP=1,0,0"},
           {"MARKER/1, REULER=0,0,0", "ZP=1,0,0", "ZP=1,0,0"},
           {"MARKER/1, PART=2", "POINT_MASS=3", "POINT_MASS=3"},
           {"MARKER/1, POINT_MASS=2", "PART=3", "PART=3"},
           {"PART/1, MASS=1, ZG=0,0,1, XG=1,0,0", "REULER=0,0,0", "MASS=1 REULER=0,0,0"},
           {"POINT_MASS/1, REULER=0,0,0", "XG=1,0,0", "XG=1,0,0"},
           {"PART/1, REULER=0,0,0", "ZG=1,0,0", "ZG=1,0,0"},
           {"BEAM/1, CMATRIX=1", "CRATIO=2", "CRATIO=2"},
           {"NFORCE/1, CRATIO=1", "CMATRIX=2", "CMATRIX=2"},
           {"FIELD/1, CMATRIX=1, FORCE=2", "CRATIO=3", "FORCE=2 CRATIO=3"},
           {"FIELD/1, KMATRIX=1, CMATRIX=2, FORCE=3, LENGTH=4", "FUNCTION=USER(1)", "LENGTH=4 FUNCTION=USER(1)"},
           {"FIELD/1, FUNCTION=USER(1)", "KMATRIX=1", "KMATRIX=1"},
           {"MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=1", "I=2, J=3, B3", "FUNCTION=1 I=2 J=3 B3"},
           {"MOTION/1, I=2, J=3, B3, FUNCTION=1", "JOINT=1, TRANS", "FUNCTION=1 JOINT=1 TRANS"},
           {"MOTION/1, I=2, J=3, B3", "X", "I=2 J=3 X"},
           {"MOTION/1, JOINT=1, ROTATIONAL", "TRANSLATIONAL", "JOINT=1 TRANSLATIONAL"},
           {"MOTION/1, JOINT=1, TRANSLATIONAL", "ROTATIONAL", "JOINT=1 ROTATIONAL"},
           {"MOTION/1, VELOCITY, ICDISP=1", "DISPLACEMENT", "DISPLACEMENT"},
           {"MOTION/1, ACCELERATION, ICDISP=1, ICVEL=2", "VELOCITY", "ICDISP=1 VELOCITY"},
           {"MOTION/1, VELOCITY, ICDISP=1", "ACCELERATION, ICVEL=2", "ICDISP=1 ACCELERATION ICVEL=2"},
           {"GFORCE/1, FX=1, TY=2", "FXYZ=[1,2,3]", "TY=2 FXYZ=[1,2,3]"},
           {"GFORCE/1, FXYZ=[1,2,3], TXYZ=[1,2,3]", "TZ=2", "FXYZ=[1,2,3] TZ=2"},
           {"GFORCE/1, FX=1, TY=2", "FUNCTION=USER(1)", "FUNCTION=USER(1)"},
           {"VFORCE/1, FUNCTION=USER(1)", "FZ=2", "FZ=2"},
           {"VTORQUE/1, TX=1", "TXYZ=[1,2,3]", "TXYZ=[1,2,3]"},
           {"SPLINE/1, X=1,2, Y=1,2", "FILE=a", "FILE=a"},
           {"SPLINE/1, FILE=a, BLOCK=b, CHANNEL=2", "X=1,2", "X=1,2"},
           {"CURVE/1, OPEN, CURVE_POINTS", "CLOSED, CONTROL_POINTS", "CLOSED CONTROL_POINTS"},
           {"CURVE/1, CLOSED, CONTROL_POINTS", "OPEN, CURVE_POINTS", "OPEN CURVE_POINTS"},
           {"MATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1", "FILE=a, NAME=b", "FILE=a NAME=b"},
           {"MATRIX/1, FILE=a, NAME=b", "SPARSE, I=1, J=1, VALUES=1", "NAME=b SPARSE I=1 J=1 VALUES=1"},
           {"MATRIX/1, SPARSE, I=1, J=1, VALUES=1", "FULL, RORDER, ROWS=1, COLUMNS=1",
            "VALUES=1 FULL RORDER ROWS=1 COLUMNS=1"}}) {
    const std::string element = before.substr(0, before.find(','));
    const Edited e = edit(before, element + ", " + by);
    EXPECT_EQ(e.arguments, after) << before << " by " << by;
    EXPECT_EQ(e.problems, "");
  }
}

TEST(DatasetEdits, change_no_element_to_two_types) {
  std::map<std::string_view, std::vector<std::string_view>> types;
  for (const Kind* kind : catalogue()) {
    if (!kind->variant.empty()) types[kind->statement].push_back(kind->variant);
  }
  std::erase_if(types, [](const auto& of) { return of.second.size() < 2; });
  EXPECT_TRUE(types.contains("JOINT") && types.contains("JPRIM") && types.contains("SFORCE"));
  for (const auto& [statement, names] : types) {
    for (std::size_t k = 1; k < names.size(); ++k) {
      const std::string element = fmt::format("{}/1", statement);
      const Edited e = edit(fmt::format("{}, {}, I=1", element, names[0]),
                            fmt::format("{}, {}, I=2, {}", element, names[k], names[0]));
      EXPECT_THAT(e.problems,
                  HasSubstr(fmt::format("{} is both {} and {} [duplicate-variant]", element, names[k], names[0])));
      EXPECT_EQ(e.arguments, std::string(names[0]) + " I=1");
    }
  }
}

TEST(DatasetEdits, know_what_is_stated_of_the_start) {
  using Arguments = std::set<std::string>;
  struct Row {
    std::string by;
    bool anew;            // the whole element
    Arguments arguments;  // else
  };
  for (const auto& [by, anew, arguments] : std::vector<Row>{{"PART/1, MASS=2", false, {}},
                                                            {"PART/1, QG=1,2,3", true, {}},
                                                            {"PART/1, REULER=1,2,3", true, {}},
                                                            {"PART/1, XG=1,2,3", true, {}},
                                                            {"PART/1, EXACT=X:Y", false, {}},
                                                            {"PART/1, WZ=1", false, {"WZ"}},
                                                            {"PART/1, VX=1, wy=2", false, {"VX", "WY"}},
                                                            {"PART/1, VM=3", false, {"VX", "VY", "VZ"}},
                                                            {"PART/1, WM=3, VZ=1", false, {"VZ", "WX", "WY", "WZ"}},
                                                            {"POINT_MASS/1, VX=1", false, {"VX"}},
                                                            {"POINT_MASS/1, QG=1,2,3", true, {}},
                                                            {"FLEX_BODY/1, DMODE=1,2", false, {"DMODE"}},
                                                            {"FLEX_BODY/1, VMODE=1,2, VY=3", false, {"VMODE", "VY"}},
                                                            {"FLEX_BODY/1, QG=1,2,3", true, {}},
                                                            {"FE_PART/1, WX=1", false, {"WX"}},
                                                            {"FE_PART/1, Z=1,2", true, {}},
                                                            {"FE_PART/1, COORDINATES=1,2", true, {}},
                                                            {"FE_PART/1, SECTION=1,2", false, {}},
                                                            {"DIFF/1, IC=1", true, {}},
                                                            {"DIFF/1, FUNCTION=1", false, {}},
                                                            {"VARIABLE/1, IC=1", true, {}},
                                                            {"MOTION/1, ICDISP=1", false, {"ICDISP"}},
                                                            {"MOTION/1, ICVEL=1", false, {"ICVEL"}},
                                                            {"MOTION/1, FUNCTION=1", false, {}},
                                                            {"JOINT/1, REVOLUTE, IC=1,2", false, {"IC"}},
                                                            {"JOINT/1, CYLINDRICAL, ICROT=1", false, {"ICROT"}},
                                                            {"MARKER/1, QP=1,2,3", false, {}}}) {
    const std::string statement = by.substr(0, by.find('/'));
    const Edited e = edit(statement + "/1", by);
    using Elements = std::set<Restated::Element>;
    EXPECT_EQ(e.restated.anew(), anew ? Elements({{statement, 1}}) : Elements()) << by;
    const auto& of = e.restated.arguments();
    EXPECT_EQ(of.contains({statement, 1}) ? of.at({statement, 1}) : Arguments(), arguments) << by;
    EXPECT_EQ(of.size(), arguments.empty() ? 0u : 1u) << by;
  }
}

TEST(DatasetEdits, end_arguments_of_their_own_statement) {
  for (const Kind* kind : catalogue()) {
    for (const ArgumentInfo& a : kind->arguments) {
      std::istringstream words{std::string(a.ends)};
      for (std::string word; words >> word;) {
        const auto names = [&](const ArgumentInfo& other) { return other.name == word; };
        EXPECT_TRUE(std::ranges::any_of(kind->arguments, names))
            << kind->statement << '/' << a.name << " ends " << word;
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::dataset_edits_test
