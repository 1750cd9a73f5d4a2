// The command-line program: arguments in, exit status out; everything else is the library's.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <string_view>
#include <vector>

#include "base/program_heap.h"
#include "base/working_folder.h"
#include "command/help.h"
#include "command/prompt.h"
#include "command/session.h"
#include "distributed/team.h"
#include "dynalin/threads.h"
#include "dynalin/version.h"
#include "line_editor.h"
#include "nastran_reader/nastran_program.h"
#include "output/temporary_file.h"
#include "process.h"
#include "reduction/reduce_program.h"
#include "routine/routine_context.h"

namespace {

// Without memory for a stream.
int fail(std::string_view text) {
  for (const std::string_view part : {std::string_view("error: "), text, std::string_view("\n")}) {
    if (::write(STDERR_FILENO, part.data(), part.size()) < 0) break;
  }
  return dynalin::analysis_failed;
}

// Slips of those who do not know the program yet: a file without `run`, a command without -c.
void hint_at_usage(const CLI::App& run, int argc, char** argv) {
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
  } else if (run.parsed() && words.size() > 2 && names_file(words[1]) && names_commands(words[2])) {
    std::cerr << "hint: dynalin run " << words[2]
              << "\n      a command file names its dataset itself, in its first line or in a command\n";
  } else if (run.parsed() && words.size() > 2 && names_file(words[1]) && !words[2].starts_with('-')) {
    std::cerr << "hint: dynalin run " << words[1] << " -c \"" << words[2] << "\"\n";
  }
}

bool take_commands(dynalin::SessionOptions& options) {
  auto text = read_commands();
  if (text) {
    options.standard_input = std::move(*text);
  } else {
    std::cerr << "error: standard input cannot be read: " << text.error() << '\n';
  }
  return text.has_value();
}

