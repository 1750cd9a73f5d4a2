#include "model/kind_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/enumeration.h"

namespace dynalin {

namespace {

// A word such as I or R that is the exact name of an argument never selects a variant.
bool is_argument(const Kind& kind, std::string_view word) {
  return std::any_of(kind.arguments.begin(), kind.arguments.end(), [&](const ArgumentInfo& a) {
    return a.name.size() == word.size() && std::equal(word.begin(), word.end(), a.name.begin(), [](char x, char y) {
             return std::toupper(static_cast<unsigned char>(x)) == y;
           });
  });
}

}  // namespace

KindFinder::KindFinder(Catalogue catalogue) {
  for (const Kind* kind : catalogue) {
    Variants& of_statement = kinds_[kind->statement];
    of_statement.kinds.push_back(kind);
    of_statement.names.push_back(kind->variant);
  }
}

const std::vector<const Kind*>& KindFinder::kinds_of(std::string_view statement) const {
  static const std::vector<const Kind*> none;
  const auto it = kinds_.find(statement);
  return it == kinds_.end() ? none : it->second.kinds;
}

const Kind* KindFinder::find(const Statement& s, std::size_t& variant_argument, Diagnostics& diagnostics) const {
  variant_argument = no_argument;
  const auto it = kinds_.find(s.name);
  if (it == kinds_.end()) {
    std::string instead;
    if (s.name == "UCON") instead = "GCON states a constraint by an expression";
    if (s.name == "TIRE") instead = "a BUSHING or SFORCE with the stiffness of the tire";
    if (s.name == "SURFACE") instead = "GCON keeps a marker on a surface that an expression describes";
    diagnostics.error("statement-not-built", s.keyword(), fmt::format("{} is not available yet", s.name),
                      std::move(instead));
    return nullptr;
  }
  // No structured binding: clang 14 lets no lambda have one.
  const std::vector<const Kind*>& kinds = it->second.kinds;
  const std::vector<std::string_view>& variants = it->second.names;
  if (kinds.size() == 1 && kinds.front()->variant.empty()) return kinds.front();

  const Kind* found = nullptr;
  for (std::size_t k = 0; k < s.arguments.size(); ++k) {
    const WrittenArgument& w = s.arguments[k];
    if (w.has_value) continue;
    const auto v = find_keyword(w.name.text(), variants);
    if (!v || is_argument(*kinds[*v], w.name.text())) continue;
    if (found) {
      diagnostics.error(
          "duplicate-variant", w.name,
          fmt::format("{}/{} is both {} and {}", s.name, s.id.value_or(0), found->variant, kinds[*v]->variant));
      return nullptr;
    }
    found = kinds[*v];
    variant_argument = k;
  }
  if (!found) {
    // A bare word that is no argument of any type was probably meant as one.
    const auto strange = std::find_if(s.arguments.begin(), s.arguments.end(), [&](const WrittenArgument& w) {
      return !w.has_value && std::none_of(kinds.begin(), kinds.end(), [&](const Kind* kind) {
        return std::any_of(kind->arguments.begin(), kind->arguments.end(), [&](const ArgumentInfo& a) {
          return find_keyword(w.name.text(), std::array{a.name}).has_value();
        });
      });
    });
    const bool named = strange != s.arguments.end();
    std::vector<std::string_view> tied;
    if (named) find_keyword(strange->name.text(), variants, &tied);
    if (!tied.empty()) {
      diagnostics.error("missing-variant", strange->name,
                        fmt::format("{} may mean several types of {}", strange->name.text(), s.name),
                        fmt::format("it could be {}", enumeration(tied, "or")));
      return nullptr;
    }
    diagnostics.error("missing-variant", named ? strange->name : s.at,
                      named ? fmt::format("{} is no type of {}", strange->name.text(), s.name)
                            : fmt::format("{} needs its type", s.name),
                      fmt::format("one of {}", fmt::join(variants, ", ")));
  }
  return found;
}

bool KindFinder::needs_no_id(std::string_view statement) const {
  const auto& kinds = kinds_of(statement);
  if (kinds.empty()) return false;
  const Kind::Role role = kinds.front()->role;
  return role == Kind::Role::singleton || role == Kind::Role::setting;
}

std::int64_t KindFinder::identity_of(const Statement& s) const { return needs_no_id(s.name) ? 0 : s.id.value_or(0); }

}  // namespace dynalin
