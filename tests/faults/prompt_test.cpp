// The prompt, as a user has it: a terminal of its own for the program, keys in, a screen out. And commands by a pipe.
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "program.h"
#include "terminal.h"

namespace dynalin::faults::prompt_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Prompt : public Faults {};
constexpr const char* ready = "dynalin> ";

TEST_F(Prompt, runs_commands_one_by_one_and_passes_by_what_is_wrong) {
  Terminal t(folder_, {"model.adm"});
  t.until(ready);
  t.type("LINEAR/EIGENSOL\n");
  EXPECT_THAT(t.until("PART/2"), HasSubstr("0.3524"));
  t.until(ready);
  t.type("LINEAR/EIGENSOL, RM=99\n");
  EXPECT_THAT(t.until(ready), HasSubstr("refers to MARKER/99, which does not exist"));
  t.type("PART/2, MASS=4\n");
  t.until(ready);
  t.type("LINEAR/EIGENSOL\n");
  EXPECT_THAT(t.until("PART/2"), HasSubstr("0.4458")) << "the edit counts at once";
  t.until(ready);
  t.type("LINEAR/STATEMAT, FILE=matrix\n");
  t.until("wrote matrix");
  EXPECT_TRUE(there("matrix")) << "while the session goes on";
  t.until(ready);
  t.type("STOP\n");
  EXPECT_EQ(t.wait(), 0);
  EXPECT_THAT(text("model.msg"), HasSubstr("Finished -----"));
  EXPECT_THAT(text("history"), HasSubstr("MASS=4"));
}

TEST_F(Prompt, opens_without_a_model_and_loads_one) {
  Terminal t(folder_, {});
  t.until(ready);
  t.type("LINEAR/EIGENSOL\n");
  EXPECT_THAT(t.until(ready), HasSubstr("needs a model"));
  t.type("FILE/MODEL=model\n");
  t.until(ready);
  t.type("INFO/DISPL, I=20\n");
  EXPECT_THAT(t.until("PHI"), HasSubstr("Displacement of MARKER/20"));
  t.until(ready);
  t.type("\x04");  // the end of input is that of the session
  EXPECT_EQ(t.wait(), 0);
  EXPECT_TRUE(there("model.msg"));
}

TEST_F(Prompt, takes_the_end_of_input_typed_while_a_command_runs) {
  Terminal t(folder_, {"model.adm"});
  t.until(ready);
  t.type("SIMULATE/DYNAMIC, END=1000, STEPS=10000\n");
  t.until("10000");
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  t.type("\x04");
  EXPECT_EQ(t.wait(), 0);
  EXPECT_THAT(text("model.msg"), HasSubstr("Finished -----"));
}

TEST_F(Prompt, completes_names_arguments_and_ids) {
  Terminal t(folder_, {"model.adm"});
  t.until(ready);
  t.type("LINE\tEIGENS\t\n");
  t.until("PART/2");
  t.until(ready);
  t.type("JOINT/\t, LIST\n");  // there is one joint
  t.until("Current JOINT/1 data are");
  t.until(ready);
  t.type("MARKER/2\t");
  const std::string list = t.until("21");
  EXPECT_THAT(list, HasSubstr("20"));
  t.type("\x03");
  t.until("^C");
  t.until(ready);
  t.type("STOP\n");
  EXPECT_EQ(t.wait(), 0);
}

TEST_F(Prompt, is_interrupted_at_a_line_and_goes_on) {
  Terminal t(folder_, {"model.adm"});
  t.until(ready);
  t.type("LINEAR/EIG");
  t.type("\x03");
  t.until("^C");
  t.until(ready);
  t.type("TIME\n");
  t.until("The present time is");
  t.type("STOP\n");
  EXPECT_EQ(t.wait(), 0);
}

TEST_F(Prompt, ends_after_a_failure_where_simexit_asks_for_it) {
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"),
                 "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=10, FUNCTION=SQRT(-1-DX(20)**2)\n");
  write("model.adm", dataset);
  Terminal t(folder_, {"model.adm"});
  t.until(ready);
  t.type("LINEAR/EIGENSOL\n");
  EXPECT_THAT(t.until(ready), HasSubstr("failed"));
  t.type("PREF/SIMEXIT=ON\n");
  t.until(ready);
  t.type("LINEAR/EIGENSOL\n");
  EXPECT_EQ(t.wait(), 2);
}

TEST_F(Prompt, a_pipe_has_the_commands_for_a_dataset) {
  write("commands", "LINEAR/EIGENSOL\nSTOP\n");
  Surroundings piped;
  piped.prepare = [] { redirect(STDIN_FILENO, "commands", O_RDONLY); };
  const Outcome r = run({"model.adm"}, piped);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("0.3524"));
  write("commands", "model\npiped\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(run({"run", "-"}, piped).status, 0);
  EXPECT_TRUE(there("piped.msg"));
  EXPECT_EQ(run({}).status, 3) << "nothing is waited for";
}

TEST_F(Prompt, a_pipe_without_an_end_is_refused) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", "-"}, {"model.adm"}}) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    Surroundings piped;
    piped.prepare = [&] { ::dup2(ends[0], STDIN_FILENO); };
    const pid_t child = start(arguments, piped);
    ::close(ends[0]);
    std::string lines;
    for (int k = 0; k < 1000; ++k) lines += "simulate/statics\n";
    ::signal(SIGPIPE, SIG_IGN);
    while (::write(ends[1], lines.data(), lines.size()) > 0) {
    }
    ::close(ends[1]);
    const Outcome r = finish(child);
    EXPECT_EQ(r.status, 1) << r.signal << r.err;
    EXPECT_THAT(r.err, HasSubstr("standard input cannot be read: it is longer than 16 MiB"));
  }
}

}  // namespace
}  // namespace dynalin::faults::prompt_test
