// Values of configuration files: numbers, words and lists at their places.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

// What a value is read for.
struct ValuePlace {
  std::string_view name;  // of the directive or field
  Diagnostics& diagnostics;

  void error(const Span& at, std::string message, std::string hint = {}) const;
};

// Parts between commas without the blanks around them.
std::vector<Span> split_list(const Span&);

// Each reports what is wrong and returns nothing then.
std::optional<std::int64_t> read_integer(const Span&, const ValuePlace&);
std::optional<double> read_real(const Span&, const ValuePlace&);
std::optional<double> read_angle(const Span&, const ValuePlace&);  // [rad]; D for degrees
std::optional<std::size_t> read_choice(const Span&, std::span<const std::string_view> words, const ValuePlace&);
std::optional<std::vector<std::string>> read_names(const Span&, const ValuePlace&);
std::optional<std::vector<IdRange>> read_ranges(const Span&, const ValuePlace&);
std::optional<ClanRegion> read_region(const Span&, const ValuePlace&);
// Without quotes around it.
std::string read_string(const Span&);

}  // namespace dynalin::nastran
