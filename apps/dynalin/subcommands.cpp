#include "subcommands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iostream>
#include <utility>

#include "base/program_heap.h"
#include "command/help.h"
#include "dynalin/threads.h"
#include "process.h"

using dynalin::SessionOptions;

namespace {

CLI::Validator at_least(int least) {
  return CLI::Validator(
      [least](const std::string& text) {
        int value = least;
        const bool is_less = CLI::detail::lexical_cast(text, value) && value < least;
        return is_less ? fmt::format("{} is less than {}", text, least) : "";
      },
      fmt::format("from {}", least));
}

// Of a file that is written.
CLI::Validator named() {
  return CLI::Validator(
      [](const std::string& name) {
        if (name.empty()) return std::string("its name is empty");
        return name.starts_with("--") ? fmt::format("{} is an option; ./{} is a file of that name", name, name) : "";
      },
      "");
}

CLI::Validator finite() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(text, value);
        return is_number && !std::isfinite(value) ? fmt::format("{} is no finite number", text) : "";
      },
      "");
}

// Words that the shell has taken apart.
std::string with_blanks(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// How a model is read, whatever becomes of it.
void add_options_of_reading(CLI::App& app, SessionOptions& options) {
  app.add_flag("--pade", options.pade, "a DELAY is a first-order Pade approximant with a state, not e - tau e'");
  app.add_option("--user-value", options.user_value, "a constant in the place of each compiled routine")
      ->check(finite());
  app.add_option("--user-library", options.user_libraries,
                 "a shared library with compiled routines, or a folder with those that ROUTINE= names; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("--difference-user-routines", options.difference_user_routines,
               "differences where a compiled routine gives no derivatives, in linear models too");
}

}  // namespace

bool take_commands(SessionOptions& options) {
  auto text = read_commands();
  if (text) {
    options.standard_input = std::move(*text);
  } else {
    std::cerr << "error: standard input cannot be read: " << text.error() << '\n';
  }
  return text.has_value();
}

RunSubcommand::RunSubcommand(CLI::App& of, SessionOptions& options)
    : Subcommand(of, "run", "run a command file (.acf), or a dataset (.adm) with commands given by -c"),
      options_(options),
      threads_(dynalin::thread_count()) {
  app_.add_option("FILE", options.file,
                  "a command file (.acf), a dataset (.adm) for -c, or - for commands on standard input")
      ->required();
  app_.add_option("-c", options.commands, "a command, may be repeated")->allow_extra_args(false);
  app_.add_option("--json", options.json, "write everything computed to this file")->check(named());
  app_.add_option("--output", options.output_prefix, "prefix of the output files; FOLDER/ for their folder alone")
      ->check(named());
  app_.add_option("--modes", options.modes, "so many of the lowest modes of every LINEAR/EIGENSOL instead of all")
      ->check(at_least(1));
  app_.add_option("--dense-up-to", options.dense_up_to,
                  "states up to which selected modes are taken out of all (400) and state matrices are formed (5000)")
      ->check(at_least(0));
  app_.add_option(
          "--threads", threads_,
          "that share the work, as many as there are cores; results depend on it by the rounding of all modes of "
          "more than 500 states alone")
      ->check(at_least(1));
  app_.add_flag("--keep-going", options.keep_going, "go on after a command that failed");
  app_.add_flag("--bounds", options.bounds, "say how exact each eigenvalue is");
  app_.add_flag("--state", options.state, "print every operating point: positions, velocities, reactions, forces ...");
  app_.add_flag("--quiet", options.quiet,
                "nothing on standard output but what asks for it by -: warnings and errors alone");
  add_options_of_reading(app_, options);
}

int RunSubcommand::run() {
  if (options_.file == "-" && !take_commands(options_)) return dynalin::wrong_input;
  dynalin::set_thread_count(has_memory_for_threads() ? threads_ : 1);
  dynalin::prepare_heap();
  return dynalin::run_session(options_, std::cout, std::cerr);
}

