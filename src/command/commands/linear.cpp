// LINEAR/{EIGENSOL | STATEMAT | MKB | EXPORT}, …: linearizes about the operating point and writes what comes out. Its
// arguments and the rules between them are in linear_command.cpp.
#include "command/commands/linear.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <ctime>

#include "command/mode_tables.h"
#include "command/output_plan.h"
#include "command/progress_line.h"
#include "command/run_state.h"
#include "linear/descriptor_form.h"
#include "nastran/export.h"
#include "output/descriptor_files.h"
#include "output/destination.h"
#include "output/message_file.h"
#include "study/linearization.h"
#include "study/modal_tables.h"
#include "system/operating_state.h"

namespace dynalin::commands {

namespace {

std::shared_ptr<const CommandAction> read(CommandReader& reader) {
  auto command = read_linear(reader);
  return command ? std::make_shared<Linear>(std::move(*command)) : nullptr;
}

LinearRequest request_of(const LinearCommand& command, const RunState& run) {
  const Environment& environment = run.environment;
  LinearRequest request;
  request.pstate = command.pstate, request.pinput = command.pinput, request.poutput = command.poutput;
  request.rm = command.rm;
  request.without_damping = command.without_damping;
  request.original = command.original;
  request.principal_states = environment.principal_states;
  request.without_rate_coupling = environment.without_rate_coupling;
  request.without_reconciliation = environment.without_reconciliation;
  request.dense_up_to = run.options.dense_up_to;
  return request;
}

// --modes stands for NMODES where the command says nothing itself and asks for nothing that needs all modes.
std::optional<ModeSelection> selection_of(const LinearCommand& command, const SessionOptions& options) {
  if (command.option != LinearOption::eigensol) return std::nullopt;
  if (command.selection || !options.modes || asks_for_all_modes(command.tables)) return command.selection;
  return NearestModes{static_cast<std::size_t>(*options.modes), 0};
}

nastran::Box box_of(const LinearCommand& command) {
  return command.type == "OPENBOX" ? nastran::Box::open : nastran::Box::closed;
}

// Up to how many states the state matrix is wanted.
Reduction reduction_of(const Linear& linear, const LinearRequest& request, bool selected) {
  const LinearCommand& command = linear.command;
  switch (command.option) {
    case LinearOption::eigensol:
      return {selected ? request.dense_up_to.value_or(selected_from_all_up_to) : all_modes_unannounced_up_to};
    case LinearOption::nastran_export:
      // An open box is put together element by element, and modes alone ask for the state matrix.
      return box_of(command) == nastran::Box::open && !linear.configuration.options.export_mode_shapes
                 ? Reduction::none
                 : Reduction::state_matrix;
    default:
      return {command.descriptor ? 0 : request.dense_up_to.value_or(state_matrices_up_to)};
  }
}

std::vector<std::string_view> descriptor_suffixes(const LinearCommand& command) {
  std::vector<std::string_view> list = {"_E.mtx", "_A.mtx"};
  if (command.pinput) list.push_back("_B.mtx");
  if (command.poutput) list.push_back("_C.mtx");
  if (command.pinput && command.poutput) list.push_back("_D.mtx");
  list.insert(list.end(), {".mat", "_labels.txt"});
  return list;
}

bool in_results(RunState& run) { return run.results() && !run.settings.results.without_linear; }

// State space or second order: the file, the states in the message file, and the other results.
template <class Form>
StudyResult<void> write_form(const Form& form, std::string_view which, const LinearCommand& command,
                             const OperatingState& state, RunState& run) {
  const std::string path = command_path(run.folder, command.file);
  if (auto written = run.files.add(matrix_files(path, command.format, named_matrices(form))); !written)
    return tl::unexpected(StudyFailure({"linear analysis", written.error(), {}}));
  write_matrix_states(run.message, form);
  if (in_results(run)) run.results()->add(form);
  run.json.add(run.command, form);
  run.json.add_point(state);
  if (run.terminal)
    fmt::print(*run.terminal, "{} matrices of {} state{}: {}{}\n", which, form.states.size(),
               form.states.size() == 1 ? "" : "s", path, command.format == "MATLAB" ? "*, a file each" : "");
  return {};
}

// The sparse equations, matrix by matrix and as a whole, and what their unknowns are.
StudyResult<void> write_descriptor(const Linearization& linear, const LinearCommand& command,
                                   const OperatingState& state, RunState& run) {
  const DescriptorForm form = descriptor_form(linear.linear);
  const std::string base = command_path(run.folder, command.file);
  const std::string equations =
      fmt::format("of E w' = A w + B u, y = C w + D u; the states are the unknowns from {} on", form.first_state + 1);
  std::vector<RunFiles::Planned> planned;
  for (const std::string_view suffix : descriptor_suffixes(command)) {
    planned.push_back({base + std::string(suffix), [&form, &equations, suffix](std::ostream& out) {
                         if (suffix == ".mat") return write_mat_file(out, form);
                         if (suffix == "_labels.txt") return write_labels(out, form);
                         const char name = suffix[1];
                         const auto& matrix = name == 'E'   ? form.E
                                              : name == 'A' ? form.A
                                              : name == 'B' ? form.B
                                              : name == 'C' ? form.C
                                                            : form.D;
                         write_matrix_market(out, matrix, fmt::format("{} {}", name, equations));
                       }});
  }
  if (auto written = run.files.add(planned); !written)
    return tl::unexpected(StudyFailure({"linear analysis", written.error(), {}}));
  write_matrix_states(run.message, linear.linear.model);
  fmt::print(run.message, "  Sparse equations: {} unknowns, {} entries, states from {} on\n\n", form.A.rows(),
             form.A.nonZeros(), form.first_state + 1);
  if (in_results(run)) run.results()->add(linear.linear.model);
  run.json.add(run.command, form);
  run.json.add_point(state);
  if (run.terminal) {
    fmt::print(*run.terminal, "sparse equations of {} state{} in {} unknowns: {}_E.mtx and others, {}.mat\n",
               form.states.size(), form.states.size() == 1 ? "" : "s", form.A.rows(), base, base);
  }
  return {};
}

StudyResult<void> write_deck(const Linearization& linear, const LinearCommand& command, const OperatingState& state,
                             const nastran::Configuration& configuration, RunState& run) {
  auto deck = nastran::export_deck(linear, box_of(command), configuration.options, command.file);
  if (!deck) return tl::unexpected(std::move(deck.error()));
  run.remarks.say(deck->remarks);
  std::vector<RunFiles::Planned> planned;
  std::vector<std::string> paths;
  for (const nastran::DeckFile& file : deck->files) {
    paths.push_back(command_path(run.folder, file.name));
    planned.push_back({paths.back(), [&file](std::ostream& out) { out << file.text; }});
  }
  if (auto written = run.files.add(planned); !written)
    return tl::unexpected(StudyFailure({"export", written.error(), {}}));
  fmt::print(run.message, "\n  Nastran deck, {}\n", command.type);
  for (const std::string& path : paths) fmt::print(run.message, "    {}\n", path);
  std::vector<std::string> details = configuration.echo;
  if (configuration.options.debug) details.insert(details.end(), deck->details.begin(), deck->details.end());
  for (const std::string& line : details) fmt::print(run.message, "    {}\n", line);
  run.json.add_export(run.command, command.type, linear.point.time, paths);
  run.json.add_point(state);
  if (run.terminal) {
    for (const std::string& line : details) fmt::print(*run.terminal, "{}\n", line);
    fmt::print(*run.terminal, "Nastran deck, {}: {}\n", command.type, fmt::join(paths, ", "));
  }
  return {};
}

StudyResult<void> solve_modes(const Linearization& linear, const LinearCommand& command,
                              const std::optional<ModeSelection>& selection, const OperatingState& state,
                              RunState& run) {
  if (linear.states() > 1000) {
    fmt::print(run.err, "computing {} eigenvalues of {} states ...\n", selection ? "selected" : "the", linear.states());
  }
  const std::clock_t begun = std::clock();
  const Vectors vectors = command.without_vectors ? Vectors::none : Vectors::right;
  ProgressLine line(run.status_line());
  const Progress progress = line.progress();
  const auto found = selection ? modes_of(linear, vectors, *selection, progress) : modes_of(linear, vectors, progress);
  line.clear();
  if (!found) return tl::unexpected(found.error());
  const double cpu_seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  const EigenSolution& modes = found->solution;
  run.remarks.say(found->remarks);
  // All that this command has to say is in the files of the run, or nothing of it.
  TablesFound tables;
  if (command.tables.any()) {
    line.say("tables of modes");
    auto made = modal_tables(linear, modes, command.tables);
    line.clear();
    if (!made) return tl::unexpected(made.error());
    tables = std::move(*made);
    run.tables << mode_tables_text(command, modes, tables);
  }
  write_eigensolution(run.message, modes, cpu_seconds);
  run.json.add(run.command, modes);
  run.json.add_point(state);
  run.json.add_tables(tables.tables);
  if (in_results(run)) run.results()->add(modes, tables.tables);
  run.remarks.say(tables.remarks);
  if (run.terminal) {
    fmt::print(*run.terminal, "{} at time {:g}\n", run.command, modes.time);
    if (modes.selected) fmt::print(*run.terminal, "{}", selection_text(*modes.selected, run.units().frequency()));
    write_eigen_table(*run.terminal, modes, run.units().frequency(), run.options.bounds);
    if (command.tables.any()) fmt::print(*run.terminal, "the tables of modes are in {}.txt\n", run.job.prefix);
  }
  return {};
}

}  // namespace

StudyResult<void> Linear::run(RunState& run) const {
  if (!run.point.consistent) {
    if (auto ready = run.make_consistent(); !ready) return ready;
  }
  // An open box has its masses and joints also where nothing can move, and a closed one says that it has nothing.
  const bool deck = command.option == LinearOption::nastran_export;
  const LinearRequest request = request_of(command, run);
  const std::optional<ModeSelection> selection = selection_of(command, run.options);
  const bool matrices = command.option == LinearOption::statemat || command.option == LinearOption::mkb;
  const Stateless stateless = deck ? Stateless::taken : matrices ? stateless_matrices(request) : Stateless::refused;
  ProgressLine line(run.status_line());
  line.say("linear model");
  auto linear = linearized(run.point, request, stateless, reduction_of(*this, request, selection.has_value()));
  line.clear();
  if (!linear) return tl::unexpected(linear.error());
  run.remarks.say(linear->remarks());
  if (matrices && !command.descriptor) {
    if (auto fits = check_size_of_matrices(linear->states(), request); !fits) return fits;
  }
  if (command.option != LinearOption::eigensol) run.remarks.say(remarks_of_matrices(*linear));
  if (command.option == LinearOption::eigensol && !selection) {
    run.remarks.say(cost_of_all_modes(linear->states()));
    if (!linear->has_state_matrix()) {
      line.say(fmt::format("state matrix of {} states", linear->states()));
      auto whole = with_state_matrix(*linear);
      line.clear();
      if (!whole) return tl::unexpected(whole.error());
      run.remarks.say(new_remarks(whole->remarks(), linear->remarks()));
      linear = std::move(whole);
    }
  }

  // Of a large model it is long, and its redundant rows take a while.
  const bool shows = !run.shown && !linear->at_rest_as_found;
  OperatingState state;
  if (shows || run.json.keeps_results()) state = operating_state(run.system(), linear->point);
  if (shows) run.show(StepKind::initial_conditions, state, linear->point);
  if (!run.json.keeps_results()) state = {};
  const auto written = [&]() -> StudyResult<void> {
    if (deck) return write_deck(*linear, command, state, configuration, run);
    if (command.option == LinearOption::eigensol) return solve_modes(*linear, command, selection, state, run);
    if (command.descriptor) return write_descriptor(*linear, command, state, run);
    if (command.option == LinearOption::statemat) return write_form(linear->linear.model, "state", command, state, run);
    const auto form = second_order_form(*linear);
    if (!form) return tl::unexpected(form.error());
    return write_form(*form, "second-order", command, state, run);
  }();
  if (written) run.json.add_requests(requests_at(run.system(), linear->point).values);
  return written;
}

std::shared_ptr<const CommandAction> Linear::with_inputs(const InputReader& read_text, Diagnostics& diagnostics) const {
  if (command.config.empty()) return nullptr;
  const SourceRef source = read_text(command.config);
  if (!source) return nullptr;
  auto read_file = nastran::read_configuration(source, box_of(command));
  diagnostics.append(std::move(read_file.diagnostics));
  auto ready = std::make_shared<Linear>(command);
  ready->configuration = std::move(read_file.value);
  return ready;
}

CommandFiles Linear::files() const {
  if (command.option == LinearOption::nastran_export) {
    std::vector<std::string> names = nastran::expected_files(box_of(command), configuration.options, command.file);
    CommandFiles deck{.file = std::move(names.front())};
    deck.more.assign(std::make_move_iterator(names.begin() + 1), std::make_move_iterator(names.end()));
    return deck;
  }
  CommandFiles files{.file = command.file, .tables = command.tables.any()};
  if (command.descriptor) files.suffixes = descriptor_suffixes(command);
  if (command.descriptor || command.format != "MATLAB") return files;
  std::vector<std::string_view>& list = files.suffixes;
  list = {"st"};
  if (command.option == LinearOption::statemat) {
    list.push_back("a");
    if (command.pinput) list.push_back("b");
  } else {
    list.insert(list.end(), {"m", "kb"});
    if (command.pinput) list.push_back("p");
  }
  if (command.pinput) list.push_back("pi");
  if (command.poutput) list.insert(list.end(), {"c", "po"});
  if (command.pinput && command.poutput) list.push_back("d");
  return files;
}

void Linear::check(const Model& model, const CommandPlace& place, Diagnostics& diagnostics) const {
  const auto need = [&](std::int64_t id, std::string_view statement, const Span& at) {
    const bool exists =
        statement == "MARKER" ? id > 0 && model.find_marker(id).has_value() : model.find(statement, id).has_value();
    if (!exists)
      diagnostics.error("unknown-element", at,
                        fmt::format("the command refers to {}/{}, which does not exist", statement, id));
  };
  const auto need_named = [&](const std::optional<std::int64_t>& id, std::string_view statement,
                              std::string_view argument) {
    if (id) need(*id, statement, place.value(argument));
  };
  nastran::check_references(configuration, model, diagnostics);
  for (const auto& [id, statement] : {std::pair{command.pstate, "PSTATE"}, std::pair{command.pinput, "PINPUT"},
                                      std::pair{command.poutput, "POUTPUT"}}) {
    need_named(id, statement, statement);
  }
  need_named(command.tables.modal_rm, "MARKER", "MODAL_RM");
  for (std::size_t k = 0; k < command.tables.markers.size(); ++k)
    need(command.tables.markers[k], "MARKER", place.number("MLIST", k));
  need_named(command.rm, "MARKER", "RM");
  const auto rm = command.rm ? model.find_marker(*command.rm) : std::nullopt;
  if (rm && model.marker(*rm).floating)
    diagnostics.error("floating-marker", place.value("RM"), fmt::format("RM=MARKER/{} is floating", *command.rm));
}

std::span<const CommandKind> linear() {
  static const CommandKind kind = {.name = "LINEAR",
                                   .use = CommandUse::analysis,
                                   .summary = "linearizes about the operating point and writes what comes out",
                                   .example = "LINEAR/EIGENSOL, RM=5, KINETIC=1,4",
                                   .arguments = linear_arguments(),
                                   .read = read};
  return {&kind, 1};
}

}  // namespace dynalin::commands
