// What an entry of an operating point belongs to, by which it is found again in another system: statement and id of its
// element, a name where that has several, and a count where these are equal. Never an index.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mechanics/layout.h"

namespace dynalin {

struct EntryKey {
  std::string statement;
  std::int64_t id = 0;
  std::string name;
  std::size_t number = 0;  // among those that are equal up to here

  auto operator<=>(const EntryKey&) const = default;
  std::string text() const;  // "JOINT/3 Zi.Xj"
};

// Of every entry, in the order of the layout.
std::vector<EntryKey> body_keys(const Layout&);
std::vector<EntryKey> extra_keys(const Layout&);
std::vector<EntryKey> row_keys(const Layout&);
std::vector<EntryKey> value_keys(const Layout&);
std::vector<EntryKey> state_keys(const Layout&);
std::vector<EntryKey> memory_keys(const Layout&);  // of angles too: these have names of their own
std::vector<EntryKey> delay_keys(const Layout&);   // of calls of DELAY, by the statement and what is delayed

// An angle that counts turns, whatever reads it: AZ(20,2).
struct AngleName {
  Measure measure = Measure::AZ;
  std::int64_t i = 0, j = 0;  // ids of markers

  auto operator<=>(const AngleName&) const = default;
  std::string text() const;
};
std::vector<AngleName> angle_names(const Layout&);

// Pairs of places (in `from`, in `to`) with equal keys.
std::vector<std::pair<std::size_t, std::size_t>> matches(const std::vector<EntryKey>& from,
                                                         const std::vector<EntryKey>& to);

// Gives equal keys their numbers.
class KeyCounter {
 public:
  EntryKey next(std::string_view statement, std::int64_t id, std::string_view name);

 private:
  std::map<EntryKey, std::size_t> count_;
};

}  // namespace dynalin
