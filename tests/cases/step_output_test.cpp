// The files that steps of simulations go to. Steps are made by hand: the crank below is where its MOTION wants it at
// any time, so that initial conditions at that time are a point of a kinematic simulation.
#include "command/step_output.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "cases/run.h"
#include "command/planner.h"
#include "system/operating_state.h"

namespace dynalin::cases::step_output_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The crank turns at 1 rad/s about z; its tip, PART/2's BCS, is at (cos t, sin t, 0).
const std::string crank =
    "crank\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n! adams_view_name='crank'\nPART/2, QG=1,0,0, MASS=2, CM=20, "
    "IP=0,0,1\nMARKER/20\nMARKER/21, QP=-1,0,0, REULER=90D,0,0\n! adams_view_name='hinge'\nJOINT/1, REVOLUTE, I=21, "
    "J=1\nMOTION/1, JOINT=1, FUNCTION=TIME+PI/2\nVARIABLE/3, FUNCTION=2*TIME\nPINPUT/1, VARIABLES=4\n"
    "VARIABLE/4, FUNCTION=0\nPOUTPUT/1, VARIABLES=3\nDIFF/1, FUNCTION=5, IC=7\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, "
    "I=20, J=1, FUNCTION=0\n";

class StepOutputs : public Cases {
 protected:
  void prepare(const std::string& lines, const std::string& commands = "STOP\n") {
    write("model.adm", crank + lines + "END\n");
    write("model.acf", "model\nmodel\n" + commands);
    options_.file = (folder_ / "model.acf").string();
    options_.json = (folder_ / "results.json").string();
    std::ostringstream err;
    auto plan = planned(options_, err);
    ASSERT_TRUE(plan) << err.str();
    plan_.emplace(std::move(*plan));
    job_ = &plan_->jobs.front();
    for (const Job::Stage& stage : job_->stages) systems_.push_back(stage.system);
    run_.emplace(options_, *job_, nullptr, err_, json_, files_);
    run_->message.rdbuf(message_.rdbuf());
    run_->command = "SIMULATE/KINEMATICS";
    run_->steps.open_results();
  }

  StudyPoint at(double time, std::size_t stage = 0) const {
    StudyPoint point = as_drawn(systems_[stage]);
    point.values.time = time;
    return initial_conditions(std::move(point)).value().point;
  }
  // Over [start, end]; an integration step lies between any two of output.
  void simulate(StepKind kind, double start, double end, int steps, std::size_t stage = 0) {
    run_->point = at(start, stage);
    IntegratorSettings integrator;
    integrator.type = "GSTIFF", integrator.error = 1e-3;
    StepOutput output(*run_, kind, OutputTimes::of_count(start, end, steps), integrator);
    IntegrationStatistics statistics;
    statistics.order = 1, statistics.step_size = (end - start) / steps / 2;
    for (int k = 0; k <= 2 * steps; ++k) {
      run_->point = at(start + (end - start) * k / (2 * steps), stage);
      EXPECT_EQ(output.add({run_->system(), run_->point.values, k % 2 == 0, statistics, {}}), GoOn::yes);
      ++statistics.steps, statistics.evaluations += 2;
    }
    const auto ended = output.end();
    EXPECT_TRUE(ended) << ended.error().message;
  }
  // All under their names.
  void finish() {
    for (auto& file : run_->steps.finish(ResultsFile::Ending::successful))
      ASSERT_TRUE(run_->files.add(std::move(file)));
    std::ostringstream out;
    ASSERT_TRUE(run_->files.commit(out));
  }
  std::string text(const std::string& name) const { return read_file(folder_ / name); }
  json history() {
    run_->json.finish(job_->model().units, 0, {});
    std::ostringstream out;
    run_->json.write(out);
    return json::parse(out.str());
  }
  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> list;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) list.push_back(line);
    return list;
  }

  SessionOptions options_;
  std::optional<Planner> plan_;
  const Job* job_ = nullptr;  // of the plan
  JsonResults json_;
  InputFiles inputs_;
  RunFiles files_{inputs_};
  std::vector<std::shared_ptr<const System>> systems_;
  std::optional<RunState> run_;
  std::ostringstream message_, err_;
};

// --- results

