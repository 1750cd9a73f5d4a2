#include "system/operating_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/controls/variable_list.h"
#include "mechanics/wrench_source.h"
#include "system/mass_centres.h"

namespace dynalin {

namespace {

Triple plain(const Vector& v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }

class Reading {
 public:
  Reading(const System& system, const OperatingPoint& op)
      : system_(system), model_(system.model()), layout_(system.layout()), op_(op), motion_(system.motion(op)) {}

  OperatingState read() {
    read_constraints();
    return read_over_time();
  }
  OperatingState read_over_time() {
    state_.time = op_.time;
    read_bodies();
    read_loads();
    read_values();
    return std::move(state_);
  }

 private:
  void read_bodies() {
    const std::vector<Vec3<Taylor>> centres = mass_centres(system_, motion_);
    for (std::size_t b = 1; b < motion_.bodies.size(); ++b) {
      const BodyMotion& m = motion_.bodies[b];
      const BodyBlock& block = layout_.bodies[b];
      BodyState s;
      s.name = block.label.full_text();
      s.element = block.label.element(), s.node = block.listed.node;
      if (s.node > 0) s.name += fmt::format(" node {}", s.node);
      s.view_name = block.label.view_name;
      s.position = plain(m.r);
      s.axes = {plain(m.R[0]), plain(m.R[1]), plain(m.R[2])};
      s.turns = block.turns();
      if (s.turns) s.angles = angles_313(m.R);
      s.velocity = plain(m.rdot), s.angular_velocity = plain(m.w);
      s.acceleration = plain(m.rddot), s.angular_acceleration = plain(m.wdot);
      s.centre_position = plain(dynalin::value(centres[b]));
      s.centre_velocity = plain(rate(centres[b]));
      s.centre_acceleration = plain(acceleration(centres[b]));
      state_.bodies.push_back(std::move(s));
    }
  }

  // By statement in the order of the catalogue, then by id.
  void read_loads() {
    std::vector<const ElementLabel*> owners;
    for (const ConstraintRow& row : layout_.rows) owners.push_back(row.owner);
    std::sort(owners.begin(), owners.end());
    struct Entry {
      std::size_t statement;
      std::int64_t id;
      bool constraint;
      Load load;
    };
    std::vector<Entry> entries;
    std::map<std::string_view, std::size_t> order;
    for (std::size_t s = 0; s < model_.sets.size(); ++s) {
      const auto& set = model_.sets[s];
      if (set->size() == 0 || !set->active) continue;
      const Kernel* kernel = system_.signals().element(ElementHandle{static_cast<std::int32_t>(s), 0}).kernel;
      const WrenchSource* wrenches = kernel ? kernel->reported_wrenches() : nullptr;
      if (!wrenches) continue;
      const std::size_t statement = order.emplace(set->kind().statement, order.size()).first->second;
      for (std::size_t w = 0; w < wrenches->wrench_count(set->size()); ++w) {
        const ElementLabel& label = set->labels[wrenches->element_of_wrench(w)];
        const bool constraint = std::binary_search(owners.begin(), owners.end(), &label);
        entries.push_back({statement, label.id, constraint, load(*wrenches, w, *set, label)});
      }
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.statement, a.id) < std::pair(b.statement, b.id);
    });
    for (Entry& e : entries) (e.constraint ? state_.reactions : state_.forces).push_back(std::move(e.load));
  }

  Load load(const WrenchSource& wrenches, std::size_t which, const ElementSet& set, const ElementLabel& label) {
    wrench_.clear();
    wrenches.wrench(motion_, which, Partials::no, wrench_);
    Load l;
    l.element = label.element();
    l.variant = set.kind().variant;
    l.view_name = label.view_name;
    const auto id = [&](MarkerId m) { return m.valid() ? model_.marker(m).label->id : 0; };
    l.marker_I = id(wrenches.marker_I(which)), l.marker_J = id(wrenches.marker_J(which));
    l.force = plain(wrench_.force.force), l.torque = plain(wrench_.force.torque);
    const MarkerId of_axes = wrenches.marker_of_axes(which);
    const bool fixed = of_axes.valid() && !model_.marker(of_axes).floating;
    const Matrix3 R = fixed ? motion_.axes(layout_.marker(of_axes)) : Matrix3::identity();
    l.axes = fixed ? id(of_axes) : 0;
    l.force_in_axes = plain(transpose(R) * wrench_.force.force);
    l.torque_in_axes = plain(transpose(R) * wrench_.force.torque);
    return l;
  }

