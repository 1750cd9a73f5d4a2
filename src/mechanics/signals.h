// What the references of a finished system lead to: markers, elements, channels. Nothing here changes the system.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "expression/expression.h"
#include "mechanics/channel_source.h"
#include "mechanics/handles.h"
#include "mechanics/layout.h"

namespace dynalin {

class Kernel;
class WrenchSource;

class Signals {
 public:
  virtual ~Signals() = default;
  virtual const Layout& layout() const = 0;
  virtual MarkerId marker(std::int64_t id) const = 0;  // global_frame for 0
  // The fixed marker at which a floating one is, any other itself.
  virtual MarkerId place_of(MarkerId) const = 0;
  // Whether anything gives the marker a place: a floating one may have none.
  virtual bool has_place(MarkerId) const = 0;
  virtual Channel variable(VariableRef) const = 0;
  // Entry `n` (0-based) of an ARRAY of any type.
  virtual Channel array_entry(ArrayRef, std::size_t n) const = 0;
  // What a data atom reads: VARVAL, ARYVAL, DIF, PINVAL, POUVAL; of a DIF1 what it is the rate of.
  virtual Channel data(const Atom&) const = 0;

  struct Element {
    const Kernel* kernel = nullptr;
    std::size_t index = 0;
  };
  virtual Element element(ElementHandle) const = 0;
  // One that exerts a wrench, by its number among those of its kernel.
  struct Wrench {
    const WrenchSource* source = nullptr;
    std::size_t which = 0;
  };
  virtual Wrench wrench(std::string_view statement, std::int64_t id) const = 0;
  virtual std::span<const Wrench> wrenches_at(MarkerId) const = 0;
};

}  // namespace dynalin