// A results file as an XML parser sees it: analyses, each with its map (names in the order of the ids, which count from
// 1 on) and its data.
json parsed(const std::filesystem::path& path) {
  const std::string script =
      "import sys,json,xml.etree.ElementTree as E\n"
      "n='{http://www.mscsoftware.com/:xrf10}'\n"
      "out=[]\n"
      "for a in E.parse(sys.argv[1]).getroot().findall(n+'Analysis'):\n"
      " ids={}\n"
      " for e in a.find(n+'StepMap'):\n"
      "  for c in e: ids[int(c.get('id'))]=[e.get('name'),c.get('name'),c.get('unitsValue'),e.get('entType'),"
      "e.get('objectId'),c.get('plotLabel')]\n"
      " assert sorted(ids)==list(range(1,len(ids)+1))\n"
      " data=[[d.get('name'),int(d.get('id')),[[s.get('type'),[float(x) for x in s.text.split()]] for s in d]]"
      " for d in a.findall(n+'Data')]\n"
      " assert all(len(s[1])==len(ids) for d in data for s in d[2])\n"
      " out.append({'name':a.get('name'),'map':[ids[k] for k in sorted(ids)],'data':data,"
      "'end':a.find(n+'TerminationStatus').get('runStatus')})\n"
      "print(json.dumps(out))\n";
  const std::filesystem::path file = path.parent_path() / "read.py", found = path.parent_path() / "read.json";
  std::ofstream(file) << script;
  const std::string command = "python3 " + file.string() + " " + path.string() + " > " + found.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  return json::parse(read_file(found));
}
// The components of requests in the map of the first analysis of a results file.
std::vector<json> requests_in(const std::filesystem::path& results) {
  const json analysis = parsed(results)[0];
  std::vector<json> requests;
  for (const auto& entry : analysis.at("map")) {
    if (entry[3] == "Request") requests.push_back(entry);
  }
  return requests;
}

std::size_t place_of(const json& analysis, const std::string& entity, const std::string& component) {
  const json& map = analysis.at("map");
  for (std::size_t k = 0; k < map.size(); ++k) {
    if (map[k][0] == entity && map[k][1] == component) return k;
  }
  ADD_FAILURE() << entity << ' ' << component;
  return 0;
}

TEST_F(StepOutputs, are_steps_of_one_block_of_the_results_file) {
  prepare("RESULTS/XRF, COMMENT=with <brackets>\nREQUEST/5, DISPLACEMENT, I=20, J=1\n");
  simulate(StepKind::kinematics, 0, 1, 4);
  simulate(StepKind::dynamics, 1, 2, 2);
  finish();
  const json analyses = parsed(folder_ / "model.res");
  ASSERT_EQ(analyses.size(), 1u);
  const json& a = analyses[0];
  EXPECT_EQ(a.at("end"), "Successful");
  EXPECT_THAT(text("model.res"), HasSubstr("<Comment>with &lt;brackets&gt;</Comment>"));
  // In the order of the reference: time, positions, velocities, accelerations, constraints, forces, the rest.
  std::vector<std::string> order;
  for (const auto& entry : a.at("map")) {
    const std::string name = entry[0].get<std::string>() + "." + entry[1].get<std::string>();
    if (entry[1] == "TIME" || entry[1] == "X" || entry[1] == "VX" || entry[1] == "ACCX" || entry[1] == "FX" ||
        entry[1] == "Q" || entry[1] == "IN1" || entry[1] == "OUT1" || entry[1] == "Q1" || entry[1] == "MAG")
      order.push_back(name);
  }
  EXPECT_THAT(order, ElementsAre("time.TIME", "crank_XFORM.X", "crank_XFORM.VX", "crank_XFORM.ACCX", "hinge.FX",
                                 "MOTION_1.FX", "SFORCE_1.FX", "VARIABLE_3.Q", "VARIABLE_4.Q", "PINPUT_1.IN1",
                                 "POUTPUT_1.OUT1", "DIFF_1.Q1", "REQUEST_5.MAG", "REQUEST_5.X"));
  const json& data = a.at("data");
  ASSERT_EQ(data.size(), 2u);
  EXPECT_EQ(data[0][0], "kinematic_001");
  EXPECT_EQ(data[1][0], "dynamic_001");
  EXPECT_EQ(data[1][1], 2);
  ASSERT_EQ(data[0][2].size(), 5u);
  ASSERT_EQ(data[1][2].size(), 3u);
  for (std::size_t k = 0; k < 5; ++k) {
    const json& step = data[0][2][k];
    EXPECT_EQ(step[0], "kinematic");
    const double t = 0.25 * static_cast<double>(k);
    const auto value = [&](const std::string& entity, const std::string& component) {
      return step[1][place_of(a, entity, component)].get<double>();
    };
    EXPECT_EQ(value("time", "TIME"), t);
    EXPECT_NEAR(value("crank_XFORM", "X"), std::cos(t), 1e-9);
    EXPECT_NEAR(value("crank_XFORM", "VY"), std::cos(t), 1e-9);
    EXPECT_NEAR(value("crank_XFORM", "ACCY"), -std::sin(t), 1e-9);
    EXPECT_NEAR(value("hinge", "FX"), -2 * std::cos(t), 1e-9);
    EXPECT_NEAR(value("VARIABLE_3", "Q"), 2 * t, 1e-12);
    EXPECT_NEAR(value("POUTPUT_1", "OUT1"), 2 * t, 1e-12);
    EXPECT_NEAR(value("DIFF_1", "Q1"), 7, 1e-12);
    EXPECT_NEAR(value("DIFF_1", "QDOT1"), 5, 1e-12);
    EXPECT_NEAR(value("REQUEST_5", "Y"), std::sin(t), 1e-9);
    EXPECT_NEAR(value("REQUEST_5", "PSI"), t, 1e-9);
  }
}

