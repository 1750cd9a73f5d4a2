// REQUEST/id, {DISPLACEMENT | VELOCITY | ACCELERATION | FORCE}, I= [, J=] [, RM=]   or   F1=e\ … F8=e   or   VARIABLES=
//
// Values to be written over time; nothing depends on them. Of markers: marker I as seen from J (global origin), along
// the axes of RM (global), with the values of the functions
//
//     DISPLACEMENT   DM DX DY DZ     PSI THETA PHI of I in J
//     VELOCITY       VM VX VY VZ  WM WX WY WZ
//     ACCELERATION   ACCM ACCX ACCY ACCZ  WDTM WDTX WDTY WDTZ
//     FORCE          FM FX FY FZ  TM TX TY TZ: on I of all elements between I and J, of all on I without J
//
// CNAMES, CUNITS and CLABELS say what the components are called in the results file, RESULTS_NAME what they are
// together, TITLE the heads of the columns of a table.
#include <fmt/format.h>

#include <algorithm>

#include "elements/requests/lenient.h"
#include "elements/requests/request_kernel.h"
#include "model/missing_routine.h"
#include "model/model.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

// One way of asking ends the others.
constexpr std::string_view ended_by_functions = "DISPLACEMENT VELOCITY ACCELERATION FORCE I J RM VARIABLES FUNCTION";
constexpr std::string_view ended_by_variables =
    "DISPLACEMENT VELOCITY ACCELERATION FORCE I J RM F1 F2 F3 F4 F5 F6 F7 F8 FUNCTION";
constexpr std::string_view ended_by_markers =
    "DISPLACEMENT VELOCITY ACCELERATION FORCE F1 F2 F3 F4 F5 F6 F7 F8 VARIABLES FUNCTION";

struct Request {
  bool displacement = false, velocity = false, acceleration = false, force = false;
  std::optional<std::int64_t> i, j, rm;
  Obsolete function;  // F1 … F8 and texts are read by themselves
  Obsolete text;
  std::string routine;
  std::vector<std::int64_t> variables;

  static constexpr std::array<Argument<Request>, 25> arguments = {{
      {.name = "DISPLACEMENT",
       .slot = &Request::displacement,
       .help = "of I from J, and its orientation",
       .ends = ended_by_markers},
      {.name = "VELOCITY", .slot = &Request::velocity, .help = "of I relative to J", .ends = ended_by_markers},
      {.name = "ACCELERATION", .slot = &Request::acceleration, .help = "of I relative to J", .ends = ended_by_markers},
      {.name = "FORCE",
       .slot = &Request::force,
       .help = "on I of all elements between I and J",
       .ends = ended_by_markers},
      {.name = "I", .slot = &Request::i, .help = "marker, 0 for the global frame", .ids_of = MarkerClass::statement},
      {.name = "J",
       .slot = &Request::j,
       .help = "marker from which I is seen; the global frame",
       .ids_of = MarkerClass::statement},
      {.name = "RM",
       .slot = &Request::rm,
       .help = "marker along whose axes the values are; the global frame",
       .ids_of = MarkerClass::statement},
      {.name = "F1", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F2", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F3", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F4", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F5", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F6", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F7", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "F8", .slot = &Request::function, .help = "a value", .ends = ended_by_functions},
      {.name = "FUNCTION", .slot = &Request::text, .help = "USER(…), a compiled routine"},
      {.name = "ROUTINE", .slot = &Request::routine, .help = "of FUNCTION"},
      {.name = "VARIABLES",
       .slot = &Request::variables,
       .help = "VARIABLEs whose values are requested",
       .ends = ended_by_variables,
       .ids_of = VariableClass::statement},
      {.name = "COMMENT", .slot = &Request::text, .help = "one line above a table"},
      {.name = "TITLE", .slot = &Request::text, .help = "heads of the columns of a table, colons between them"},
      {.name = "CNAMES",
       .slot = &Request::text,
       .help = "names of the components in the results file; one without letters is not in it"},
      {.name = "CUNITS", .slot = &Request::text, .help = "their units"},
      {.name = "CLABELS", .slot = &Request::text, .help = "their labels in plots"},
      {.name = "RESULTS_NAME", .slot = &Request::text, .help = "name of the request in the results file"},
      {.name = "LABEL", .slot = &Request::text, .help = "a name"},
  }};

  std::vector<RequestKind> kinds() const {
    std::vector<RequestKind> list;
    if (displacement) list.push_back(RequestKind::displacement);
    if (velocity) list.push_back(RequestKind::velocity);
    if (acceleration) list.push_back(RequestKind::acceleration);
    if (force) list.push_back(RequestKind::force);
    return list;
  }
};

// What its arguments come to; without a list of components the request is left out.
struct RequestedValues {
  RequestInfo info;
  std::vector<Expression> functions;
};

