// The line on a terminal that says how far a command is.
#include <gmock/gmock.h>

#include "program.h"
#include "terminal.h"

namespace dynalin::faults::status_line_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* no_more = "\r\033[K";  // takes the line away

class StatusLine : public Faults {
 protected:
  // A chain that hangs and is drawn askew, of as many links as a command takes some times as long for as the line
  // waits.
  void write_chain(int links) const {
    std::string text = "chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\n";
    for (int k = 1; k <= links; ++k) {
      const std::string part = std::to_string(k + 1), bottom = std::to_string(100'000 + k);
      const std::string above = k == 1 ? "1" : std::to_string(100'000 + k - 1);
      const std::string top = std::to_string(200'000 + k), centre = std::to_string(300'000 + k);
      text += "PART/" + part + ", MASS=1, CM=" + centre + ", IP=1,1,1, QG=0.01," + std::to_string(-k) + ",0\nMARKER/" +
              centre + ", PART=" + part + "\nMARKER/" + top + ", PART=" + part + ", QP=0,1,0\nMARKER/" + bottom +
              ", PART=" + part + "\nJOINT/" + std::to_string(k) + ", REVOLUTE, I=" + top + ", J=" + above + "\n";
    }
    write("chain.adm", text + "END\n");
  }
  std::vector<std::string> running(const std::string& command, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run", "chain.adm"};
    for (const std::string& word : more) words.push_back(word);
    words.insert(words.end(), {"-c", command});
    return words;
  }
};

struct Long {
  std::string command;
  int links;
  std::string says, and_then;
};

// The line is written a few times a second: what a fast machine is through with sooner is asked of a longer chain.
TEST_F(StatusLine, a_long_command_says_what_it_is_doing_and_takes_the_line_away) {
  for (const Long& c : {Long{"SIMULATE/INITIAL_CONDITIONS", 4000, "\rinitial conditions: ", "wrote "},
                        Long{"SIMULATE/STATICS", 4000, "\rstatic equilibrium: ", "static equilibrium after "},
                        Long{"LINEAR/EIGENSOL, NMODES=3", 1000, "\rselected modes: ", "LINEAR/EIGENSOL"},
                        Long{"LINEAR/EIGENSOL", 200, "\rall modes: ", "LINEAR/EIGENSOL"}}) {
    std::string shown;
    std::size_t said = std::string::npos;
    for (int longer = 1; said == std::string::npos && longer <= 8; longer *= 2) {
      write_chain(longer * c.links);
      Terminal terminal(folder_, running(c.command));
      shown = terminal.rest();
      EXPECT_EQ(terminal.wait(), 0) << c.command;
      said = shown.find(c.says);
    }
    ASSERT_NE(said, std::string::npos) << shown.substr(0, 2000);
    const std::size_t away = shown.find(no_more, said);
    ASSERT_NE(away, std::string::npos) << shown.substr(0, 2000);
    EXPECT_NE(shown.find(c.and_then, away), std::string::npos) << shown.substr(0, 2000);
  }
}

TEST_F(StatusLine, nobody_else_sees_it) {
  write_chain(4000);
  const std::string command = "SIMULATE/INITIAL_CONDITIONS";
  EXPECT_THAT(run(running(command)).out, Not(HasSubstr("\r"))) << "no terminal";
  for (const std::string& name : names()) EXPECT_THAT(text(name), Not(HasSubstr("\033"))) << name;
  Terminal quiet(folder_, running(command, {"--quiet"}));
  EXPECT_THAT(quiet.rest(), Not(HasSubstr("\033")));
  Terminal off(folder_, running(command, {"-c", "PREFERENCES/STATUS_MESSAGE=OFF"}));
  EXPECT_THAT(off.rest(), Not(HasSubstr("\033")));
}

}  // namespace
}  // namespace dynalin::faults::status_line_test