TEST_F(StepOutputs, name_components_of_requests_as_the_dataset_does) {
  prepare(
      "RESULTS/XRF\nREQUEST/1, VELOCITY, I=20, CNAMES=\"\", \"u\", \"v<w\",,\"\",\"\", RESULTS_NAME=tip, "
      "CUNITS=\"\",\"mm/s\", CLABELS=\"\",\"speed\"\nREQUEST/2, F2=1\\F4=2\nMREQUEST/1, FORCE, JOINTS=ALL\n");
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  const std::vector<json> requests = requests_in(folder_ / "model.res");
  ASSERT_EQ(requests.size(), 14u);
  EXPECT_EQ(requests[0], json::parse(R"(["tip", "u", "mm/s", "Request", "1", "speed"])"));
  EXPECT_EQ(requests[1], json::parse(R"(["tip", "v<w", "meter/sec", "Request", "1", null])"));
  // The names end before the last two places, which keep their own.
  EXPECT_EQ(requests[2], json::parse(R"(["tip", "WY", "rad/sec", "Request", "1", null])"));
  EXPECT_EQ(requests[3][1], "WZ");
  EXPECT_EQ(requests[4], json::parse(R"(["REQUEST_2", "F2", null, "Request", "2", null])"));
  EXPECT_EQ(requests[6][0], "MREQUEST_1_JOINT_1");
  EXPECT_EQ(requests[6][2], "newton");
}

// Lists of words have colons between them elsewhere in the language.
TEST_F(StepOutputs, name_components_of_requests_by_lists_with_colons) {
  prepare(
      "RESULTS/XRF\nREQUEST/1, VELOCITY, I=20, CNAMES=:u:'v:w', CUNITS=:mm/s, CLABELS=:speed, RESULTS_NAME=tip\n"
      "REQUEST/2, F2=1\\F3=2\\CNAMES=:x:y\nREQUEST/3, F2=1\\CNAMES=\"\",\"a:b\"\n");
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  const std::vector<json> requests = requests_in(folder_ / "model.res");
  ASSERT_EQ(requests.size(), 10u);
  EXPECT_EQ(requests[0], json::parse(R"(["tip", "u", "mm/s", "Request", "1", "speed"])"));
  EXPECT_EQ(requests[1], json::parse(R"(["tip", "v:w", "meter/sec", "Request", "1", null])"));
  EXPECT_EQ(requests[7][1], "x");
  EXPECT_EQ(requests[8][1], "y");
  EXPECT_EQ(requests[9][1], "a:b");
}