std::string text_of(const ElementReader& reader, std::string_view name) {
  const WrittenArgument* w = written_argument(reader, name);
  if (!w || !w->has_value) return {};
  const auto list = split_texts(w->value_span().text(), '\0');
  return list.empty() ? std::string() : list.front();
}

std::vector<std::string> names_of(const ElementReader& reader, std::string_view name) {
  const WrittenArgument* w = written_argument(reader, name);
  return w && w->has_value ? split_names(w->value_span().text()) : std::vector<std::string>();
}

std::vector<std::string> heads_of(const ElementReader& reader, std::string_view name) {
  const WrittenArgument* w = written_argument(reader, name);
  return w && w->has_value ? split_texts(w->value_span().text(), ':') : std::vector<std::string>();
}

constexpr std::size_t places_of_request = 8;  // but for VARIABLES, of which there are as many as are named

class RequestSet final : public TypedSet<RequestedValues> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Request r;
    if (!read_arguments(r, reader)) return;
    RequestedValues& values = elements[k];
    values.info.request = {reader.label().element(), {}};
    values.info.view_name = reader.label().view_name;
    std::vector<RequestComponent> components;
    leniently(reader, [&] { return read_components(r, values, components, reader); });
    if (components.empty()) return;
    read_texts(values.info, components, reader);
    values.info.list = shared(std::move(components));
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<WantedRequest> wanted;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const RequestedValues& r = elements[k];
      if (r.info.list) wanted.push_back({&r.info, &labels[k], &r.functions});
    }
    return std::make_unique<RequestKernel>(std::move(wanted), layout);
  }

 private:
  static bool wrong(ElementReader& reader, std::string text, std::string hint = {}) {
    reader.error("request-left-out", reader.statement().at, std::move(text), std::move(hint));
    return false;
  }

  using Components = std::vector<RequestComponent>;

  // Most requests of a model have components like those of one before.
  std::shared_ptr<const Components> shared(Components components) {
    constexpr std::size_t most = 8;
    const auto known = std::ranges::find_if(lists_, [&](const auto& list) { return *list == components; });
    if (known != lists_.end()) return *known;
    if (lists_.size() == most) lists_.erase(lists_.begin());
    return lists_.emplace_back(std::make_shared<const Components>(std::move(components)));
  }

  static bool read_components(const Request& r, RequestedValues& values, Components& components,
                              ElementReader& reader) {
    const auto kinds = r.kinds();
    bool any_function = false;
    for (const std::string_view name : column_names(RequestKind::functions))
      any_function = any_function || reader.given(name);
    const WrittenArgument* call = written_argument(reader, "FUNCTION");
    if (call && call->damaged) return false;  // what is wrong with it is said
    if (call)
      return wrong(reader, "it calls a compiled routine, and no library that has it is named",
                   std::string(missing_routine::name_a_library_or_a_value));
    if (kinds.size() + any_function + !r.variables.empty() != 1)
      return wrong(reader, kinds.empty() && !any_function && r.variables.empty()
                               ? "it asks for nothing: neither markers nor functions nor VARIABLES"
                               : "it asks for more than one of markers, functions and VARIABLES");
    if (any_function) return read_functions(values, components, reader);
    if (!r.variables.empty()) return read_variables(r, values, components, reader);
    if (!r.i) return wrong(reader, "it needs the marker I");
    for (const auto& [id, name] : {std::pair{r.i, "I"}, std::pair{r.j, "J"}, std::pair{r.rm, "RM"}}) {
      if (id && *id != 0 && !reader.marker({*id, reader.at(name)}, name)) return false;
    }
    RequestInfo& info = values.info;
    info.kind = kinds.front();
    info.marker_I = *r.i, info.marker_J = r.j.value_or(0), info.axes = r.rm.value_or(0);
    components = *components_of(info.kind);
    return true;
  }

  static bool read_functions(RequestedValues& values, Components& all, ElementReader& reader) {
    Components components;
    int place = 0;
    for (const std::string_view name : column_names(RequestKind::functions)) {
      ++place;
      const WrittenArgument* w = written_argument(reader, name);
      if (!w) continue;
      auto e = reader.expression(*w);
      if (!e) {
        if (w->damaged) wrong(reader, std::string(name) + " cannot be read");
        return false;
      }
      values.functions.push_back(std::move(*e));
      components.push_back({.name = std::string(name), .place = place});
    }
    values.functions.shrink_to_fit();
    all = std::move(components);
    return true;
  }

  // Six of them stand where the six values of a request file are.
  static bool read_variables(const Request& r, RequestedValues& values, Components& components, ElementReader& reader) {
    constexpr std::array<int, 8> places = {2, 3, 4, 6, 7, 8, 1, 5};
    std::string text = "REQUEST/1";
    for (std::size_t k = 0; k < r.variables.size(); ++k) {
      const std::int64_t id = r.variables[k];
      if (!reader.element("VARIABLE", {id, reader.at("VARIABLES")})) return false;
      text += fmt::format(", FUNCTION=VARVAL({})", id);
    }
    const auto source = std::make_shared<const SourceText>("VARIABLES of " + reader.label().text(), text + "\n");
    reader.keep(source);
    static constexpr std::array<std::string_view, 1> keywords = {"REQUEST"};
    const Dataset read = parse_statements(source, keywords).value;
    for (const WrittenArgument& w : read.statements.front().arguments) {
      const std::size_t k = components.size();
      values.functions.push_back(*reader.expression(w));
      components.push_back(
          {.name = fmt::format("VARIABLE/{}", r.variables[k]), .place = k < places.size() ? places[k] : 0});
    }
    return true;
  }

  // What stands behind the last place has none to go to.
  static void warn_of_surplus(const std::vector<std::string>& texts, std::size_t places, std::string_view argument,
                              ElementReader& reader) {
    const auto stated = std::find_if(texts.rbegin(), texts.rend(), [](const std::string& t) { return !t.empty(); });
    const auto count = static_cast<std::size_t>(texts.rend() - stated);
    if (count <= places) return;
    reader.warning(
        "wrong-count", reader.at(argument),
        fmt::format("{} has {} texts for {} of {}, and what is too many is passed over", argument, count,
                    places == 1 ? "the one place" : fmt::format("the {} places", places), reader.label().text()));
  }

  // Texts belong to places, those of VARIABLES to the VARIABLEs in order.
  static void read_texts(RequestInfo& info, Components& components, ElementReader& reader) {
    info.comment = text_of(reader, "COMMENT"), info.results_name = text_of(reader, "RESULTS_NAME");
    const bool in_order = reader.given("VARIABLES");
    const auto names = names_of(reader, "CNAMES"), units = names_of(reader, "CUNITS"),
               labels = names_of(reader, "CLABELS");
    info.heads = heads_of(reader, "TITLE");
    const std::size_t places = in_order ? components.size() : places_of_request;
    warn_of_surplus(names, places, "CNAMES", reader), warn_of_surplus(units, places, "CUNITS", reader);
    warn_of_surplus(labels, places, "CLABELS", reader), warn_of_surplus(info.heads, places_of_request, "TITLE", reader);
    info.heads.resize(std::min(info.heads.size(), places_of_request));
    if (names.empty() && units.empty() && labels.empty()) return;
    for (std::size_t k = 0; k < components.size(); ++k) {
      RequestComponent& c = components[k];
      const std::size_t at = in_order ? k : static_cast<std::size_t>(c.place - 1);
      const auto of = [&](const std::vector<std::string>& list) { return at < list.size() ? list[at] : std::string(); };
      c.given = of(names), c.unit = of(units), c.label = of(labels);
      c.in_results = at >= names.size() || !c.given.empty();
    }
  }

  std::vector<std::shared_ptr<const Components>> lists_;  // made last
};