  void read_constraints() {
    ConstraintRows rows;
    rows.resize(layout_);
    system_.constraints(motion_, rows);
    const Partition part = system_.partition(rows, RowLevel::velocity);
    for (std::size_t k = 0; k < layout_.rows.size(); ++k) {
      const ConstraintRow& row = layout_.rows[k];
      state_.constraints.push_back({row.owner->element(), std::string(row.name), op_.lambda[k] + 0.0, !part.active[k]});
    }
  }

  double value(const Channel& c) const {
    const auto k = static_cast<std::size_t>(c.index);
    switch (c.kind) {
      case Channel::Kind::algebraic:
        return op_.algebraic[k] + 0.0;
      case Channel::Kind::state:
        return op_.state[k] + 0.0;
      case Channel::Kind::state_rate:
        return op_.state_rate[k] + 0.0;
      default:
        return c.constant;
    }
  }

  void read_values() {
    for (std::size_t s = 0; s < model_.sets.size(); ++s) {
      const ElementSet& set = *model_.sets[s];
      if (!set.active) continue;
      const Kind::Gives gives = set.kind().gives;
      for (std::size_t k = 0; k < set.size(); ++k) {
        const ElementLabel& label = set.labels[k];
        const ElementHandle handle{static_cast<std::int32_t>(s), static_cast<std::int32_t>(k)};
        if (gives == Kind::Gives::value) {
          state_.variables.push_back(
              {label.id, std::string(label.view_name), value(system_.signals().variable({handle}))});
        } else if (gives == Kind::Gives::plant_inputs || gives == Kind::Gives::plant_outputs) {
          ChannelValues c{label.element(), std::string(label.view_name), {}};
          for (const VariableRef v : model_.get<VariableList>(handle)->variables)
            c.values.push_back(value(system_.signals().variable(v)));
          (gives == Kind::Gives::plant_inputs ? state_.plant_inputs : state_.plant_outputs).push_back(std::move(c));
        }
      }
    }
    for (std::size_t k = 0; k < layout_.states.size(); ++k) {
      const DifferentialState& z = layout_.states[k];
      if (z.course_of_motion) continue;
      state_.states.push_back({z.owner->element(), std::string(z.owner->view_name), z.coordinate, op_.state[k] + 0.0,
                               op_.state_rate[k] + 0.0});
    }
    for (const ExtraBlock& e : layout_.extras) {
      for (std::int32_t k = 0; k < e.count; ++k) {
        const std::size_t at = layout_.extra_index(e.offset + k);
        state_.parameters.push_back({e.label.element(), e.coordinates[static_cast<std::size_t>(k)].name,
                                     op_.extra[at] + 0.0, op_.velocity[static_cast<std::size_t>(e.offset + k)] + 0.0});
      }
    }
  }

  const System& system_;
  const Model& model_;
  const Layout& layout_;
  const OperatingPoint& op_;
  const Motion motion_;
  MarkerWrench wrench_;
  OperatingState state_;
};

}  // namespace

std::optional<double> variable_value(const System& system, const OperatingPoint& op, std::int64_t id) {
  const auto handle = system.model().find(VariableClass::statement, id);
  if (!handle) return std::nullopt;
  return op.algebraic[static_cast<std::size_t>(system.signals().variable({*handle}).index)];
}

Triple angles_313(const Matrix3& R) {
  const double sine = std::hypot(R.z.x, R.z.y), theta = std::atan2(sine, R.z.z);
  constexpr double sine_of_vertical = 1e-12;
  if (sine <= sine_of_vertical) return {std::atan2(R.x.y, R.x.x), R.z.z > 0 ? 0.0 : theta, 0.0};
  return {std::atan2(R.z.x, -R.z.y), theta, std::atan2(R.x.z, R.y.z)};
}

OperatingState operating_state(const System& system, const OperatingPoint& op) { return Reading(system, op).read(); }

OperatingState state_over_time(const System& system, const OperatingPoint& op) {
  return Reading(system, op).read_over_time();
}

}  // namespace dynalin
