// What the utilities SYSARY and SYSFNC of compiled routines name, as the quantities that expressions read.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "expression/expression.h"

namespace dynalin {

// How many numbers an ARRAY, PINPUT or POUTPUT of that id has, states a GSE, modal coordinates a FLEX_BODY; nothing if
// there is none.
using SizeOfList = std::function<std::optional<std::size_t>(std::string_view statement, std::int32_t id)>;

// A single quantity by the name of its function, nothing if there is none of that name with so many arguments.
std::optional<Atom> single_measure(std::string_view name, std::span<const int> ids);
// Those of "DISP", "VEL", "ARRAY" ..., nothing if the name or the number of ids is wrong.
std::optional<std::vector<Atom>> measure_list(std::string_view name, std::span<const int> ids, const SizeOfList&);
// Whether an atom is a modal coordinate of the FLEX_BODY that its first argument names, or the rate of one; which it is
// its second argument says, from 1.
bool reads_modes(const Atom&);
bool reads_modal_rate(const Atom&);

}  // namespace dynalin
