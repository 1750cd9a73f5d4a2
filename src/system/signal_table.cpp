#include "system/signal_table.h"

#include <numeric>

#include "elements/controls/array.h"
#include "elements/controls/variable_list.h"
#include "mechanics/wrench_source.h"
#include "routine/measures.h"

namespace dynalin {

SignalTable::SignalTable(const Model& model, const Layout& layout)
    : model_(model), layout_(layout), kernel_of_set_(model.sets.size(), nullptr) {}

void SignalTable::index_markers() {
  const auto for_each_end = [&](const auto& visit) {
    for (std::size_t s = 0; s < kernel_of_set_.size(); ++s) {
      const WrenchSource* source = kernel_of_set_[s] ? kernel_of_set_[s]->wrenches() : nullptr;
      if (!source) continue;
      for (std::size_t k = 0; k < source->wrench_count(model_.sets[s]->size()); ++k) {
        const MarkerId i = source->marker_I(k), j = source->marker_J(k);
        visit(static_cast<std::size_t>(i.index), Wrench{source, k});
        if (!(i == j)) visit(static_cast<std::size_t>(j.index), Wrench{source, k});
      }
    }
  };
  // Counted, then put where those of each marker begin.
  first_at_marker_.assign(layout_.markers.size() + 1, 0);
  for_each_end([&](std::size_t marker, const Wrench&) { ++first_at_marker_[marker + 1]; });
  std::partial_sum(first_at_marker_.begin(), first_at_marker_.end(), first_at_marker_.begin());
  at_marker_.resize(first_at_marker_.back());
  std::vector<std::uint32_t> next = first_at_marker_;
  for_each_end([&](std::size_t marker, const Wrench& wrench) { at_marker_[next[marker]++] = wrench; });
}

MarkerId SignalTable::marker(std::int64_t id) const { return model_.find_marker(id).value_or(global_frame); }

MarkerId SignalTable::place_of(MarkerId m) const {
  const MarkerId followed = model_.marker(m).follows;
  return followed.valid() ? followed : m;
}

bool SignalTable::has_place(MarkerId m) const {
  const Marker& marker = model_.marker(m);
  return !marker.floating || marker.follows.valid() || layout_.curve_point(m);
}

Channel SignalTable::value_of(ElementHandle handle) const {
  return kernel(handle)->channels()->value_channel(static_cast<std::size_t>(handle.index));
}

Channel SignalTable::array_entry(ArrayRef ref, std::size_t n) const {
  const Array& a = *model_.get<Array>(ref);
  if (n >= a.entries()) return {};
  if (a.u) return variable(a.variables[n]);
  if ((a.x || a.y) && !a.owner.valid()) return {};
  const auto owner = static_cast<std::size_t>(a.owner.index);
  if (a.x) return kernel(a.owner)->channels()->state_channel(owner, a.owned_first + n);
  if (a.y) return kernel(a.owner)->channels()->output_channel(owner, n);
  return {Channel::Kind::constant, 0, a.numbers[n]};
}

Channel SignalTable::modal(const Atom& atom) const {
  const auto body = model_.find_body(atom.function->statement, atom.argument[0]);
  const auto n = static_cast<std::size_t>(atom.argument[1] - 1);
  for (const Kernel* k : kernel_of_set_) {
    const ChannelSource* source = body && k ? k->channels() : nullptr;
    if (!source) continue;
    const Channel c = source->shape_channel(*body, n, reads_modal_rate(atom) ? 1 : 0);
    if (c.kind != Channel::Kind::none) return c;
  }
  return {};
}

Channel SignalTable::data(const Atom& atom) const {
  const AtomFunction& f = *atom.function;
  if (reads_modes(atom)) return modal(atom);
  if (f.reads == DataSource::unknown) return {Channel::Kind::algebraic, atom.argument[0]};
  const auto handle = model_.find(f.statement, atom.argument[0]);
  if (!handle) return {};
  const auto n = static_cast<std::size_t>(atom.argument[1] - 1);
  switch (f.reads) {
    case DataSource::value:
      return value_of(*handle);
    case DataSource::array_entry:
      return array_entry({*handle}, n);
    case DataSource::state:
    case DataSource::state_rate:
      return kernel(*handle)->channels()->state_channel(static_cast<std::size_t>(handle->index),
                                                        atom.argument_count > 1 ? n : 0);
    case DataSource::list_entry: {
      const auto* list = model_.get<VariableList>(*handle);
      return list && n < list->variables.size() ? variable(list->variables[n]) : Channel{};
    }
    default:  // no channel has it
      return {};
  }
}

Signals::Wrench SignalTable::wrench(std::string_view statement, std::int64_t id) const {
  const auto handle = model_.find(statement, id);
  const Kernel* owner = handle ? kernel(*handle) : nullptr;
  if (!owner) return {};
  return {owner->wrenches(), static_cast<std::size_t>(handle->index)};
}

}  // namespace dynalin
