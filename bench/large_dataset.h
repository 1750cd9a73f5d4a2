// Datasets of any size to read: a row of parts, written in one of several ways.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>

class LargeDataset {
 public:
  enum class Kind {
    exported,     // as pre-processors write it: an argument a line, banners, names in comments
    dense,        // by hand: a statement a line, no comments; bodies, bushings, requests, graphics
    jointed,      // the same of bodies, markers, joints and springs alone
    expressions,  // forces and VARIABLEs that are functions
    tables,       // SPLINEs and MATRIXes of hundreds of numbers
    mixed,        // as much of each of the last three
  };
  static constexpr std::array<std::string_view, 6> names = {"exported",    "dense",  "jointed",
                                                            "expressions", "tables", "mixed"};
  static std::optional<Kind> kind_called(std::string_view name) {
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k] == name) return static_cast<Kind>(k);
    return std::nullopt;
  }

  LargeDataset(Kind kind, std::size_t size) : is_exported_(kind == Kind::exported) {
    text_.reserve(size + 16384);
    text_ += "large\n";
    statement("UNITS", "", {"FORCE=NEWTON", "MASS=KILOGRAM", "LENGTH=MILLIMETER", "TIME=SECOND"});
    statement("PART", "1", {"GROUND"});
    statement("MARKER", "1", {"PART=1"});
    for (int k = 2; text_.size() < size; ++k) add(kind, k);
    text_ += "END\n";
  }
  std::string take() { return std::move(text_); }
  std::size_t statements() const { return statements_; }

 private:
  void add(Kind kind, int k) {
    switch (kind) {
      case Kind::exported:
      case Kind::dense:
        return vehicle(k);
      case Kind::jointed:
        return jointed(k);
      case Kind::expressions:
        return expressions(k);
      case Kind::tables:
        return tables(k);
      case Kind::mixed:
        break;
    }
    // The shortest so far.
    constexpr std::array kinds = {Kind::jointed, Kind::expressions, Kind::tables};
    std::size_t least = 0;
    for (std::size_t n = 1; n < kinds.size(); ++n) least = lengths_[n] < lengths_[least] ? n : least;
    const std::size_t before = text_.size();
    add(kinds[least], k);
    lengths_[least] += text_.size() - before;
  }

  void statement(const std::string& name, const std::string& id, std::initializer_list<std::string> arguments) {
    ++statements_;
    if (is_exported_) fmt::format_to(std::back_inserter(text_), "!{:30}adams_view_name='{}_{}'\n", "", name, id);
    fmt::format_to(std::back_inserter(text_), "{}/{}", name, id);
    for (std::string a : arguments) {
      const auto equals = a.find('=');
      if (is_exported_ && equals != std::string::npos) a.replace(equals, 1, " = ");
      text_ += is_exported_ ? "\n, " : ",";
      text_ += a;
    }
    text_ += is_exported_ ? "\n!\n" : "\n";
  }
  std::string number() { return fmt::format("{:.6f}", std::uniform_real_distribution(-900.0, 900.0)(random_)); }
  std::string positive() { return fmt::format("{:.6f}", std::uniform_real_distribution(1.0, 900.0)(random_)); }
  std::string vector() { return number() + ", " + number() + ", " + number(); }
  std::string angles() { return number() + "D, " + number() + "D, " + number() + "D"; }
  std::string numbers(int count) {
    std::string list = number();
    while (--count > 0) list += ", " + number();
    return list;
  }

  // Part k with its centre and three markers more; of the first of these and the last of the part before, if any, what
  // names them as I and J.
  struct Pair {
    std::string id, i, j;
  };
  Pair part(int k) {
    const int m = 10 * k;
    const std::string id = std::to_string(k), owner = "PART=" + id;
    statement("PART", id,
              {"QG=" + vector(), "REULER=" + angles(), "MASS=1.2345", "CM=" + std::to_string(m),
               "IP=1.0E+003, 1.1E+003, 1.2E+003"});
    statement("MARKER", std::to_string(m), {owner, "QP=0, 0, 0"});
    for (int n = 1; n <= 3; ++n)
      statement("MARKER", std::to_string(m + n), {owner, "QP=" + vector(), "REULER=" + angles()});
    return pair(k);
  }
  Pair pair(int k) {
    const int i = 10 * k + 1, j = std::exchange(before_, 10 * k + 2);
    return {std::to_string(k), std::to_string(i), std::to_string(j)};
  }

  void vehicle(int k) {
    const Pair p = part(k);
    const std::string i = "I=" + p.i, j = "J=" + p.j;
    statement("BUSHING", p.id,
              {i, j, "C=1.0, 1.0, 1.0", "K=1.0E+005, 1.0E+005, 1.0E+005", "CT=10, 10, 10",
               "KT=1.0E+006, 1.0E+006, 1.0E+006"});
    statement(
        "SFORCE", p.id,
        {"TRANSLATIONAL", i, j, fmt::format("FUNCTION=-12.5*(DM({0},{1})-100.0)\n, -0.35*VR({0},{1})", p.i, p.j)});
    statement("REQUEST", p.id, {"DISPLACEMENT", i, j, "RM=1", "COMMENT=displacement of part " + p.id});
    statement("GRAPHICS", p.id, {"CYLINDER", "CM=" + std::to_string(10 * k), "LENGTH=12.5", "RADIUS=3.0"});
  }

  void jointed(int k) {
    const Pair p = part(k);
    if (k % 2 == 0)
      statement("JOINT", p.id, {"SPHERICAL", "I=" + p.i, "J=" + p.j});
    else
      statement("JPRIM", p.id, {"ATPOINT", "I=" + p.i, "J=" + p.j});
    statement("SPRINGDAMPER", p.id,
              {"TRANSLATIONAL", fmt::format("I={}", 10 * k + 3), "J=1", "K=12.5", "C=0.5", "LENGTH=100"});
  }

  void expressions(int k) {
    const int m = 10 * k;
    const std::string id = std::to_string(k), owner = "PART=" + id, second = std::to_string(10'000'000 + k);
    statement("PART", id, {"MASS=1.2345", "CM=" + std::to_string(m), "IP=1, 1, 1"});
    for (int n = 0; n <= 2; ++n) statement("MARKER", std::to_string(m + n), {owner, fmt::format("QP={}, 0, 0", n)});
    const Pair p = pair(k);
    statement(
        "SFORCE", id,
        {"TRANSLATIONAL", "I=" + p.i, "J=" + p.j,
         fmt::format("FUNCTION=-12.5*(DM({0},{1})-100.0)-0.35*VR({0},{1})+STEP(TIME,0,0,1,{2})", p.i, p.j, number())});
    statement("VARIABLE", id,
              {fmt::format("FUNCTION=IF(DX({0},{1},{1})-{2}:0,1,SIN(3.5*TIME)**2)+SQRT(1+VM({0})**2)*EXP(-0.5*TIME)",
                           p.i, p.j, positive())});
    statement("VARIABLE", second,
              {fmt::format("FUNCTION=VARVAL({3})*2.5+MAX(0,{2}-AZ({0},{1}))-1.0E-3*WZ({4},{1},{1})", p.i, p.j,
                           positive(), id, m + 2)});
  }

  void tables(int k) {
    constexpr int points = 400, size = 20;
    std::string x = "0";
    for (int n = 1; n < points; ++n) x += fmt::format(", {}", 0.25 * n);
    statement("SPLINE", std::to_string(k), {"X=" + x, "Y=" + numbers(points)});
    statement("MATRIX", std::to_string(k),
              {"FULL=RORDER", fmt::format("ROWS={}", size), fmt::format("COLUMNS={}", size),
               "VALUES=" + numbers(size * size)});
  }

  bool is_exported_;
  std::string text_;
  std::size_t statements_ = 0;
  int before_ = 1;
  std::array<std::size_t, 3> lengths_{};  // of mixed kinds
  std::mt19937 random_{1};
};
