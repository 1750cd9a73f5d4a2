// What matrices and damping of a flexible body may be, and where their errors stand.
#include <gmock/gmock.h>

#include <map>
#include <numbers>

#include "run.h"

namespace dynalin::cases::flexible_input_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A body of two modes that nothing couples: MATRIX statements from 11 on in the order of their names below.
class FlexibleInput : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    matrices_.clear();
    set("SELNOD", 2, 4, "1,0,0,0, 2,1,0,0");
    set("T_MODE", 6, 2, "0,0,0,0,0,0, 0,0,1,0,0,1");
    set("R_MODE", 6, 2, "0,0,0,0,0,0,0,0,0,0,0,0");
    set("GENSTIFF", 2, 2, "800,0,0,2700");
    set("INVAR1", 1, 1, "3");
    set("INVAR2", 3, 1, "0,0,0");
    set("INVAR3", 3, 2, "0,0,0,0,0,0");
    set("INVAR4", 3, 2, "0,0,0,0,0,0");
    set("INVAR5", 3, 4, "0,0,0,0,0,0,0,0,0,0,0,0");
    set("INVAR6", 2, 2, "2,0,0,3");
    set("INVAR7", 3, 3, "1,0,0,0,1,0,0,0,1");
    set("INVAR8", 3, 6, "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0");
    set("INVAR9", 3, 12, "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0");
  }
  void set(const std::string& name, int rows, int columns, const std::string& values) {
    matrices_[name] = fmt::format("FULL=RORDER, ROWS={}, COLUMNS={}, VALUES={}", rows, columns, values);
  }
  void set_text(const std::string& name, const std::string& text) { matrices_[name] = text; }
  std::string dataset(const std::string& more = ", CRATIO=0") const {
    std::string list, statements;
    int id = 10;
    for (const auto& [name, text] : matrices_) {
      list += fmt::format("{}{}", list.empty() ? "" : ",", ++id);
      statements += fmt::format("MATRIX/{}, NAME={}, {}\n", id, name, text);
    }
    return "Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MATRICES=" + list + more +
           "\nMARKER/21, FLEX_BODY=2, NODE_ID=1\n" + statements + "JOINT/1, FIXED, I=21, J=1\nEND\n";
  }
  std::string said(const std::string& more = ", CRATIO=0") { return run(dataset(more), "LINEAR/EIGENSOL\nSTOP\n").err; }
  // "model.adm:7:50: error: " of this text behind the NAME of a matrix.
  std::string error_at(const std::string& name, const std::string& text) const {
    const std::string all = dataset();
    const std::size_t begin = all.find("NAME=" + name),
                      at = text.empty() ? all.rfind('\n', begin) + 1 : all.find(text, begin);
    EXPECT_NE(at, std::string::npos);
    const auto line = 1 + std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return fmt::format("model.adm:{}:{}: error: ", line, at - all.rfind('\n', at - 1));
  }

 private:
  std::map<std::string, std::string> matrices_;
};

