// A body of modes as MATRIX statements: what translators write, summed up over its nodes.
#include <algorithm>
#include <string>

#include "mechanism.h"
#include "model.h"
#include "text.h"

namespace dynalin::oracle {

namespace {

// Entry (row, column) of a table by a function.
template <class Entry>
std::string matrix_text(int id, const std::string& name, std::size_t rows, std::size_t columns, Entry&& entry) {
  std::vector<double> values;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) values.push_back(static_cast<double>(entry(r, c)));
  }
  return "MATRIX/" + std::to_string(id) + "\n, NAME = " + name + "\n, FULL = RORDER\n, ROWS = " + std::to_string(rows) +
         "\n, COLUMNS = " + std::to_string(columns) + "\n, VALUES = " + numbers(values) + "\n";
}

Real entry_of(const Mat& m, std::size_t row, std::size_t column) {
  return component(m.column[column], static_cast<int>(row));
}

}  // namespace

std::string flexible_text(const Mechanism& m, const Flexible& f) {
  const Body& frame =
      *std::find_if(m.bodies.begin(), m.bodies.end(), [&](const Body& b) { return b.ref == f.frame(); });
  const Body& modes =
      *std::find_if(m.bodies.begin(), m.bodies.end(), [&](const Body& b) { return b.ref == f.modes(); });
  const int first = 900 + 20 * f.id;
  const auto sum = [&](auto&& of_node) {
    auto total = of_node(f.nodes[0]);
    for (std::size_t k = 1; k < f.nodes.size(); ++k) total = total + of_node(f.nodes[k]);
    return total;
  };
  const auto table = [](const std::array<std::array<double, 3>, 3>& t) {
    return [&t](std::size_t r, std::size_t c) { return t[r][c]; };
  };
  std::string text;
  int id = first;
  const auto add = [&](const std::string& name, std::size_t rows, std::size_t columns, auto&& entry) {
    text += matrix_text(id++, name, rows, columns, entry);
  };
  add("SELNOD", f.nodes.size(), 4,
      [&](std::size_t r, std::size_t c) { return c == 0 ? static_cast<double>(r + 1) : f.nodes[r].place[c - 1]; });
  add("T_MODE", 3 * f.nodes.size(), 3, [&](std::size_t r, std::size_t c) { return f.nodes[r / 3].shift[c][r % 3]; });
  add("R_MODE", 3 * f.nodes.size(), 3, [&](std::size_t r, std::size_t c) { return f.nodes[r / 3].turn[c][r % 3]; });
  add("GENSTIFF", 3, 3, table(f.stiffness));
  add("INVAR1", 1, 1, [&](std::size_t, std::size_t) { return sum([](const Flexible::Node& n) { return n.mass; }); });
  add("INVAR2", 3, 1, [&](std::size_t r, std::size_t) {
    return sum([&](const Flexible::Node& n) { return static_cast<Real>(n.mass) * n.place[r]; });
  });
  add("INVAR3", 3, 3, [&](std::size_t r, std::size_t c) {
    return sum([&](const Flexible::Node& n) { return static_cast<Real>(n.mass) * n.shift[c][r]; });
  });
  add("INVAR4", 3, 3, [&](std::size_t r, std::size_t c) {
    return component(sum([&](const Flexible::Node& n) {
                       return static_cast<Real>(n.mass) * cross(to_vec(n.place), to_vec(n.shift[c])) +
                              inertia_of(n) * to_vec(n.turn[c]);
                     }),
                     static_cast<int>(r));
  });
  add("INVAR5", 3, 9, [&](std::size_t r, std::size_t c) {
    return component(sum([&](const Flexible::Node& n) {
                       return static_cast<Real>(n.mass) * cross(to_vec(n.shift[c / 3]), to_vec(n.shift[c % 3]));
                     }),
                     static_cast<int>(r));
  });
  add("INVAR6", 3, 3, [&](std::size_t r, std::size_t c) {
    return sum([&](const Flexible::Node& n) {
      return static_cast<Real>(n.mass) * dot(to_vec(n.shift[r]), to_vec(n.shift[c])) +
             dot(to_vec(n.turn[r]), inertia_of(n) * to_vec(n.turn[c]));
    });
  });
  add("INVAR7", 3, 3, [&](std::size_t r, std::size_t c) {
    return sum([&](const Flexible::Node& n) {
      const Mat S = skew(to_vec(n.place));
      return entry_of(static_cast<Real>(n.mass) * (transpose(S) * S) + inertia_of(n), r, c);
    });
  });
  add("INVAR8", 3, 9, [&](std::size_t r, std::size_t c) {
    return sum([&](const Flexible::Node& n) {
      return static_cast<Real>(n.mass) * entry_of(skew(to_vec(n.place)) * skew(to_vec(n.shift[c / 3])), r, c % 3);
    });
  });
  add("INVAR9", 3, 27, [&](std::size_t r, std::size_t c) {
    return sum([&](const Flexible::Node& n) {
      const Mat a = skew(to_vec(n.shift[c / 9])), b = skew(to_vec(n.shift[c / 3 % 3]));
      return static_cast<Real>(n.mass) * entry_of(a * b, r, c % 3);
    });
  });
  add("GENDAMP", 3, 3, table(f.damping));
  if (!f.loads.empty()) add("MODLOAD", 9, f.loads.size(), [&](std::size_t r, std::size_t c) { return f.loads[c][r]; });
  std::string ids;
  for (int k = first; k < id; ++k) ids += (k > first ? "," : "") + std::to_string(k);
  std::string body = "FLEX_BODY/" + std::to_string(f.id) + "\n, MATRICES = " + ids +
                     "\n, GENERALIZED_DAMPING = FULL\n, QG = " + numbers(frame.qg) +
                     "\n, REULER = " + numbers(frame.reuler) + "\n, DMODE = " + numbers(modes.qg) + "\n";
  if (modes.v) body += ", VMODE = " + numbers(*modes.v) + "\n";
  const Triple w = frame.w ? to_triple(transpose(rotation_313(frame.reuler)) * to_vec(*frame.w)) : Triple{};
  const char* names[] = {"VX", "VY", "VZ", "WX", "WY", "WZ"};
  for (std::size_t k = 0; k < 6 && frame.v; ++k)
    body += ", " + std::string(names[k]) + " = " + number(k < 3 ? (*frame.v)[k] : w[k - 3]) + "\n";
  return body + ", CRATIO = " + number(f.ratio) + "\n" + text;
}

std::string modal_force_text(const ModalForce& f) {
  return "MFORCE/" + std::to_string(f.id) + "\n, FLEX_BODY = " + std::to_string(f.flexible) +
         (f.jfloat == 0 ? "" : "\n, JFLOAT = " + std::to_string(f.jfloat)) +
         "\n, CASE_INDEX = " + std::to_string(f.load + 1) + "\n, SCALE = " + expression_text(f.scale) + "\n";
}

}  // namespace dynalin::oracle
