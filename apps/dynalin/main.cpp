// The command-line program: arguments in, exit status out; everything else is the library's.
#include <CLI/CLI.hpp>
#include <iostream>

#include "base/diagnostics.h"
#include "command/session.h"

int main(int argc, char** argv) {
  using namespace dynalin;
  CLI::App app{"Dynalin: linear models of mechanisms from Adams datasets"};
  app.set_version_flag("--version", "dynalin 0.1.0");
  app.require_subcommand(1);

  SessionOptions options;
  std::string word;
  CLI::App* run = app.add_subcommand("run", "run a command file (.acf), or a dataset (.adm) with commands given by -c");
  run->add_option("FILE", options.file)->required();
  run->add_option("-c", options.commands, "a command, may be repeated")->allow_extra_args(false);
  run->add_option("--json", options.json, "write everything computed to this file");
  run->add_option("--output", options.output_prefix, "prefix of the output files");
  run->add_flag("--keep-going", options.keep_going, "go on after a command that failed");
  run->add_flag("--bounds", options.bounds, "say how exact each eigenvalue is");
  run->add_flag("--quiet", options.quiet, "no tables on the terminal");
  CLI::App* check = app.add_subcommand("check", "read and check a dataset or command file");
  check->add_option("FILE", options.file)->required();
  for (CLI::App* reading : {run, check})
    reading->add_flag("--pade", options.pade, "a DELAY is a first-order Pade approximant with a state, not e - tau e'");
  CLI::App* help = app.add_subcommand("help", "arguments of a statement, or the list of statements");
  help->add_option("STATEMENT", word);
  CLI::App* explain = app.add_subcommand("explain", "what a diagnostic code means");
  explain->add_option("CODE", word)->required();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? done : wrong_usage;
  }
  if (*run) return run_session(options, std::cout, std::cerr);
  if (*check) return check_file(options, std::cout, std::cerr);
  if (*help) return print_help(word, std::cout, std::cerr);
  const std::string_view text = explain_diagnostic(word);
  if (text.empty()) {
    std::cerr << "error: there is no diagnostic " << word << '\n';
    return wrong_usage;
  }
  std::cout << word << ": " << text << '\n';
  return done;
}
