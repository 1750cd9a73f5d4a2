#include "geometry/facet_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "geometry/polygon.h"

namespace dynalin {

namespace {

using Result = tl::expected<Facets, std::string>;
using Index = Mesh::Index;

tl::unexpected<std::string> wrong(std::string reason) { return tl::unexpected(std::move(reason)); }
tl::unexpected<std::string> wrong_at(std::size_t line, std::string_view reason) {
  return wrong(fmt::format("line {}: {}", line, reason));
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }
bool same_word(std::string_view word, std::string_view lower) {
  return word.size() == lower.size() && std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

// Words of a text with the lines on which they stand. Where the language has it so, a line that ends with a backslash
// goes on with the next one.
class Words {
 public:
  enum class Lines { single, continued };
  explicit Words(std::string_view text, Lines lines = Lines::single) : text_(text), lines_(lines) {}

  std::string_view next() {
    while (line_ends() && next_line()) {
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && continuation() == 0) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  // What is left of the line, without blanks around it.
  std::string_view rest_of_line() {
    while (skip_blank()) {
    }
    const std::size_t begin = at_;
    while (!line_ends_here()) line_ += continuation() > 0, at_ += std::max<std::size_t>(continuation(), 1);
    std::string_view rest = text_.substr(begin, at_ - begin);
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    return rest;
  }
  bool line_ends() {
    while (skip_blank()) {
    }
    return line_ends_here();
  }
  // False where there is none.
  bool next_line() {
    if (at_ == text_.size()) return false;
    ++at_, ++line_;
    return true;
  }
  std::size_t line() const { return line_; }

 private:
  bool line_ends_here() const { return at_ == text_.size() || text_[at_] == '\n'; }
  // Of a backslash with the line end behind it, 0 if here is none.
  std::size_t continuation() const {
    if (lines_ == Lines::single || at_ == text_.size() || text_[at_] != '\\') return 0;
    const std::string_view rest = text_.substr(at_ + 1, 2);
    return rest.starts_with('\n') ? 2 : rest == "\r\n" ? 3 : 0;
  }
  // Within a line; false where something else stands here.
  bool skip_blank() {
    if (const std::size_t length = continuation(); length > 0) {
      at_ += length, ++line_;
      return true;
    }
    if (line_ends_here() || !is_blank(text_[at_])) return false;
    ++at_;
    return true;
  }

  std::string_view text_;
  Lines lines_;
  std::size_t at_ = 0, line_ = 1;
};

template <class Number>
std::optional<Number> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

// Three numbers on one line.
std::optional<Vector> point(Words& words) {
  Vector p;
  for (std::size_t k = 0; k < 3; ++k) {
    if (words.line_ends()) return std::nullopt;
    const auto value = number<double>(words.next());
    if (!value) return std::nullopt;
    p[k] = *value;
  }
  return p;
}

// Polygons and lines as they are read, by points; in the end the mesh of those that are wanted.
class Collector {
 public:
  explicit Collector(std::string_view element) : element_(element) {}

  // A part of the file begins whose names these are.
  void begin_part(bool has_the_name) {
    inside_ = has_the_name;
    found_ = found_ || has_the_name;
  }
  bool is_wanted(std::string_view name) {
    if (!name.empty()) names_.emplace(name);
    return !element_.empty() && name == element_;
  }
  void add_polygon(std::vector<Vector> corners) { items_.push_back({std::move(corners), inside_, true}); }
  void add_line(std::vector<Vector> points) { items_.push_back({std::move(points), inside_, false}); }

  Facets facets() {
    Facets out;
    out.named_all = !found_;
    out.parts.assign(names_.begin(), names_.end());
    for (const Item& item : items_) {
      if (found_ && !item.inside) continue;
      std::vector<Index> corners;
      for (const Vector& p : item.points) {
        const Index v = vertex(p, out.mesh);
        if (corners.empty() || corners.back() != v) corners.push_back(v);
      }
      if (!item.polygon) {
        for (std::size_t k = 1; k < corners.size(); ++k) out.mesh.segments.push_back({corners[k - 1], corners[k]});
        continue;
      }
      while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      if (!dynalin::add_polygon(out.mesh, corners)) ++out.flat;
    }
    drop_loose_vertices(out.mesh);
    close(out.mesh);
    return out;
  }

 private:
  struct Item {
    std::vector<Vector> points;
    bool inside, polygon;
  };

  Index vertex(const Vector& p, Mesh& mesh) {
    const auto [it, fresh] = known_.try_emplace({p.x, p.y, p.z}, static_cast<Index>(mesh.vertices.size()));
    if (fresh) mesh.add(p);
    return it->second;
  }

  std::string_view element_;
  bool inside_ = false, found_ = false;
  std::vector<Item> items_;
  std::set<std::string, std::less<>> names_;
  std::map<std::array<double, 3>, Index> known_;
};

// --- STL

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

constexpr std::size_t stl_header = 84, stl_facet = 50;

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < stl_header) return false;
  return bytes.size() == stl_header + stl_facet * std::size_t{little_endian(bytes.data() + stl_header - 4)};
}

Result read_binary_stl(std::string_view bytes) {
  Collector out({});
  const std::size_t count = little_endian(bytes.data() + stl_header - 4);
  for (std::size_t f = 0; f < count; ++f) {
    const char* facet = bytes.data() + stl_header + f * stl_facet + 12;  // behind its normal
    std::vector<Vector> corners(3);
    for (std::size_t k = 0; k < 9; ++k) {
      const double value = std::bit_cast<float>(little_endian(facet + 4 * k));
      if (!std::isfinite(value)) return wrong(fmt::format("facet {} has a corner that is no number", f + 1));
      corners[k / 3][k % 3] = value;
    }
    out.add_polygon(std::move(corners));
  }
  return out.facets();
}

Result read_text_stl(std::string_view text, std::string_view element) {
  if (text.find('\0') != text.npos) return wrong("binary STL of another length than its number of facets says");
  Words words(text);
  if (!same_word(words.next(), "solid")) return wrong("neither a text that begins with solid nor binary STL");
  Collector out(element);
  out.begin_part(out.is_wanted(words.rest_of_line()));
  std::vector<Vector> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (same_word(word, "vertex")) {
      const auto p = point(words);
      if (!p) return wrong_at(words.line(), "a vertex needs three numbers");
      corners.push_back(*p);
    } else if (same_word(word, "endloop")) {
      if (corners.size() < 3) return wrong_at(words.line(), "a facet needs three vertices");
      out.add_polygon(std::move(corners));
      corners.clear();
    } else if (same_word(word, "solid")) {
      out.begin_part(out.is_wanted(words.rest_of_line()));
    } else if (same_word(word, "facet") || same_word(word, "endsolid")) {
      words.rest_of_line();
    } else if (!same_word(word, "outer") && !same_word(word, "loop") && !same_word(word, "endfacet")) {
      return wrong_at(words.line(), fmt::format("{} is no word of STL", word));
    }
  }
  if (!corners.empty()) return wrong_at(words.line(), "the file ends inside a facet");
  return out.facets();
}

// --- Wavefront OBJ

// 7, 7/2, 7//3 and 7/2/3 are point 7; −1 is the last one so far.
std::optional<std::size_t> obj_point(std::string_view word, std::size_t count) {
  const auto index = number<std::int64_t>(word.substr(0, word.find('/')));
  if (!index) return std::nullopt;
  const auto n = static_cast<std::int64_t>(count), k = *index < 0 ? n + *index : *index - 1;
  if (k < 0 || k >= n) return std::nullopt;
  return static_cast<std::size_t>(k);
}

Result read_obj(std::string_view text, std::string_view element) {
  Words words(text, Words::Lines::continued);
  Collector out(element);
  std::vector<Vector> points;
  bool object = false;  // has the wanted name
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "v") {
      const auto p = point(words);
      if (!p) return wrong_at(words.line(), "a vertex needs three numbers");
      points.push_back(*p);
    } else if (word == "f" || word == "l") {
      std::vector<Vector> corners;
      const std::size_t line = words.line();
      while (!words.line_ends()) {
        const auto k = obj_point(words.next(), points.size());
        if (!k) return wrong_at(line, "it refers to a vertex that does not exist");
        corners.push_back(points[*k]);
      }
      if (corners.size() < (word == "f" ? 3 : 2)) return wrong_at(line, "it has too few vertices");
      if (word == "f")
        out.add_polygon(std::move(corners));
      else
        out.add_line(std::move(corners));
    } else if (word == "o") {
      object = out.is_wanted(words.rest_of_line());
      out.begin_part(object);
    } else if (word == "g") {
      bool wanted = object;
      while (!words.line_ends()) wanted = out.is_wanted(words.next()) || wanted;
      out.begin_part(wanted);
    }
    words.rest_of_line();
  }
  return out.facets();
}

