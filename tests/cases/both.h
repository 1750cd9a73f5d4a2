// Runs through the program that the library repeats: doing the same, it has the same JSON to the last digit.
#pragma once

#include "cases/replay.h"
#include "cases/run.h"

namespace dynalin::cases {

class ProgramAndLibrary : public Cases {
 protected:
  RunResult run_file(const std::string& file) const { return compared(file, Cases::run_file(file)); }
  RunResult run(const std::string& dataset, const std::string& commands) const {
    return compared("model.acf", Cases::run(dataset, commands));
  }
  RunResult run_example(const std::string& folder, const std::string& file) const {
    return compared(file, Cases::run_example(folder, file));
  }

 private:
  RunResult compared(const std::string& file, RunResult r) const {
    if (r.json.is_null()) return r;  // wrong input, of which nothing is written
    SessionOptions options;
    options.file = (folder_ / file).string();
    nlohmann::ordered_json program = nlohmann::ordered_json::parse(read_file(folder_ / "results.json"));
    nlohmann::ordered_json library = Replay(options).run();
    for (auto* json : {&program, &library}) json->erase("files");  // the library writes none
    EXPECT_EQ(program, library) << nlohmann::json::diff(program, library).dump(1).substr(0, 2000);
    return r;
  }
};

}  // namespace dynalin::cases