TEST_F(StepOutputs, have_no_angles_of_what_does_not_turn) {
  prepare("RESULTS/XRF\nPOINT_MASS/9, QG=0,0,4, MASS=1, CM=90\nMARKER/90, POINT_MASS=9\nJPRIM/1, ATPOINT, I=90, J=1\n");
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  const json a = parsed(folder_ / "model.res")[0];
  std::map<std::string, std::vector<std::string>> components;
  for (const auto& entry : a.at("map")) {
    if (entry[3].is_string()) components[entry[3].get<std::string>()].push_back(entry[1].get<std::string>());
  }
  EXPECT_THAT(components["Point_Mass"], ElementsAre("X", "Y", "Z", "VX", "VY", "VZ", "ACCX", "ACCY", "ACCZ"));
  EXPECT_EQ(components["Part"].size(), 18u);
}

TEST_F(StepOutputs, leave_requests_out_of_the_results_file_where_it_says_so) {
  prepare("RESULTS/XRF, NOREQUESTS\nREQUEST/1, VELOCITY, I=20\n");
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  EXPECT_THAT(text("model.res"), Not(HasSubstr("Request")));
}

TEST_F(StepOutputs, of_a_model_without_an_element_have_a_map_of_their_own) {
  prepare("RESULTS/XRF\nREQUEST/1, VELOCITY, I=20\n",
          "SIMULATE/INITIAL\nDEACTIVATE/REQUEST, ID=1\nSIMULATE/INITIAL\nPART/2, MASS=3\n");
  ASSERT_EQ(systems_.size(), 3u);
  simulate(StepKind::kinematics, 0, 1, 1);
  simulate(StepKind::dynamics, 1, 2, 1, 1);
  simulate(StepKind::quasi_statics, 2, 3, 1, 2);  // other masses: the same entities
  finish();
  const json analyses = parsed(folder_ / "model.res");
  ASSERT_EQ(analyses.size(), 2u);
  EXPECT_EQ(analyses[0].at("name"), "ANALYSIS_01");
  EXPECT_EQ(analyses[0].at("map").size(), analyses[1].at("map").size() + 8);
  EXPECT_EQ(analyses[1].at("data")[0][0], "dynamic_001");
  EXPECT_EQ(analyses[1].at("data")[0][1], 2);
  EXPECT_EQ(analyses[1].at("data")[1][0], "quasiStatic_001");
}

// --- request file

