// Which kernel holds the elements of each set of a model, and what its markers and data atoms lead to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/signals.h"
#include "model/model.h"

namespace dynalin {

class SignalTable final : public Signals {
 public:
  SignalTable(const Model&, const Layout&);

  // While a System is made: `kernel` holds the elements of `set`.
  void own(std::size_t set, const Kernel& kernel) { kernel_of_set_[set] = &kernel; }
  // When all kernels are there.
  void index_markers();

  const Layout& layout() const override { return layout_; }
  MarkerId marker(std::int64_t id) const override;
  MarkerId place_of(MarkerId) const override;
  bool has_place(MarkerId) const override;
  Channel variable(VariableRef ref) const override { return value_of(ref); }
  Channel array_entry(ArrayRef, std::size_t n) const override;
  Channel data(const Atom&) const override;
  Element element(ElementHandle h) const override { return {kernel(h), static_cast<std::size_t>(h.index)}; }
  Wrench wrench(std::string_view statement, std::int64_t id) const override;
  std::span<const Wrench> wrenches_at(MarkerId m) const override {
    const auto k = static_cast<std::size_t>(m.index);
    return std::span(at_marker_).subspan(first_at_marker_[k], first_at_marker_[k + 1] - first_at_marker_[k]);
  }

 private:
  const Kernel* kernel(ElementHandle h) const { return kernel_of_set_[static_cast<std::size_t>(h.set)]; }
  Channel value_of(ElementHandle) const;
  Channel modal(const Atom&) const;

  const Model& model_;
  const Layout& layout_;
  std::vector<const Kernel*> kernel_of_set_;
  std::vector<Wrench> at_marker_;  // of marker k from first_at_marker_[k] to [k + 1]
  std::vector<std::uint32_t> first_at_marker_;
};

}  // namespace dynalin
