#include "nastran/frequency_response.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace dynalin::nastran {

namespace {

// Numbers from a first one with an increment, but for those that something else has.
class Numbers {
 public:
  Numbers(Ids& ids, IdSpace space, std::int64_t first, std::int64_t increment)
      : ids_(ids), space_(space), next_(first), increment_(increment) {}
  std::int64_t next() {
    while (!ids_.is_free(space_, next_)) next_ += increment_;
    return ids_.take(space_, next_);
  }

 private:
  Ids& ids_;
  IdSpace space_;
  std::int64_t next_, increment_;
};

class Response {
 public:
  Response(const Deck& deck, const ExportOptions& options, Ids& ids, CardFile& file)
      : deck_(deck), o_(options), ids_(ids), file_(file) {}

  std::vector<ResponseCase> write(Diagnostics& remarks) {
    std::vector<Subcase> subcases = o_.frequency_response_subcase;
    std::ranges::sort(subcases, {}, &Subcase::number);
    Numbers dloads(ids_, IdSpace::dynamic_load, o_.dload_card_number, o_.dload_card_number_increment);
    Numbers sets(ids_, IdSpace::set, o_.set_card_number, o_.set_card_number_increment);
    std::vector<ResponseCase> cases;
    std::vector<std::vector<std::string>> inputs;
    for (const Subcase& s : subcases) {
      std::vector<std::string> names = there(s.input_channel_names);
      ResponseCase made;
      made.number = s.number, made.grids = grids_of(s.output_channel_names);
      if (names.empty() || made.grids.empty()) {
        remarks.warning(
            "export-left-out", {},
            fmt::format("subcase {} has no {} channel and is left out", s.number, names.empty() ? "input" : "output"));
        continue;
      }
      made.dload = dloads.next(), made.set = sets.next();
      made.label = fmt::format("{} -> {}", fmt::join(names, " "), fmt::join(s.output_channel_names, " "));
      cases.push_back(std::move(made));
      inputs.push_back(std::move(names));
    }
    write_frequencies();
    write_inputs();
    for (std::size_t k = 0; k < cases.size(); ++k) write_dload(cases[k].dload, inputs[k]);
    return cases;
  }

 private:
  const InputChannel& channel(const InputPoint& p) const { return o_.force_input_channel[p.channel]; }

  std::vector<std::string> there(const std::vector<std::string>& names) const {
    std::vector<std::string> list;
    for (const std::string& name : names) {
      const bool exists =
          std::ranges::any_of(deck_.inputs, [&](const InputPoint& p) { return channel(p).name == name; });
      if (exists && std::ranges::find(list, name) == list.end()) list.push_back(name);
    }
    return list;
  }
  std::vector<std::int64_t> grids_of(const std::vector<std::string>& names) const {
    std::set<std::int64_t> grids;
    for (const OutputPoint& p : deck_.outputs) {
      const std::string& name = o_.displacement_output_channel[p.channel].name;
      if (std::ranges::find(names, name) != names.end()) grids.insert(p.grid);
    }
    return {grids.begin(), grids.end()};
  }

  void write_frequencies() {
    if (!o_.begin_frequency || !o_.end_frequency || !o_.steps_frequency) return;
    const double begin = *o_.begin_frequency, end = *o_.end_frequency;
    const bool logarithmic = o_.spacing_frequency == Spacing::log;
    file_.heading("frequencies");
    Card card = file_.card(logarithmic ? "FREQ2" : "FREQ1");
    card.integer(o_.frequency_card_number).real(begin);
    card.real(logarithmic ? end : (end - begin) / static_cast<double>(*o_.steps_frequency))
        .integer(*o_.steps_frequency);
    file_.add(card, {});
  }

  // A force of 1 where the channel acts, with the phase of its actuator; its magnitude is the table's.
  void write_inputs() {
    Numbers loads(ids_, IdSpace::dynamic_load, o_.rload1_card_number, o_.rload1_card_number_increment);
    Numbers forces(ids_, IdSpace::static_load, o_.force_card_number, o_.force_card_number_increment);
    Numbers phases(ids_, IdSpace::phase, o_.dphase_card_number, o_.dphase_card_number_increment);
    Numbers tables(ids_, IdSpace::table, o_.tabled1_card_number, o_.tabled1_card_number_increment);
    std::map<std::string, std::int64_t> table_of;
    for (const InputPoint& p : deck_.inputs) {
      const InputChannel& c = channel(p);
      if (rload_of_.contains(c.name)) continue;
      const auto actuator = std::ranges::find(o_.actuator_swept_sine, c.actuator_name, &Actuator::name);
      if (actuator == o_.actuator_swept_sine.end()) continue;
      const Owner owner{-1, c.name};
      file_.heading("input channels");
      std::int64_t& table = table_of[actuator->name];
      if (table == 0) {
        table = tables.next();
        write_table(table, *actuator);
      }
      const std::int64_t force = forces.next();
      const bool torque = c.dof > 3;
      Card load = file_.card(torque ? "MOMENT" : "FORCE");
      load.integer(force).integer(p.grid).integer(p.system).real(1);
      for (int axis = 1; axis <= 3; ++axis) load.real((c.dof - 1) % 3 + 1 == axis ? 1 : 0);
      file_.add(load, owner);
      std::int64_t phase = 0;
      if (actuator->phase_angle != 0) {
        phase = phases.next();
        Card lead = file_.card("DPHASE");
        lead.integer(phase).integer(p.grid).integer(c.dof).real(actuator->phase_angle * 180 / std::numbers::pi);
        file_.add(lead, owner);
      }
      const std::int64_t rload = rload_of_[c.name] = loads.next();
      Card dynamic = file_.card("RLOAD1");
      dynamic.integer(rload).integer(force).blank().reference(phase).integer(table);
      file_.add(dynamic, owner);
    }
  }
  // The same at all frequencies: two points of a table are a line.
  void write_table(std::int64_t number, const Actuator& a) {
    Card table = file_.card("TABLED1");
    table.integer(number).row().real(0).real(a.magnitude).real(o_.end_frequency.value_or(1)).real(a.magnitude);
    table.word("ENDT");
    file_.add(table, {-1, a.name});
  }
  void write_dload(std::int64_t number, const std::vector<std::string>& inputs) {
    file_.heading("loads of subcases");
    Card card = file_.card("DLOAD");
    card.integer(number).real(1);
    for (const std::string& name : inputs) {
      if (const auto load = rload_of_.find(name); load != rload_of_.end()) card.real(1).integer(load->second);
    }
    file_.add(card, {});
  }

  const Deck& deck_;
  const ExportOptions& o_;
  Ids& ids_;
  CardFile& file_;
  std::map<std::string, std::int64_t> rload_of_;  // by channel
};

}  // namespace

std::vector<ResponseCase> write_response(const Deck& deck, const ExportOptions& options, Ids& ids, CardFile& file,
                                         Diagnostics& remarks) {
  return Response(deck, options, ids, file).write(remarks);
}

}  // namespace dynalin::nastran