int run(int argc, char** argv) {
  using namespace dynalin;
  CLI::App app{"Dynalin: linear models of mechanisms from Adams datasets"};
  app.set_version_flag("--version", std::string("dynalin ") + dynalin::version);
  app.require_subcommand(0, 1);
  app.footer("Without a subcommand: a prompt, for commands one by one; dynalin model.adm opens it with a model.");

  SessionOptions options;
  std::string word;
  app.add_option("FILE", options.file, "a dataset or command file for a session at a prompt");
  CLI::App* run = app.add_subcommand("run", "run a command file (.acf), or a dataset (.adm) with commands given by -c");
  run->add_option("FILE", options.file,
                  "a command file (.acf), a dataset (.adm) for -c, or - for commands on standard input")
      ->required();
  run->add_option("-c", options.commands, "a command, may be repeated")->allow_extra_args(false);
  const auto at_least = [](int least) {
    return CLI::Validator(
        [least](const std::string& text) {
          int value = least;
          const bool is_less = CLI::detail::lexical_cast(text, value) && value < least;
          return is_less ? fmt::format("{} is less than {}", text, least) : "";
        },
        fmt::format("from {}", least));
  };
  const CLI::Validator named(
      [](const std::string& name) {
        if (name.empty()) return std::string("its name is empty");
        return name.starts_with("--") ? fmt::format("{} is an option; ./{} is a file of that name", name, name) : "";
      },
      "");
  const CLI::Validator finite(
      [](const std::string& text) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(text, value);
        return is_number && !std::isfinite(value) ? fmt::format("{} is no finite number", text) : "";
      },
      "");
  run->add_option("--json", options.json, "write everything computed to this file")->check(named);
  run->add_option("--output", options.output_prefix, "prefix of the output files; FOLDER/ for their folder alone")
      ->check(named);
  run->add_option("--modes", options.modes, "so many of the lowest modes of every LINEAR/EIGENSOL instead of all")
      ->check(at_least(1));
  run->add_option("--dense-up-to", options.dense_up_to,
                  "states up to which selected modes are taken out of all (400) and state matrices are formed (5000)")
      ->check(at_least(0));
  std::size_t threads = thread_count();
  run->add_option(
         "--threads", threads,
         "that share the work, as many as there are cores; results depend on it by the rounding of all modes of "
         "more than 500 states alone")
      ->check(at_least(1));
  run->add_flag("--keep-going", options.keep_going, "go on after a command that failed");
  run->add_flag("--bounds", options.bounds, "say how exact each eigenvalue is");
  run->add_flag("--state", options.state, "print every operating point: positions, velocities, reactions, forces ...");
  run->add_flag("--quiet", options.quiet, "no tables on the terminal");
  CLI::App* check = app.add_subcommand("check", "read and check a dataset or command file");
  check
      ->add_option("FILE", options.file, "a dataset (.adm) or command file (.acf), or - for commands on standard input")
      ->required();
  for (CLI::App* reading : {run, check}) {
    reading->add_flag("--pade", options.pade, "a DELAY is a first-order Pade approximant with a state, not e - tau e'");
    reading->add_option("--user-value", options.user_value, "a constant in the place of each compiled routine")
        ->check(finite);
    reading
        ->add_option(
            "--user-library", options.user_libraries,
            "a shared library with compiled routines, or a folder with those that ROUTINE= names; may be repeated")
        ->allow_extra_args(false);
    reading->add_flag("--difference-user-routines", options.difference_user_routines,
                      "differences where a compiled routine gives no derivatives, in linear models too");
  }
  nastran_reader::SolveOptions deck;
  CLI::App* nastran = app.add_subcommand("nastran", "check or solve a Nastran deck");
  nastran->require_subcommand(1);
  CLI::App* check_nastran = nastran->add_subcommand("check", "read a deck and say what is wrong with it");
  CLI::App* solve_nastran = nastran->add_subcommand("solve", "eigenvalues (SOL 107) or frequency response (SOL 108)");
  for (CLI::App* reading : {check_nastran, solve_nastran}) reading->add_option("DECK", deck.deck)->required();
  solve_nastran->add_option("--json", deck.json, "write the results to this file");
  solve_nastran->add_option("--modes", deck.modes, "print the shapes of these modes");
  solve_nastran->add_flag("--ignore-unknown", deck.ignore_unknown, "leave out cards that are not known");
  reduction::ReduceOptions body;
  CLI::App* reduce = app.add_subcommand("reduce", "a flexible body out of matrices of a finite-element program");
  reduce->add_option("--stiffness", body.stiffness, "CalculiX .sti, Matrix Market, or DMIG")->required();
  reduce->add_option("--mass", body.mass, "CalculiX .mas, Matrix Market, or DMIG")->required();
  reduce->add_option("--freedoms", body.freedoms, "node.direction of each row; otherwise .dof beside the stiffness");
  reduce->add_option("--nodes", body.nodes, "lines of node, x, y, z, an input deck with *NODE, or one with GRID")
      ->required();
  reduce->add_option("--stiffness-name", body.stiffness_name, "of DMIG where there are several");
  reduce->add_option("--mass-name", body.mass_name, "of DMIG where there are several");
  reduce->add_option("--interface", body.interface, "nodes for markers, 1,17 or, with a rotation node, 1001:1002")
      ->required();
  reduce->add_option("--also", body.also, "further nodes that the body file has");
  reduce->add_option("--modes", body.modes, "fixed-interface modes, at most (20)")->check(at_least(0));
  reduce->add_option("--frequency-limit", body.frequency_limit, "of these, cycles per unit of time");
  reduce->add_flag("--translations-only", body.translations_only, "interface nodes may be without rotations");
  reduce->add_option("--length-factor", body.length_factor, "1000 for metres to millimetres");
  reduce->add_option("--mass-factor", body.mass_factor, "1000 for tonnes to kilograms");
  reduce->add_option("--force-factor", body.force_factor, "between units of force");
  reduce->add_option("--output", body.output, "the body file (.fem)")->required();
  CLI::App* help = app.add_subcommand("help", "a statement, command or function, or the list of them");
  help->add_option("NAME", word, "LINEAR, JOINT, STEP …");
  CLI::App* explain = app.add_subcommand("explain", "what a message means, or the list of messages");
  explain->add_option("CODE", word, "what stands in brackets behind the message");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int status = app.exit(e);
    if (status == 0) return done;
    hint_at_usage(*run, argc, argv);
    return wrong_usage;
  }
  if (!options.user_libraries.empty()) name_routine_of_crash(), keep_working_folder();
  const bool command_given = !app.get_subcommands().empty();
  if (!command_given) {
    if (::isatty(STDIN_FILENO) != 0) {
      LineEditor lines;
      return run_prompt(options, lines, std::cout, std::cerr);
    }
    if (!has_piped_input()) {
      std::error_code none;
      if (!options.file.empty() && !std::filesystem::exists(options.file, none)) {
        std::cerr << "error: " << options.file << " is no subcommand, and there is no such file\n";
        return wrong_usage;
      }
      std::cerr << app.help();
      hint_at_usage(*run, argc, argv);
      return wrong_usage;
    }
    if (options.file.empty()) options.file = "-";
    return take_commands(options) ? run_session(options, std::cout, std::cerr) : wrong_input;
  }
  if (*run) {
    if (options.file == "-" && !take_commands(options)) return wrong_input;
    set_thread_count(has_memory_for_threads() ? threads : 1);
    prepare_heap();
    return run_session(options, std::cout, std::cerr);
  }
  if (*check) {
    if (options.file == "-" && !take_commands(options)) return wrong_input;
    return check_file(options, std::cout, std::cerr);
  }
  if (*check_nastran) return nastran_reader::check_deck(deck.deck, std::cout, std::cerr);
  if (*solve_nastran) return nastran_reader::solve_deck(deck, std::cout, std::cerr);
  if (*reduce) return reduction::reduce(body, std::cout, std::cerr);
  if (*help && word == "reduce") {  // no name of the language: its options say it all
    std::cout << reduce->help();
    return done;
  }
  if (*help) return print_help(word, std::cout, std::cerr);
  return print_explanation(word, std::cout, std::cerr);
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