TEST_F(StepOutputs, are_records_of_the_request_file) {
  prepare(
      "OUTPUT/REQSAVE, NOPRINT\nREQUEST/7, DISPLACEMENT, I=20, J=1, RM=1, COMMENT=the tip\n"
      "REQUEST/8, F1=9\\F2=1\\F3=2\\F4=3\\F5=9\\F6=4\\F7=-5e-120\\F8=6e150\n");
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  const auto lines = lines_of(text("model.req"));
  ASSERT_EQ(lines.size(), 13u) << text("model.req");
  EXPECT_THAT(lines[0], ::testing::MatchesRegex(" A.R3    ....-..-.. ..:..:..               2        12  3D"));
  EXPECT_EQ(lines[1], "crank" + std::string(75, ' '));
  EXPECT_EQ(lines[2], "    0     M_KGS_N_RACA 1.000000000000000E+00");
  EXPECT_EQ(lines[3], "         7         1        20         1         1");
  EXPECT_EQ(lines[4], "the tip" + std::string(73, ' '));
  EXPECT_EQ(lines[5], "         8         5         0         0         0");
  EXPECT_EQ(lines[7], "   0.00000E+00");
  EXPECT_EQ(lines[8], "   1.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines[9], "   1.00000E+00  2.00000E+00  3.00000E+00  4.00000E+00 -5.0000E-120 6.00000E+150");
  EXPECT_EQ(lines[10], "   1.00000E+00");
  EXPECT_EQ(lines[11], "   5.40302E-01  8.41471E-01  0.00000E+00  1.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "model.out"));
  EXPECT_THAT(err_.str(), HasSubstr("F1 of REQUEST/8, F5 of REQUEST/8 are not in it"));
}

TEST_F(StepOutputs, have_zeros_in_the_request_file_for_requests_that_are_taken_out) {
  prepare("OUTPUT/REQSAVE, NOPRINT\nREQUEST/1, F2=1\nREQUEST/2, F2=2\n",
          "SIMULATE/INITIAL\nDEACTIVATE/REQUEST, ID=1\nSIMULATE/INITIAL\n");
  simulate(StepKind::dynamics, 0, 1, 1);
  simulate(StepKind::dynamics, 1, 2, 1, 1);
  finish();
  const auto lines = lines_of(text("model.req"));
  ASSERT_EQ(lines.size(), 7u + 4 * 3);
  EXPECT_THAT(lines[11], StartsWith("   1.00000E+00"));
  EXPECT_THAT(lines[17], StartsWith("   0.00000E+00"));
  EXPECT_THAT(lines[18], StartsWith("   2.00000E+00"));
}

TEST_F(StepOutputs, have_no_place_in_the_request_file_for_requests_that_come_later) {
  prepare("OUTPUT/REQSAVE, NOPRINT\nREQUEST/1, F2=1\nREQUEST/2, F2=2\n",
          "SIMULATE/INITIAL\nDEACTIVATE/REQUEST, ID=1\nSIMULATE/INITIAL\nACTIVATE/REQUEST, ID=1\n");
  simulate(StepKind::dynamics, 0, 1, 1, 1);
  simulate(StepKind::dynamics, 1, 2, 1, 2);
  finish();
  EXPECT_EQ(lines_of(text("model.req")).size(), 5u + 4 * 2);
  const auto at = err_.str().find("REQUEST/1 was not there when the request file began");
  ASSERT_NE(at, std::string::npos) << err_.str();
  EXPECT_EQ(err_.str().find("REQUEST/1 was not there", at + 1), std::string::npos);
}

TEST_F(StepOutputs, are_scaled_in_request_file_and_tables_as_output_says) {
  prepare(
      "OUTPUT/REQSAVE, YPR, DSCALE=1000,2, VSCALE=3, DZERO=600, FIXED\nREQUEST/1, DISPLACEMENT, I=21, J=1\n"
      "REQUEST/2, VELOCITY, I=20\nREQUEST/3, DISPLACEMENT, I=20\n");
  simulate(StepKind::kinematics, 1, 2, 1);
  finish();
  const auto lines = lines_of(text("model.req"));
  // Y = sin 1 is 841 mm and above what is written as zero, X is not; yaw is 1 rad, twice.
  EXPECT_EQ(lines[12], "   0.00000E+00  8.41471E+02  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00")
      << text("model.req");
  EXPECT_EQ(lines[11], "  -2.52441E+00  1.62091E+00  0.00000E+00  0.00000E+00  0.00000E+00  1.00000E+00");
  const std::string tables = text("model.out");
  EXPECT_THAT(tables, HasSubstr("YAW         PITCH          ROLL\n"));
  EXPECT_THAT(tables, HasSubstr("        1.0000     1000.0000        0.0000      841.4710        0.0000"));
}

TEST_F(StepOutputs, have_a_scale_for_each_kind_of_request) {
  prepare(
      "OUTPUT/REQSAVE, NOPRINT, DSCALE=9, VSCALE=2,3, ASCALE=5, AZERO=1, FSCALE=7,11, FZERO=14\nREQUEST/1, V, I=20\n"
      "REQUEST/2, A, I=20\nREQUEST/3, F, I=21, J=1\nREQUEST/4, F2=1\nREQUEST/5, F, I=20, J=1, RM=1\n"
      "SFORCE/2, ROTATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=2\n");
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  const auto lines = lines_of(text("model.req"));
  // Velocity 1 along y, acceleration −1 along x, reaction −2 along x, of the torque 2 and of that which holds it −2.
  EXPECT_EQ(lines.at(14), "   0.00000E+00  2.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  3.00000E+00");
  EXPECT_EQ(lines.at(15), "  -5.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines.at(16), "  -1.40000E+01  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00 -2.20000E+01");
  EXPECT_EQ(lines.at(17), "   1.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines.at(18), "   0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  2.20000E+01");
}

TEST(OutputSettingsOfCommands, are_put_back_by_default) {
  OutputSettings settings;
  WrittenOutput first, list, second;
  first.requests = first.fixed = first.yaw_pitch_roll = true, first.fscale = {2}, first.dzero = 3;
  first.apply(settings);
  EXPECT_TRUE(settings.request_file && settings.fixed && settings.yaw_pitch_roll && settings.writes_tables());
  EXPECT_EQ(settings.scale[3], (std::array<double, 2>{2, 1}));
  EXPECT_EQ(settings.zero[0], 3);
  second.defaults = second.no_print = true;
  second.apply(settings);
  EXPECT_FALSE(settings.request_file || settings.fixed || settings.yaw_pitch_roll || settings.writes_tables());
  EXPECT_EQ(settings.scale[3], (std::array<double, 2>{1, 1}));
  EXPECT_EQ(settings.zero[0], 0);
  OutputSettings untouched;
  list.list = true;
  list.apply(untouched);
  EXPECT_FALSE(untouched.writes_tables());
}

TEST_F(StepOutputs, have_yaw_pitch_and_roll_as_the_functions_of_these_names) {
  prepare(
      "OUTPUT/REQSAVE, YPR, NOPRINT\nMARKER/22, PART=2, REULER=200D,70D,-40D\nMARKER/23, PART=2, REULER=0,90D,90D\n"
      "REQUEST/1, D, I=22, J=1\nREQUEST/2, F6=YAW(22,1)\\F7=PITCH(22,1)\\F8=ROLL(22,1)\n"
      "REQUEST/3, D, I=23, J=1\nREQUEST/4, F6=YAW(23,1)\\F7=PITCH(23,1)\\F8=ROLL(23,1)\n");
  simulate(StepKind::kinematics, 0.3, 1, 1);
  finish();
  const auto lines = lines_of(text("model.req"));
  for (const std::size_t first : {12u, 14u})
    EXPECT_EQ(lines.at(first).substr(40), lines.at(first + 1).substr(40)) << text("model.req");
}

// --- tables

TEST_F(StepOutputs, are_tables_of_requests_for_each_simulation) {
  prepare(
      "OUTPUT/PRINT\nREQUEST/7, DISPLACEMENT, I=20, J=1, COMMENT=the tip\nREQUEST/8, F2=TIME\\F3=SQRT(-TIME), "
      "TITLE=:clock:root\n");
  simulate(StepKind::kinematics, 0, 1, 2);
  simulate(StepKind::dynamics, 1, 1.5, 1);
  finish();
  EXPECT_EQ(text("model.out"),
            " crank\n\n\n Kinematic simulation\n\n REQUEST/7   DISPLACEMENT of MARKER/20 from MARKER/1, along the "
            "global axes\n the tip\n"
            "          TIME           MAG             X             Y             Z           PSI         THETA        "
            "   PHI\n"
            "   0.00000E+00   1.00000E+00   1.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   "
            "0.00000E+00\n"
            "   5.00000E-01   1.00000E+00   8.77583E-01   4.79426E-01   0.00000E+00   2.86479E+01   0.00000E+00   "
            "0.00000E+00\n"
            "   1.00000E+00   1.00000E+00   5.40302E-01   8.41471E-01   0.00000E+00   5.72958E+01   0.00000E+00   "
            "0.00000E+00\n"
            "\n REQUEST/8\n          TIME         clock          root\n"
            "   0.00000E+00   0.00000E+00   0.00000E+00\n   5.00000E-01   5.00000E-01           NAN\n"
            "   1.00000E+00   1.00000E+00           NAN\n\n\n Dynamic simulation\n\n"
            " REQUEST/7   DISPLACEMENT of MARKER/20 from MARKER/1, along the global axes\n the tip\n"
            "          TIME           MAG             X             Y             Z           PSI         THETA        "
            "   PHI\n"
            "   1.00000E+00   1.00000E+00   5.40302E-01   8.41471E-01   0.00000E+00   5.72958E+01   0.00000E+00   "
            "0.00000E+00\n"
            "   1.50000E+00   1.00000E+00   7.07372E-02   9.97495E-01   0.00000E+00   8.59437E+01   0.00000E+00   "
            "0.00000E+00\n"
            "\n REQUEST/8\n          TIME         clock          root\n   1.00000E+00   1.00000E+00           NAN\n"
            "   1.50000E+00   1.50000E+00           NAN\n");
  EXPECT_THAT(err_.str(), HasSubstr("F3 of REQUEST/8 has no finite value at time 0.5"));
}

// --- graphics

TEST_F(StepOutputs, are_frames_of_the_graphics_file) {
  prepare(
      "OUTPUT/GRSAVE\nPOINT_MASS/9, QG=0,0,4, MASS=1, CM=90\nMARKER/90, POINT_MASS=9\nJPRIM/1, ATPOINT, I=90, J=1\n");
  EXPECT_EQ(systems_.size(), 1u);
  simulate(StepKind::kinematics, 0, 1, 1);
  finish();
  const auto lines = lines_of(text("model.gra"));
  ASSERT_EQ(lines.size(), 3u + 3 + 2 * 4 + 3 + 2 * 3) << text("model.gra");
  EXPECT_THAT(lines[0], ::testing::MatchesRegex(" A.G8    ....-..-.. ..:..:..  M_KGS_N_RACA 1.000000000000000E.00"));
  EXPECT_EQ(lines[2], "     3    4    0    0    0    0    0    0    0");
  EXPECT_EQ(lines[3], "          1         1");
  EXPECT_EQ(lines[5], "          9         2");
  EXPECT_EQ(lines[10], "         21         2 -1.00000E+00  0.00000E+00  0.00000E+00       0");
  EXPECT_EQ(lines[11], "   1.57080E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines[14], "  -9.99999E+05");
  EXPECT_EQ(lines[15], "   1.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines[16], "   0.00000E+00  0.00000E+00  4.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines[20], "   1.00000E+00");
  EXPECT_EQ(lines[21], "   5.40302E-01  8.41471E-01  0.00000E+00  1.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines[22], "   0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00");
}

// --- history and message file

TEST_F(StepOutputs, are_the_history_of_the_results_for_programs) {
  prepare("REQUEST/1, F2=TIME\\F3=SQRT(-TIME)\nMREQUEST/2, VELOCITY, PARTS=ALL\n");
  simulate(StepKind::kinematics, 0, 1, 2);
  const json result = history().at("results").at(0);
  EXPECT_EQ(result.at("command"), "SIMULATE/KINEMATICS");
  EXPECT_EQ(result.at("time"), 1.0);
  const json& h = result.at("history");
  EXPECT_EQ(h.at("times"), json::parse("[0.0, 0.5, 1.0]"));
  EXPECT_EQ(h.at("variables"), json::parse(R"({"3": [0.0, 1.0, 2.0], "4": [0.0, 0.0, 0.0]})"));
  EXPECT_EQ(h.at("requests").at("1"),
            json::parse(R"({"components": ["F2", "F3"], "values": [[0.0, 0.0], [0.5, null], [1.0, null]]})"));
  const json& many = h.at("requests").at("MREQUEST/2 PART/2");
  EXPECT_EQ(many.at("components").size(), 8u);
  EXPECT_NEAR(many.at("values").at(2).at(1).get<double>(), -std::sin(1.0), 1e-9);
  EXPECT_THAT(err_.str(), HasSubstr("F3 of REQUEST/1"));
}

TEST_F(StepOutputs, are_about_ten_rows_of_the_message_file) {
  prepare("");
  simulate(StepKind::dynamics, 0, 2, 50);
  const std::string text = message_.str();
  EXPECT_THAT(text, StartsWith("\n\n  Begin Simulation\n\n\n  ****** Performing Dynamic Simulation using IDA SI2 "
                               "Integrator ******\n   The system is modelled with stabilized INDEX-2 DAEs.\n   The "
                               "integrator is IDA of SUNDIALS, which stands in for GSTIFF\n   Integration error =    "
                               "1.000000E-03\n\n"
                               "   Simulation      Step        Function    Cumulative   Integration     CPU\n"
                               "      Time         Size       Evaluations  Steps Taken    Order        time\n"
                               "   ___________  ___________   ___________  ___________   _________    ________\n"
                               "   0.00000E+00  2.00000E-02            0            0       1            0."));
  EXPECT_THAT(text, HasSubstr("\n   2.00000E+00  2.00000E-02          200          100       1            "));
  EXPECT_THAT(text, ::testing::EndsWith("\n  End Simulation\n\n"));
  const auto lines = lines_of(text);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.find("  2.00000E-02") == 14u; }),
            11)
      << text;
}

TEST(SecondsText, is_short) {
  EXPECT_EQ(seconds_text(0.019), "0.02");
  EXPECT_EQ(seconds_text(65.2), "1:05");
  EXPECT_EQ(seconds_text(3607), "1:00:07");
}

// --- files of a whole run

TEST_F(StepOutputs, of_single_points_go_to_the_same_files) {
  write("model.adm", crank + "OUTPUT/REQSAVE, GRSAVE\nRESULTS/XRF\nREQUEST/1, F2=5\nEND\n");
  write("model.acf", "model\nmodel\nSIMULATE/INITIAL_CONDITIONS\n");
  const RunResult r = run_file("model.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.json.at("files").size(), 6u);
  for (const std::string name : {"model.res", "model.req", "model.gra", "model.out", "model.msg"}) {
    EXPECT_TRUE(r.wrote(name)) << name;
    EXPECT_THAT(r.out, HasSubstr("wrote " + (folder_ / name).string()));
  }
  EXPECT_THAT(r.text("model.out"), HasSubstr("Initial conditions\n\n REQUEST/1\n          TIME            F2\n   "
                                             "0.00000E+00   5.00000E+00\n"));
  EXPECT_EQ(parsed(folder_ / "model.res")[0].at("data")[0][0], "initialConditions_001");
}

TEST_F(StepOutputs, are_written_from_the_command_output_on) {
  write("model.adm", crank + "OUTPUT/REQSAVE, NOPRINT\nREQUEST/1, F2=5\nEND\n");
  write("model.acf",
        "model\nmodel\nOUTPUT/NOREQSAVE, GRSAVE\nSIMULATE/INITIAL\nOUTPUT/REQSAVE, OSFORMAT\nSIMULATE/INITIAL\n");
  const RunResult r = run_file("model.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("model.gra"));
  EXPECT_EQ(lines_of(r.text("model.req")).size(), 5u + 2);
  EXPECT_FALSE(r.wrote("model.out"));
  EXPECT_THAT(r.err, HasSubstr("nothing here acts on OUTPUT/OSFORMAT"));
}

TEST_F(StepOutputs, are_by_default_what_they_are_without_the_command) {
  write("model.adm", crank + "REQUEST/1, F2=5\nEND\n");
  for (const std::string asked : {"DEFAULT", "DEFAULT, FIXED"}) {
    write("model.acf", "model\nmodel\nOUTPUT/" + asked + "\nSIMULATE/INITIAL\n");
    const RunResult r = run_file("model.acf");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.wrote("model.out"), asked != "DEFAULT") << asked;
  }
}

TEST_F(StepOutputs, are_planned_before_anything_runs) {
  write("model.adm", crank + "OUTPUT/REQSAVE, GRSAVE\nREQUEST/1, F2=5\nEND\n");
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=model.req\n");
  EXPECT_THAT(run_file("model.acf").err, HasSubstr("and the request file are one file"));
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=model.gra\n");
  EXPECT_THAT(run_file("model.acf").err, HasSubstr("and the graphics file are one file"));
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=model.out\n");
  EXPECT_THAT(run_file("model.acf").err, HasSubstr("and the file of request tables are one file"));
  write("model.adm", crank + "END\n");
  write("model.acf", "model\nmodel\nOUTPUT/REQSAVE\nLINEAR/STATEMAT, FILE=model.req\n");
  EXPECT_THAT(run_file("model.acf").err, HasSubstr("and the request file are one file"));
}

TEST_F(StepOutputs, refuse_factors_that_mean_nothing) {
  write("model.adm", crank + "OUTPUT/DSCALE=1,2,3\nEND\n");
  write("model.acf", "model\nmodel\nSIMULATE/INITIAL\n");
  EXPECT_THAT(run_file("model.acf").err, HasSubstr("DSCALE takes one factor"));
}

}  // namespace
}  // namespace dynalin::cases::step_output_test