TEST_F(FlexibleInput, numbers_of_modes_are_those_of_states) {
  ASSERT_EQ(run(dataset(), "LINEAR/STATEMAT, FILE=x\nSTOP\n").status, 0);
  for (const std::string wrong : {"-1", "0", "1E12", "1000000", "2.5"}) {
    set("SELMOD", 2, 1, "7," + wrong);
    EXPECT_THAT(said(), HasSubstr(error_at("SELMOD", wrong) + "SELMOD of FLEX_BODY/2 has ")) << wrong;
  }
  set("SELMOD", 2, 1, "7,\n, 7");
  EXPECT_THAT(said(), HasSubstr(error_at("SELMOD", "7\n") + "SELMOD of FLEX_BODY/2 has 7 twice"));
  set("SELMOD", 1, 2, "7,8");
  EXPECT_THAT(said(),
              HasSubstr(error_at("SELMOD", "") + "SELMOD (MATRIX/22) of FLEX_BODY/2 must be 2 × 1, it is 1 × 2"));
  for (const bool both : {false, true}) {
    set("SELMOD", 2, both ? 2 : 1, both ? "999999,3.2, 12,4.8" : "999999,12");
    const RunResult r = run(dataset(), "LINEAR/STATEMAT, FILE=x\nSTOP\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.result(0).at("states").dump(), HasSubstr("Modal generalized coordinate Q999999"));
    EXPECT_THAT(r.result(0).at("states").dump(), HasSubstr("2000012"));
    EXPECT_EQ(r.err.find("second column of SELMOD") != std::string::npos, both);
  }
}

TEST_F(FlexibleInput, errors_stand_where_the_number_does) {
  const auto wrong = [&](const std::string& name, int rows, int columns, const std::string& values,
                         const std::string& text, const std::string& message) {
    SetUp();
    set(name, rows, columns, values);
    EXPECT_THAT(said(), HasSubstr(error_at(name, text) + message));
  };
  wrong("SELNOD", 2, 4, "1,0,0,0, -2,1,0,0", "-2", "SELNOD of FLEX_BODY/2 has -2 in its first column, which is not");
  wrong("SELNOD", 2, 4, "1,0,0,0, 1.25,1,0,0", "1.25", "SELNOD of FLEX_BODY/2 has 1.25 in its first column");
  wrong("T_MODE", 3, 2, "0,0,0,0,0,1", "", "T_MODE (MATRIX/23) of FLEX_BODY/2 must be 6 × 2, it is 3 × 2");
  wrong("INVAR9", 3, 3, "0,0,0,0,0,0,0,0,0", "", "INVAR9 (MATRIX/20) of FLEX_BODY/2 must be 3 × 12, it is 3 × 3");
  wrong("INVAR6", 2, 2, "2,0.5, 0.25,3", "0.25",
        "INVAR6 of FLEX_BODY/2 is not symmetric: 0.25 at 2, 1 and 0.5 at 1, 2");
  wrong("INVAR6", 2, 2, "2,0, 0,-3", "-3", "the generalized mass of mode 2 in FLEX_BODY/2 is -3");
  wrong("INVAR1", 1, 1, "-4", "", "the mass -4 in FLEX_BODY/2 is not positive");
  wrong("GENSTIFF", 2, 1, "800,-2700", "",
        "the generalized stiffness in FLEX_BODY/2 is not positive: there is none for mode 2");
  wrong("PRELOAD", 2, 1, "1,2", "", "MATRIX/21 of FLEX_BODY/2 is named PRELOAD, which is none");
  // By columns, and by entries: there the list stands for its number.
  SetUp();
  set_text("SELNOD", "FULL=CORDER, ROWS=2, COLUMNS=4, VALUES=1,3.5,0,1,0,0,0,0");
  EXPECT_THAT(said(), HasSubstr(error_at("SELNOD", "3.5") + "SELNOD of FLEX_BODY/2 has 3.5"));
  set_text("SELNOD", "SPARSE, ROWS=2, COLUMNS=4, I=1,2,2, J=1,1,2, VALUES=1,4.5,1");
  EXPECT_THAT(said(), HasSubstr(error_at("SELNOD", "1,4.5,1") + "SELNOD of FLEX_BODY/2 has 4.5"));
  SetUp();
  std::string twice = dataset();
  twice.replace(twice.find("=11,12"), 6, "=11,11");
  EXPECT_THAT(run(twice, "STOP\n").err, HasSubstr("MATRIX/11 stands twice among the MATRICES of FLEX_BODY/2"));
}

// A shape of next to no mass is as stiff as that.
TEST_F(FlexibleInput, of_stiffness_takes_any_size_beside_any_other) {
  set("GENSTIFF", 2, 1, "800,3E20");
  const RunResult r = run(dataset(), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  set("GENSTIFF", 2, 2, "800,4E11, 4E11,1E20");
  EXPECT_THAT(said(), HasSubstr("the generalized stiffness in FLEX_BODY/2 is not positive"));
}

TEST_F(FlexibleInput, damping_that_feeds_energy_is_warned_of) {
  const std::string full = ", CRATIO=0\\, GENERALIZED_DAMPING=FULL",
                    feeds = "the damping of FLEX_BODY/2 feeds energy into ";
  const auto damped = [&](const std::string& values, const std::string& more) {
    set("GENDAMP", 2, 2, values);
    return run(dataset(more), "LINEAR/EIGENSOL\nSTOP\n");
  };
  const RunResult negative = damped("5,0, 0,-6", full);
  ASSERT_EQ(negative.status, 0) << negative.err;
  EXPECT_THAT(negative.err, HasSubstr(feeds + "mode 2"));
  EXPECT_THAT(negative.err, HasSubstr("[body-damping]"));
  // s = c/(2 m) of each, in cycles.
  double largest = 0;
  for (const auto& e : negative.eigenvalues(0)) largest = std::max(largest, e.real());
  EXPECT_NEAR(largest, 6.0 / (2 * 3) / (2 * std::numbers::pi), 1e-12);
  // Both have damping, and together less than none: off the diagonal more than the mean of it.
  EXPECT_THAT(damped("4,3, 3,2", full).err, HasSubstr(feeds + "modes 1-2"));
  EXPECT_THAT(damped("0,1, 1,2", full).err, HasSubstr(feeds + "mode 1"));
  // A weakly damped mode beside one that is damped far more.
  EXPECT_THAT(damped("1E9,0, 0,-1E-3", full).err, HasSubstr(feeds + "mode 2"));
  // None, rank one of seven digits, or what CRATIO makes up for: 2 ζ √(K M) = 36 ζ · 5.
  for (const std::string rounded : {"0,0,0,0", "0.3333333,0.6666667, 0.6666667,1.333333"})
    EXPECT_THAT(damped(rounded, full).err, Not(HasSubstr("feeds")));
  EXPECT_THAT(damped("5,0, 0,-6", ", CRATIO=0.04\\, GENERALIZED_DAMPING=FULL").err, Not(HasSubstr("feeds")));
  EXPECT_THAT(damped("5,0, 0,-6", ", CRATIO=0.03\\, GENERALIZED_DAMPING=FULL").err, HasSubstr(feeds + "mode 2"));
  EXPECT_THAT(damped("5,0, 0,-6", ", CRATIO=0").err, Not(HasSubstr("feeds")));
  // None at all, by dataset or command.
  const std::string none = "FLEX_BODY/2 has no damping, a MATRIX named GENDAMP";
  SetUp();
  EXPECT_THAT(said(full), HasSubstr(none));
  EXPECT_THAT(run(dataset(), "SIMULATE/INITIAL\nFLEX_BODY/2, GENERALIZED_DAMPING=FULL\nSTOP\n").err, HasSubstr(none));
  const RunResult skew = damped("5,1, -1,6", full);
  EXPECT_NE(skew.status, 0);
  EXPECT_THAT(skew.err, HasSubstr("GENDAMP of FLEX_BODY/2 is not symmetric: "));
}

TEST_F(FlexibleInput, a_rigid_one_is_the_part_of_its_mass) {
  const std::string tail = "\nMARKER/22, FLEX_BODY=2, NODE_ID=2\nJOINT/2, REVOLUTE, I=22, J=2\nACCGRAV/JGRAV=-9.81\n";
  const auto swinging = [&](const std::string& more) {
    std::string t = dataset(more);
    t.replace(t.find("JOINT/1, FIXED, I=21, J=1\n"), 26, tail);
    t.replace(t.find("MARKER/1\n"), 9, "MARKER/2, PART=1, QP=1,0,0\n");
    return t;
  };
  // About node 2, 1 from the mass centre: ω² = m g/(J + m) with m = 3 and J = 1.
  const RunResult rigid = run(swinging(", REPRESENTATION=RIGID, REULER=90D,0,0, QG=1,-1,0"), "LINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(rigid.status, 0) << rigid.err;
  ASSERT_EQ(rigid.eigenvalues(0).size(), 2u);
  EXPECT_NEAR(std::abs(rigid.eigenvalues(0)[0]) * 2 * std::numbers::pi, std::sqrt(3 * 9.81 / 4), 1e-9);
  // What the statement says of modes is still that of the body with modes.
  EXPECT_THAT(said(", REPRESENTATION=RIGID, DMODE=1"), HasSubstr("DMODE has 1 values, FLEX_BODY/2 has 2 modes"));
  ASSERT_EQ(run(dataset(", REPRESENTATION=modal, CRATIO=0"), "LINEAR/EIGENSOL\nSTOP\n").eigenvalues(0).size(), 4u);
  EXPECT_THAT(said(", REPRESENTATION=NFORCE"), HasSubstr("REPRESENTATION=NFORCE of FLEX_BODY/2 is not available"));
  EXPECT_THAT(said(", REPRESENTATION=FREE"), HasSubstr("REPRESENTATION is MODAL or RIGID, not FREE"));
  // A mode is held once.
  EXPECT_THAT(said(", MODAL_EXACT_DISP=1,2,1"), HasSubstr("MODAL_EXACT_DISP of FLEX_BODY/2 lists mode 1 twice"));
  EXPECT_THAT(said(", MODAL_EXACT_VEL=2,2"), HasSubstr("MODAL_EXACT_VEL of FLEX_BODY/2 lists mode 2 twice"));
  EXPECT_THAT(said(", MODAL_EXACT_DISP=1, MODAL_EXACT_VEL=1"), ::testing::Not(HasSubstr("twice")));
  // Changed between analyses.
  const RunResult changed =
      run(swinging(", REULER=90D,0,0, QG=1,-1,0, CRATIO=0"),
          "SIMULATE/STATIC\nLINEAR/EIGENSOL\nFLEX_BODY/2, REPRESENTATION=RIGID\nSIMULATE/STATIC\nLINEAR/EIGENSOL\n"
          "FLEX_BODY/2, REPRESENTATION=MODAL\nSIMULATE/STATIC\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(changed.status, 0) << changed.err;
}

// Values and rates of the coordinates outside bodies after each analysis.
std::vector<std::vector<double>> shapes(const RunResult& r) {
  std::vector<std::vector<double>> list;
  for (const auto& result : r.json.at("results")) {
    if (!result.contains("operating_point")) continue;
    auto& values = list.emplace_back();
    for (const auto& c : result.at("operating_point").at("curve_parameters")) {
      values.push_back(c.at("value").get<double>());
      values.push_back(c.at("rate").get<double>());
    }
  }
  return list;
}

TEST_F(FlexibleInput, a_shape_that_a_command_states_anew_is_taken) {
  const RunResult r = run(dataset(", CRATIO=0, DMODE=0.01,0.02, VMODE=0.3,-0.2"),
                          "SIMULATE/INITIAL\nFLEX_BODY/2, VMODE=1,2\nSIMULATE/INITIAL\nFLEX_BODY/2, "
                          "DMODE=0.5,0.6\nSIMULATE/INITIAL\nFLEX_BODY/2, CRATIO=0.1\nSIMULATE/INITIAL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(shapes(r), (std::vector<std::vector<double>>{
                           {0.01, 0.3, 0.02, -0.2}, {0.01, 1, 0.02, 2}, {0.5, 1, 0.6, 2}, {0.5, 1, 0.6, 2}}));
}

// Places and slopes of a beam belong together: drawn at another place it is straight there.
TEST_F(FlexibleInput, a_bent_beam_that_is_placed_anew_is_as_it_is_drawn) {
  const RunResult r =
      run("Beam\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,1,0\n"
          "MATERIAL/1, DENSITY=7800, YOUNGS_MODULUS=2.1E10, POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, MATERIAL=1, "
          "NODE_LABELS=1,2, X=0,1, AREA=1E-4, IYY=8E-10, IZZ=8E-10\nMARKER/21, FE_PART=2, NODE_LABEL=1\n"
          "BUSHING/1, I=21, J=1, K=1E6,1E6,1E6, KT=1E4,1E4,1E4\nEND\n",
          "SIMULATE/STATIC\nFE_PART/2, QG=0,1,0\nBUSHING/1, J=2\nSIMULATE/INITIAL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto all = shapes(r);
  const auto& bent = all.front();
  const auto& drawn = all.back();
  ASSERT_EQ(drawn.size(), 18u);
  EXPECT_LT(bent[2], -1e-4);
  for (std::size_t k = 0; k < drawn.size(); ++k) EXPECT_NEAR(drawn[k], k == 0 || k == 6 ? 1 : 0, 1e-14) << k;
}

// Its nodes are where they are stated last, and it bends by its weight from there: as one that was always drawn so.
TEST_F(FlexibleInput, a_beam_whose_nodes_are_stated_anew_begins_there) {
  const auto beam = [](const std::string& nodes) {
    return "Beam\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
           "MATERIAL/1, DENSITY=7800, YOUNGS_MODULUS=2.1E10, POISSONS_RATIO=0.3\nFE_PART/2, " +
           nodes +
           ", MATERIAL=1, NODE_LABELS=1,2,3, AREA=1E-4, IYY=8E-10, IZZ=8E-10\nMARKER/21, FE_PART=2, NODE_LABEL=1\n"
           "JOINT/1, FIXED, I=21, J=1\nEND\n";
  };
  // Places and axes of the nodes.
  const auto nodes_of = [](const RunResult& r) {
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<double> values;
    if (r.status != 0) return values;
    for (const auto& body : r.json.at("results").back().at("operating_point").at("bodies")) {
      for (const double x : body.at("position")) values.push_back(x);
      for (const auto& axis : body.at("axes")) {
        for (const double x : axis) values.push_back(x);
      }
    }
    return values;
  };
  struct Edit {
    std::string command, stated;
  };
  const std::string type = "TYPE=3DBEAM, ", straight = "X=0,0.5,1";
  for (const auto& [command, stated] :
       {Edit{"X=0,0.6,1.3", type + "X=0,0.6,1.3"}, Edit{"Z=0,0.1,0.2", type + straight + ", Z=0,0.1,0.2"},
        Edit{"PHI=30D", type + straight + ", PHI=30D"}, Edit{"THETA=0.4", type + straight + ", THETA=0.4"},
        Edit{"Y=0,0.1,0.2, PSI=0.2", type + straight + ", Y=0,0.1,0.2, PSI=0.2"},
        Edit{"TYPE=2DBEAMXY", "TYPE=2DBEAMXY, " + straight}}) {
    SCOPED_TRACE(command);
    for (const std::string analysis : {"SIMULATE/INITIAL\n", "SIMULATE/STATIC\n"}) {
      const auto edited =
          nodes_of(run(beam(type + straight), "SIMULATE/STATIC\nFE_PART/2, " + command + "\n" + analysis + "STOP\n"));
      const auto drawn = nodes_of(run(beam(stated), analysis + "STOP\n"));
      ASSERT_EQ(edited.size(), drawn.size());
      ASSERT_GE(edited.size(), 36u);
      for (std::size_t k = 0; k < edited.size(); ++k) EXPECT_NEAR(edited[k], drawn[k], 1e-9) << k;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::flexible_input_test