CheckSubcommand::CheckSubcommand(CLI::App& of, SessionOptions& options)
    : Subcommand(of, "check", "read and check a dataset or command file"), options_(options) {
  app_.add_option("FILE", options.file, "a dataset (.adm) or command file (.acf), or - for commands on standard input")
      ->required();
  add_options_of_reading(app_, options);
}

int CheckSubcommand::run() {
  if (options_.file == "-" && !take_commands(options_)) return dynalin::wrong_input;
  return dynalin::check_file(options_, std::cout, std::cerr);
}

NastranSubcommand::NastranSubcommand(CLI::App& of)
    : Subcommand(of, "nastran", "check or solve a Nastran deck"),
      check_(*app_.add_subcommand("check", "read a deck and say what is wrong with it")),
      solve_(*app_.add_subcommand("solve", "eigenvalues (SOL 107) or frequency response (SOL 108)")) {
  app_.require_subcommand(1);
  for (CLI::App* reading : {&check_, &solve_}) reading->add_option("DECK", deck_.deck)->required();
  solve_.add_option("--json", deck_.json, "write the results to this file");
  solve_.add_option("--modes", deck_.modes, "print the shapes of these modes");
  solve_.add_flag("--ignore-unknown", deck_.ignore_unknown, "leave out cards that are not known");
}

int NastranSubcommand::run() {
  using namespace dynalin::nastran_reader;
  return check_.parsed() ? check_deck(deck_.deck, std::cout, std::cerr) : solve_deck(deck_, std::cout, std::cerr);
}

ReduceSubcommand::ReduceSubcommand(CLI::App& of)
    : Subcommand(of, "reduce", "a flexible body out of matrices of a finite-element program") {
  app_.add_option("--stiffness", body_.stiffness, "CalculiX .sti, Matrix Market, or DMIG")->required();
  app_.add_option("--mass", body_.mass, "CalculiX .mas, Matrix Market, or DMIG")->required();
  app_.add_option("--freedoms", body_.freedoms, "node.direction of each row; otherwise .dof beside the stiffness");
  app_.add_option("--nodes", body_.nodes, "lines of node, x, y, z, an input deck with *NODE, or one with GRID")
      ->required();
  app_.add_option("--stiffness-name", body_.stiffness_name, "of DMIG where there are several");
  app_.add_option("--mass-name", body_.mass_name, "of DMIG where there are several");
  app_.add_option("--interface", body_.interface, "nodes for markers, 1,17 or, with a rotation node, 1001:1002")
      ->required();
  app_.add_option("--also", body_.also, "further nodes that the body file has");
  app_.add_option("--modes", body_.modes, "fixed-interface modes, at most (20)")->check(at_least(0));
  app_.add_option("--frequency-limit", body_.frequency_limit, "of these, cycles per unit of time");
  app_.add_flag("--translations-only", body_.translations_only, "interface nodes may be without rotations");
  app_.add_option("--length-factor", body_.length_factor, "1000 for metres to millimetres");
  app_.add_option("--mass-factor", body_.mass_factor, "1000 for tonnes to kilograms");
  app_.add_option("--force-factor", body_.force_factor, "between units of force");
  app_.add_option("--output", body_.output, "the body file (.fem)")->required();
}

int ReduceSubcommand::run() { return dynalin::reduction::reduce(body_, std::cout, std::cerr); }

HelpSubcommand::HelpSubcommand(CLI::App& of, const ReduceSubcommand& reduce)
    : Subcommand(of, "help", "a statement, command or function, or the list of them"), reduce_(reduce) {
  app_.add_option("NAME", words_, "LINEAR, JOINT, JOINT REVOLUTE, STEP …");
}

int HelpSubcommand::run() {
  const std::string name = with_blanks(words_);
  if (name == "reduce") {  // no name of the language: its options say it all
    std::cout << reduce_.help();
    return dynalin::done;
  }
  return dynalin::print_help(name, std::cout, std::cerr);
}

ExplainSubcommand::ExplainSubcommand(CLI::App& of)
    : Subcommand(of, "explain", "what a message means, or the list of messages") {
  app_.add_option("CODE", words_, "what stands in brackets behind the message, or words of it");
}

int ExplainSubcommand::run() { return dynalin::print_explanation(with_blanks(words_), std::cout, std::cerr); }
