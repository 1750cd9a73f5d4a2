// Arguments declared as data: name, member, unit and limits in one line of the element, and the one
// function that reads any statement by such a table.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "model/kind.h"
#include "model/reader.h"

namespace dynalin {

// Dimensions; a dataset has consistent units, so nothing is converted.
namespace unit {
inline constexpr Unit none;
inline constexpr Unit length = "length";
inline constexpr Unit angle = {"rad", true};
inline constexpr Unit mass = "mass";
inline constexpr Unit force = "force";
inline constexpr Unit torque = "force·length";
inline constexpr Unit velocity = "length/time";
inline constexpr Unit angular_velocity = {"rad/time", true};
inline constexpr Unit acceleration = "length/time²";
inline constexpr Unit inertia = "mass·length²";
inline constexpr Unit stiffness = "force/length";
inline constexpr Unit damping = "force·time/length";
inline constexpr Unit angular_stiffness = {"force·length/rad", true};
inline constexpr Unit angular_damping = {"force·length·time/rad", true};
}  // namespace unit

// Marks an argument of another type of the statement, so that an abbreviation here does not take it.
struct ElsewhereOnly {};

// A word that may be followed by a number: CONTROL_POINTS or CONTROL_POINTS=6.
struct WordOrCount {
  bool given = false;
  std::optional<std::int64_t> count;
};

// A word that may stand alone or with another one as its value: FULL or FULL=RORDER.
struct OptionalWord {
  bool given = false;
  std::string word;  // as written
};

// An argument of old datasets that has no effect any more: whatever it is given is passed over.
struct Obsolete {};

// FUNCTION=USER(…) of a statement whose function is always a subroutine: an error that names it.
struct UserSubroutine {
  std::string_view name;  // "FIESUB"
};

template <class E>
using Slot = std::variant<bool E::*, ElsewhereOnly E::*, Obsolete E::*, double E::*, std::optional<double> E::*,
                          Vector E::*, std::optional<Vector> E::*, std::vector<double> E::*,
                          std::vector<std::vector<double>> E::*, std::optional<std::int64_t> E::*, MarkerId E::*,
                          BodyId E::*, VariableRef E::*, ArrayRef E::*, MatrixRef E::*, JointRef E::*, CurveRef E::*,
                          FlexBodyRef E::*, WordOrCount E::*, OptionalWord E::*, UserSubroutine E::*,
                          std::vector<VariableRef> E::*, std::vector<JointRef> E::*, std::vector<std::int64_t> E::*,
                          Expression E::*, VectorExpression E::*, std::string E::*, std::vector<std::string> E::*>;

template <class E>
struct Argument {
  std::string_view name;
  Slot<E> slot;
  bool required = false;
  Unit unit{};
  double minimum = -std::numeric_limits<double>::infinity();
  std::string_view help{};
  double maximum = std::numeric_limits<double>::infinity();
  std::string_view ends{};  // see ArgumentInfo
  StatedStart start = StatedStart::nothing;
  std::size_t count = 0;             // of a list: so many numbers
  std::optional<double> unstated{};  // of a list or vector: each of its numbers where it is not stated
  std::string_view ids_of{};         // of ids that are kept as they are written: the statement whose they are
};

// Reading one value into one member: false after a reported error.
struct ValueLimits {
  std::string_view argument;
  double minimum, maximum;
};
bool read_value(double&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(ElsewhereOnly&, const WrittenArgument&, const ValueLimits&, ElementReader&);
inline bool read_value(Obsolete&, const WrittenArgument&, const ValueLimits&, ElementReader&) { return true; }
bool read_value(std::optional<double>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(Vector&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(std::optional<Vector>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(std::vector<double>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
// One list more with every time the argument is written.
bool read_value(std::vector<std::vector<double>>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(std::optional<std::int64_t>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(MarkerId&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(BodyId&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(WordOrCount&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(OptionalWord&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(UserSubroutine&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(ElementHandle&, std::string_view statement, const WrittenArgument&, ElementReader&);
bool read_value(std::vector<ElementHandle>&, std::string_view statement, const WrittenArgument&, ElementReader&);
bool read_value(std::vector<std::int64_t>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(Expression&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(VectorExpression&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(std::string&, const WrittenArgument&, const ValueLimits&, ElementReader&);
bool read_value(std::vector<std::string>&, const WrittenArgument&, const ValueLimits&, ElementReader&);
template <class Class>
bool read_value(ElementRef<Class>& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  return read_value(static_cast<ElementHandle&>(slot), Class::statement, w, r);
}
template <class Class>
bool read_value(std::vector<ElementRef<Class>>& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  std::vector<ElementHandle> handles;
  const bool ok = read_value(handles, Class::statement, w, r);
  slot.clear();
  for (const ElementHandle& h : handles) slot.push_back({h});
  return ok;
}

namespace detail {

// Of members that refer to elements of one class.
template <class V>
struct Reference {
  static constexpr std::string_view statement{};
};
template <>
struct Reference<MarkerId> {
  static constexpr std::string_view statement = MarkerClass::statement;
};
template <class Class>
struct Reference<ElementRef<Class>> {
  static constexpr std::string_view statement = Class::statement;
};
template <class Class>
struct Reference<std::vector<ElementRef<Class>>> {
  static constexpr std::string_view statement = Class::statement;
};

template <class V>
inline constexpr bool is_list = false;
template <class V>
inline constexpr bool is_list<std::vector<V>> = true;

// What a member of this type takes.
template <class V>
constexpr ValueKind value_kind() {
  if constexpr (std::is_same_v<V, bool> || std::is_same_v<V, Obsolete>)
    return ValueKind::none;
  else if constexpr (std::is_same_v<V, double> || std::is_same_v<V, std::optional<double>>)
    return ValueKind::number;
  else if constexpr (std::is_same_v<V, Vector> || std::is_same_v<V, std::optional<Vector>>)
    return ValueKind::vector;
  else if constexpr (std::is_same_v<V, std::vector<double>>)
    return ValueKind::numbers;
  else if constexpr (std::is_same_v<V, std::vector<std::vector<double>>>)
    return ValueKind::lists;
  else if constexpr (std::is_same_v<V, std::optional<std::int64_t>> || std::is_same_v<V, WordOrCount>)
    return ValueKind::integer;
  else if constexpr (std::is_same_v<V, OptionalWord>)
    return ValueKind::word;
  else if constexpr (std::is_same_v<V, UserSubroutine>)
    return ValueKind::routine_call;
  else if constexpr (std::is_same_v<V, MarkerId>)
    return ValueKind::marker;
  else if constexpr (std::is_same_v<V, BodyId>)
    return ValueKind::body;
  else if constexpr (std::is_same_v<V, std::vector<std::int64_t>>)
    return ValueKind::ids;
  else if constexpr (std::is_same_v<V, Expression>)
    return ValueKind::expression;
  else if constexpr (std::is_same_v<V, VectorExpression>)
    return ValueKind::vector_expression;
  else if constexpr (std::is_same_v<V, std::string>)
    return ValueKind::text;
  else if constexpr (std::is_same_v<V, std::vector<std::string>>)
    return ValueKind::words;
  else
    return is_list<V> ? ValueKind::elements : ValueKind::element;
}

template <class E>
constexpr ArgumentInfo argument_info(const Argument<E>& a) {
  ArgumentInfo info{a.name, a.required, false, ValueKind::none, a.unit, a.help};
  info.ends = a.ends, info.start = a.start, info.count = a.count, info.of_list = a.unstated;
  std::visit(
      [&]<class V>(V E::*) {
        info.is_flag = std::is_same_v<V, bool>;
        info.value_optional =
            std::is_same_v<V, WordOrCount> || std::is_same_v<V, OptionalWord> || std::is_same_v<V, Obsolete>;
        info.elsewhere = std::is_same_v<V, ElsewhereOnly>;
        info.repeats = std::is_same_v<V, std::vector<std::vector<double>>>;
        info.value = value_kind<V>();
        info.ids_of = !a.ids_of.empty() ? a.ids_of : info.value == ValueKind::body ? a.name : Reference<V>::statement;
        if (std::is_same_v<V, double> || std::is_same_v<V, std::optional<double>> ||
            std::is_same_v<V, std::optional<std::int64_t>> || std::is_same_v<V, WordOrCount>)
          info.count = 1;
        if (std::is_same_v<V, Vector> || std::is_same_v<V, std::optional<Vector>>) info.count = 3;
        if (std::is_same_v<V, Vector>) info.of_list = 0;
      },
      a.slot);
  return info;
}

template <class E, std::size_t k>
constexpr ArgumentInfo argument_info() {
  ArgumentInfo info = argument_info(E::arguments[k]);
  if constexpr (std::holds_alternative<double E::*>(E::arguments[k].slot)) {
    if (!info.required) info.of_new = [] { return E{}.*std::get<double E::*>(E::arguments[k].slot); };
  }
  return info;
}

template <class E>
inline constexpr auto argument_infos = []<std::size_t... k>(std::index_sequence<k...>) {
  return std::array<ArgumentInfo, sizeof...(k)>{argument_info<E, k>()...};
}
(std::make_index_sequence<E::arguments.size()>());

template <class E>
inline constexpr auto argument_names = [] {
  std::array<std::string_view, E::arguments.size()> names{};
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = E::arguments[k].name;
  return names;
}();

// Finds the argument a written name means; reports unknown and repeated ones.
std::optional<std::size_t> find_argument(const WrittenArgument&, std::span<const ArgumentInfo>,
                                         std::span<const std::string_view> names, ElementReader&);
// Warns of numbers in degrees, 90D, in a unit that has no angle in it.
void warn_of_degrees(std::string_view argument, const Unit&, const WrittenArgument&, ElementReader&);
// Reports arguments that are required and missing.
bool check_required(std::span<const ArgumentInfo>, ElementReader&);

}  // namespace detail

namespace detail {

// One written argument into the member of its row.
template <class E>
bool read_argument(E& element, const Argument<E>& a, const WrittenArgument& written, ElementReader& reader) {
  return std::visit(
      [&]<class V>(V E::*member) {
        if constexpr (std::is_same_v<V, bool>) {
          return element.*member = true;
        } else {
          if constexpr (!std::is_same_v<V, Expression> && !std::is_same_v<V, VectorExpression>)
            warn_of_degrees(a.name, a.unit, written, reader);
          return read_value(element.*member, written, ValueLimits{a.name, a.minimum, a.maximum}, reader);
        }
      },
      a.slot);
}

// `read` takes the row of each written argument; false if anything was wrong.
template <class Read>
bool read_rows(std::span<const ArgumentInfo> infos, std::span<const std::string_view> names, ElementReader& reader,
               const Read& read) {
  bool ok = true;
  for (const WrittenArgument& written : reader.statement().arguments) {
    const auto k = find_argument(written, infos, names, reader);
    if (!k) {
      ok = false;
      continue;
    }
    if (*k >= infos.size()) continue;  // the word that selects the variant
    ok &= read(*k, written);
  }
  return check_required(infos, reader) && ok;
}

}  // namespace detail

// Reads all arguments of the reader's statement into `element`; false if anything was wrong.
template <class E>
bool read_arguments(E& element, ElementReader& reader) {
  return detail::read_rows(detail::argument_infos<E>, detail::argument_names<E>, reader,
                           [&](std::size_t k, const WrittenArgument& written) {
                             return detail::read_argument(element, E::arguments[k], written, reader);
                           });
}

}  // namespace dynalin
