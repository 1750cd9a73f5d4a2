// What the program knows of a kind of element without knowing its formulas: keyword, arguments, and a way to
// make the container of its elements. One Kind ends each element file; the catalogue lists them all.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "dataset/dataset.h"
#include "mechanics/handles.h"
#include "mechanics/kernel.h"
#include "model/argument_info.h"
#include "routine/routine_kinds.h"

namespace dynalin {

struct Model;
struct ToldBeforehand;
class ElementReader;

class ElementSet;

struct Kind {
  // What the statement is to the rest of the model.
  enum class Role : std::uint8_t {
    body,       // owns a place in Model::bodies
    marker,     // owns a place in Model::markers
    element,    // anything with an id
    singleton,  // at most one, without id
    inert,      // kept beside the model: shapes, which contacts may take, and what has no effect
    setting,    // of analyses: without id, may be stated several times
  };

  // Rows in the tables of strain energy and dissipated power of a mode: what its wrenches work, each element as a whole
  // or on each of its I markers.
  enum class EnergyRows : std::uint8_t { none, one, each_marker };

  // What of its elements is known at an operating point. What only watches the model exerts nothing.
  enum class Gives : std::uint8_t { forces, value, plant_inputs, plant_outputs, events, requests };

  std::string_view statement;  // "JOINT"
  std::string_view variant;    // "REVOLUTE", empty if the statement has one kind only
  std::string_view summary;    // one sentence for the help
  Role role = Role::element;
  std::span<const ArgumentInfo> arguments;
  std::unique_ptr<ElementSet> (*make_set)(const Kind&) = nullptr;
  EnergyRows energy_rows = EnergyRows::none;
  bool can_be_deactivated = false;  // a command takes elements out of the model and into it again
  bool holds_for_good = false;      // no command defines it anew
  bool idle = false;                // of a setting: no argument of the statement acts
  Gives gives = Gives::forces;
  std::string_view example{};               // of a command that defines arguments anew, "PART/2, MASS=3.5"
  std::span<const RoutineKind> routines{};  // that its arguments call by USER(…)
  std::string_view ground_word{};           // of a body: the bare word by which it is the ground
  bool is_point = false;                    // of a body: it never turns
  bool slides = false;                      // of a joint: what it moves by is a length
  const ToldBeforehand* told_beforehand{};  // what routines may know of its statements (told_beforehand.h)

  constexpr Kind deactivatable() const {
    Kind kind = *this;
    kind.can_be_deactivated = true;
    return kind;
  }
  constexpr Kind without_effect() const {
    Kind kind = *this;
    kind.idle = true;
    return kind;
  }
  constexpr Kind for_good() const {
    Kind kind = *this;
    kind.holds_for_good = true;
    return kind;
  }
  constexpr Kind with_example(std::string_view command) const {
    Kind kind = *this;
    kind.example = command;
    return kind;
  }
  constexpr Kind calling(std::span<const RoutineKind> what) const {
    Kind kind = *this;
    kind.routines = what;
    return kind;
  }
  constexpr Kind grounded_by(std::string_view word) const {
    Kind kind = *this;
    kind.ground_word = word;
    return kind;
  }
  constexpr Kind without_rotation() const {
    Kind kind = *this;
    kind.is_point = true;
    return kind;
  }
  constexpr Kind sliding() const {
    Kind kind = *this;
    kind.slides = true;
    return kind;
  }
  constexpr Kind telling(const ToldBeforehand& what) const {
    Kind kind = *this;
    kind.told_beforehand = &what;
    return kind;
  }
  constexpr Kind giving(Gives what) const {
    Kind kind = *this;
    kind.gives = what;
    return kind;
  }
};

// Whether a statement is beside the model: nothing in it depends on it.
constexpr bool is_beside_model(const Kind& kind) {
  return kind.role == Kind::Role::inert || kind.role == Kind::Role::setting;
}

// Whether a command NAME/id, ARG=… defines arguments of such a statement anew.
constexpr bool can_be_redefined(const Kind& kind) { return kind.role != Kind::Role::setting && !kind.holds_for_good; }

// Whether functions may ask for the force of an element.
constexpr bool can_exert(const Kind& kind) { return !is_beside_model(kind) && kind.gives == Kind::Gives::forces; }

using Catalogue = std::span<const Kind* const>;
// All elements of one kind in a model, contiguous, in the order of the dataset.
class ElementSet {
 public:
  explicit ElementSet(const Kind& kind) : kind_(&kind) {}
  virtual ~ElementSet() = default;

  const Kind& kind() const { return *kind_; }
  std::size_t size() const { return labels.size(); }

  // First the model learns all ids; second it is appended and its arguments are read; third what needs other elements.
  virtual void append(ElementLabel label) = 0;
  virtual void reserve(std::size_t count) { labels.reserve(count); }  // so many are to come, not more
  virtual void read(std::size_t index, ElementReader&) = 0;
  // Makes the element that is read next. Not earlier: by then the memory of statements read before is free again.
  virtual void make(std::size_t) {}
  virtual void finish(Model&, Diagnostics&) {}
  virtual std::unique_ptr<Kernel> make_kernel(const Model&, Layout&) const { return nullptr; }

  std::vector<ElementLabel> labels;
  std::vector<bool> sound;  // false: its statement had errors, what refers to it stays silent
  bool active = true;       // false: elements that a command took out of the model, and that exert nothing

 private:
  const Kind* kind_;
};

template <class E>
class TypedSet : public ElementSet {
 public:
  using ElementSet::ElementSet;
  std::vector<E> elements;

  void reserve(std::size_t count) override {
    labels.reserve(count);
    elements.reserve(count);
  }
  void append(ElementLabel label) override {
    labels.push_back(std::move(label));
    sound.push_back(true);
  }
  void make(std::size_t k) override { elements.resize(k + 1); }
};

}  // namespace dynalin