ToldToRoutine told_of_request(const StatementWords& s) {
  struct Heading {
    std::string comment;
    std::array<std::string, 8> titles;
  };
  Heading heading{s.text("COMMENT"), {}};
  std::string titles = s.text("TITLE");
  for (std::string& title : heading.titles) {
    const std::size_t end = std::min(titles.find(':'), titles.size());
    title = titles.substr(0, end);
    titles.erase(0, end + 1);
  }
  return told_with(std::move(heading), [&](const Heading& h) {
    sAdamsRequest said{s.id(), s.constants().count(), s.constants().data(), h.comment.c_str(), {}};
    for (std::size_t k = 0; k < h.titles.size(); ++k) said.TITLE[k] = h.titles[k].c_str();
    return said;
  });
}
constexpr std::array<ValueArgument, 8> columns_of_request = {
    {{"F1"}, {"F2"}, {"F3"}, {"F4"}, {"F5"}, {"F6"}, {"F7"}, {"F8"}}};
constexpr std::array<RoutineKind, 1> request_routines = {{{.routine = "reqsub",
                                                           .values = 8,
                                                           .arguments = RoutineArguments::plain,
                                                           .told = told_of_request,
                                                           .components = columns_of_request,
                                                           .constants = columns_of_request}}};

}  // namespace

extern constinit const Kind request =
    Kind{"REQUEST",
         "",
         "Values that are written over time.",
         Kind::Role::element,
         detail::argument_infos<Request>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<RequestSet>(kind); }}
        .deactivatable()
        .calling(request_routines)
        .giving(Kind::Gives::requests)
        .with_example("REQUEST/1, DISPLACEMENT, I=20, J=1");

}  // namespace dynalin
