// The command-line program: arguments in, exit status out; everything else is the library's.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <new>
#include <string_view>
#include <vector>

#include "base/working_folder.h"
#include "command/prompt.h"
#include "command/session.h"
#include "distributed/team.h"
#include "dynalin/version.h"
#include "line_editor.h"
#include "output/temporary_file.h"
#include "process.h"
#include "routine/routine_context.h"
#include "subcommands.h"

namespace {

// Without memory for a stream.
int fail(std::string_view text) {
  for (const std::string_view part : {std::string_view("error: "), text, std::string_view("\n")}) {
    if (::write(STDERR_FILENO, part.data(), part.size()) < 0) break;
  }
  return dynalin::analysis_failed;
}

// Slips of those who do not know the program yet: a file without `run`, a command without -c.
void hint_at_usage(const Subcommand& run, int argc, char** argv) {
  const std::vector<std::string_view> words(argv + 1, argv + argc);
  const auto ends = [](std::string_view w, std::string_view with) {
    std::string end(w.substr(w.size() < 4 ? 0 : w.size() - 4));
    for (char& c : end) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return end == with;
  };
  const auto names_commands = [&](std::string_view w) { return ends(w, ".acf"); };
  const auto names_file = [&](std::string_view w) { return ends(w, ".adm") || names_commands(w); };
  if (words.empty()) {
    std::cerr << "A first run: dynalin run model.adm -c \"LINEAR/EIGENSOL\"\n";
  } else if (names_file(words[0])) {
    std::cerr << "hint: dynalin run " << words[0] << (names_commands(words[0]) ? "\n" : " -c \"LINEAR/EIGENSOL\"\n");
  } else if (run.was_chosen() && words.size() > 2 && names_file(words[1]) && names_commands(words[2])) {
    std::cerr << "hint: dynalin run " << words[2]
              << "\n      a command file names its dataset itself, in its first line or in a command\n";
  } else if (run.was_chosen() && words.size() > 2 && names_file(words[1]) && !words[2].starts_with('-')) {
    std::cerr << "hint: dynalin run " << words[1] << " -c \"" << words[2] << "\"\n";
  }
}

// A prompt on a terminal; commands that another program or a file gives run as one session.
int run_without_subcommand(const CLI::App& app, const Subcommand& run, dynalin::SessionOptions& options, int argc,
                           char** argv) {
  if (::isatty(STDIN_FILENO) != 0) {
    LineEditor lines;
    return dynalin::run_prompt(options, lines, std::cout, std::cerr);
  }
  if (!has_piped_input()) {
    std::error_code none;
    if (!options.file.empty() && !std::filesystem::exists(options.file, none)) {
      std::cerr << "error: " << options.file << " is no subcommand, and there is no such file\n";
      return dynalin::wrong_usage;
    }
    std::cerr << app.help();
    hint_at_usage(run, argc, argv);
    return dynalin::wrong_usage;
  }
  if (options.file.empty()) options.file = "-";
  return take_commands(options) ? dynalin::run_session(options, std::cout, std::cerr) : dynalin::wrong_input;
}

int run(int argc, char** argv) {
  CLI::App app{"Dynalin: linear models of mechanisms from Adams datasets"};
  app.set_version_flag("--version", std::string("dynalin ") + dynalin::version);
  app.require_subcommand(0, 1);
  app.footer("Without a subcommand: a prompt, for commands one by one; dynalin model.adm opens it with a model.");

  dynalin::SessionOptions options;
  app.add_option("FILE", options.file, "a dataset or command file for a session at a prompt");
  RunSubcommand run(app, options);
  CheckSubcommand check(app, options);
  NastranSubcommand nastran(app);
  ReduceSubcommand reduce(app);
  HelpSubcommand help(app, reduce);
  ExplainSubcommand explain(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int status = app.exit(e);
    if (status == 0) return dynalin::done;
    hint_at_usage(run, argc, argv);
    return dynalin::wrong_usage;
  }
  if (!options.user_libraries.empty()) dynalin::name_routine_of_crash(), dynalin::keep_working_folder();
  for (Subcommand* chosen : std::initializer_list<Subcommand*>{&run, &check, &nastran, &reduce, &help, &explain}) {
    if (chosen->was_chosen()) return chosen->run();
  }
  return run_without_subcommand(app, run, options, argc, argv);
}

int run_to_the_end(int argc, char** argv) {
  try {
    const int status = run(argc, argv);
    errno = 0;
    std::cout.flush();
    if (std::cout) return status;
    // An earlier flush failed, and what it was told is lost: one more try is told the same.
    if (errno == 0 && ::write(STDOUT_FILENO, "\n", 1) >= 0) errno = 0;
    return fail(errno ? std::string("standard output cannot be written: ") + std::strerror(errno)
                      : std::string("standard output cannot be written"));
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::length_error&) {
    return fail("out of memory: something is larger than any memory");
  } catch (const std::exception& e) {
    return fail(std::string("unexpected: ") + e.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  use_kernels_of_processor(argv);
  if (!prepare_for_limited_memory(argv))
    return fail("out of memory: the limit on it leaves less than 144 MB beside the program");
  dynalin::Team team;
  if (!team.leads()) return team.serve();
  // A reader that has gone and a limit on the size of files are errors of writing like any other.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  dynalin::remove_temporary_files_on_signals();
  return team.end(run_to_the_end(argc, argv));
}