// --- shell files: the numbers of points and polygons (version 2: and of normals), a factor; points; polygons, each
// with its number of corners before them, which count from 1; normals of version 2.

Result read_shell(std::string_view text) {
  Words words(text);
  std::string_view word = words.next();
  std::int64_t version = 1;
  if (same_word(word, "version:")) {
    version = number<std::int64_t>(words.next()).value_or(0);
    if (version != 1 && version != 2) return wrong_at(words.line(), "versions 1 and 2 of shell files are known");
    word = words.next();
  }
  const auto points = number<std::int64_t>(word), polygons = number<std::int64_t>(words.next());
  if (version == 2 && !number<std::int64_t>(words.next()))
    return wrong_at(words.line(), "the number of normals is missing");
  const auto factor = number<double>(words.next());
  if (!points || !polygons || !factor || *points < 0 || *polygons < 0)
    return wrong_at(words.line(), "a shell file begins with its numbers of points and polygons and a factor");
  std::vector<Vector> at;
  for (std::int64_t k = 0; k < *points; ++k) {
    while (words.line_ends() && words.next_line()) {
    }
    const auto p = point(words);
    if (!p) return wrong_at(words.line(), "a point needs three numbers");
    at.push_back(*factor * *p);
    if (!std::isfinite(norm(at.back()))) return wrong_at(words.line(), "a coordinate is too large");
  }
  Collector out({});
  for (std::int64_t k = 0; k < *polygons; ++k) {
    const auto count = number<std::int64_t>(words.next());
    if (!count || *count < 1) return wrong_at(words.line(), "a polygon begins with the number of its corners");
    std::vector<Vector> corners;
    for (std::int64_t c = 0; c < *count; ++c) {
      const auto index = number<std::int64_t>(words.next());
      if (!index || *index < 1 || *index > *points)
        return wrong_at(words.line(), "it refers to a point that does not exist");
      corners.push_back(at[static_cast<std::size_t>(*index - 1)]);
    }
    if (*count == 2)
      out.add_line(std::move(corners));
    else
      out.add_polygon(std::move(corners));
  }
  return out.facets();
}

constexpr std::array<std::string_view, 3> endings = {".stl", ".obj", ".shl"};

std::string_view ending_of(std::string_view name) {
  for (const std::string_view ending : endings) {
    if (name.size() >= ending.size() && same_word(name.substr(name.size() - ending.size()), ending)) return ending;
  }
  return {};
}

}  // namespace

bool is_facet_file(std::string_view name) { return !ending_of(name).empty(); }
std::span<const std::string_view> facet_file_endings() { return endings; }

tl::expected<Facets, std::string> read_facets(std::string_view name, std::string_view bytes, std::string_view element) {
  const std::string_view ending = ending_of(name);
  Result facets = ending == ".obj"       ? read_obj(bytes, element)
                  : ending == ".shl"     ? read_shell(bytes)
                  : ending != ".stl"     ? wrong("its format is not known here")
                  : is_binary_stl(bytes) ? read_binary_stl(bytes)
                                         : read_text_stl(bytes, element);
  if (facets && facets->mesh.faces() == 0 && facets->mesh.segments.empty()) return wrong("it holds no facets");
  return facets;
}

}  // namespace dynalin
