// The example of docs/json.md is what the program writes: the same keys in the same order, the same values.
#include <cmath>
#include <set>

#include "cases/run.h"
#include "places/source_tree.h"

namespace dynalin::cases::json_page_test {
namespace {

using Json = nlohmann::ordered_json;

class JsonPage : public Cases {
 protected:
  static std::string page() { return read_file(element_pages().parent_path() / "json.md"); }
  static std::string fence(const std::string& text, const std::string& kind) {
    const auto start = text.find("\n```" + kind + "\n") + 5 + kind.size();
    return text.substr(start, text.find("\n```", start) - start + 1);
  }
};

// Numbers that say how exact others are differ from one machine to the next.
bool varies(const std::string& key) {
  static const std::set<std::string> keys = {"condition", "backward_error", "error_bound_hz", "imbalance"};
  return keys.contains(key);
}

void expect_same(const Json& written, const Json& expected, const std::string& at) {
  ASSERT_EQ(written.is_number(), expected.is_number()) << at;
  if (expected.is_number()) {
    const double value = written.get<double>(), wanted = expected.get<double>();
    EXPECT_NEAR(value, wanted, 1e-9 * std::max(1.0, std::abs(wanted))) << at;
    return;
  }
  ASSERT_EQ(written.type(), expected.type()) << at;
  if (!expected.is_structured()) {
    EXPECT_EQ(written, expected) << at;
    return;
  }
  ASSERT_EQ(written.size(), expected.size()) << at << "\n" << written.dump(1);
  if (expected.is_array()) {
    for (std::size_t k = 0; k < expected.size(); ++k)
      expect_same(written[k], expected[k], at + "[" + std::to_string(k) + "]");
    return;
  }
  auto w = written.begin();
  for (auto e = expected.begin(); e != expected.end(); ++e, ++w) {
    ASSERT_EQ(w.key(), e.key()) << at;
    if (!varies(e.key())) expect_same(w.value(), e.value(), at + "." + e.key());
  }
}

TEST_F(JsonPage, shows_what_is_written) {
  const std::string text = page();
  write("rod.adm", fence(text, "adm"));
  write("rod.acf", "rod\nrod\n" + fence(text, "acf"));
  SessionOptions options;
  options.file = (folder_ / "rod.acf").string();
  options.json = (folder_ / "rod.json").string();
  std::ostringstream out, err;
  ASSERT_EQ(run_session(options, out, err), 0) << err.str();
  std::string written = read_file(options.json);
  for (auto at = written.find(folder_.string()); at != std::string::npos; at = written.find(folder_.string(), at))
    written.erase(at, folder_.string().size() + 1);
  expect_same(Json::parse(written), Json::parse(fence(text, "json")), "");
}

// Every key that the program writes is explained in the tables of the page.
TEST_F(JsonPage, names_every_key) {
  const std::string text = page(), prose = text.substr(0, text.find("## Example"));
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n! adams_view_name='cart'\nPART/2, MASS=1, CM=20, "
          "IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, "
          "FUNCTION=VARVAL(1)-DZ(20)\nVARIABLE/1, FUNCTION=0\nVARIABLE/2, FUNCTION=DZ(20)\nPINPUT/1, VARIABLES=1\n"
          "POUTPUT/1, VARIABLES=2\nDIFF/1, FUNCTION=-DIF(1)\nINTEGRATOR/FIXIT=1\nEND\n",
          "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=a\nLINEAR/MKB, FILE=b\n"
          "LINEAR/EIGENSOL, NMODES=1\nLINEAR/EIGENSOL, BAND=1,2\nLINEAR/STATEMAT, DESCRIPTOR, FILE=d\n"
          "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=c\n"
          "DEACTIVATE/SFORCE, ID=1\n");
  const RunResult failed =
      run("t\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-1\nPART/1, GROUND\nPART/2, MASS=1, CM=20, "
          "IP=1,1,1\nMARKER/20\nEND\n",
          "SIMULATE/STATICS\n");
  std::set<std::string> keys;
  const auto collect = [&](const auto& self, const nlohmann::json& value) -> void {
    if (value.is_object()) {
      for (const auto& [key, inside] : value.items()) keys.insert(key), self(self, inside);
    } else if (value.is_array()) {
      for (const auto& inside : value) self(self, inside);
    }
  };
  collect(collect, r.json), collect(collect, failed.json);
  EXPECT_GT(keys.size(), 70u);
  for (const std::string& key : keys) EXPECT_NE(prose.find("`" + key + "`"), std::string::npos) << key;
}

}  // namespace
}  // namespace dynalin::cases::json_page_test
