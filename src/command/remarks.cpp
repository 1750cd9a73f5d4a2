#include "command/remarks.h"

#include <fmt/ostream.h>

#include "base/remark_of.h"
#include "command/failure_text.h"
#include "output/message_file.h"
#include "study/study_point.h"

namespace dynalin {

void Remarks::say(const Diagnostic& d) {
  write_block(message_, Block::warning, d.message);
  err_ << render(d);
  json_.add_warning(command_, remark_of(d));
}

void Remarks::say(const Diagnostics& all) {
  for (const Diagnostic& d : all.items()) say(d);
}

void Remarks::say(std::string_view code, std::string text) {
  Diagnostics one;
  one.warning(code, {}, std::move(text));
  say(one);
}

void Remarks::pass_over(const std::vector<std::string>& settings) {
  std::vector<std::string> fresh;
  for (const std::string& s : settings) {
    if (passed_over_.insert(s).second) fresh.push_back(s);
  }
  say(passed_over(fresh));
}

void Remarks::report(const Failure& f) {
  write_block(message_, Block::error, failure_text(f));
  fmt::print(err_, "error: {} failed\n{}\n", command_, short_failure_text(f, message_file_));
  json_.add_failure(command_, fmt::format("{}: {}", f.analysis, f.message), f.details, f.code);
}

}  // namespace dynalin
