#include "elements/families/pair_displacement.h"

namespace dynalin {

namespace {

RelativeWrench reaction_of(Displacement kind, const PairMotion& pair, double lambda) {
  return reaction<1>({displacement(kind, path::nested(pair.relative))}, std::span(&lambda, 1));
}

}  // namespace

Taylor PairDisplacement::along_motion(const Motion& motion) const {
  Taylor d = displacement(kind_, pair_motion(motion, I_, J_).relative);
  if (memory_ >= 0) d.value = unwrapped(d.value, motion.memory[static_cast<std::size_t>(memory_)]);
  return d;
}

void PairDisplacement::add_to_row(const Motion& motion, double factor, std::int32_t row, ConstraintRows& rows) const {
  const PairMotion pair = pair_motion(motion, I_, J_);
  add_pair_row(row, pair, factor * displacement(kind_, path::seeded<6>(pair.relative)), rows);
}

void PairDisplacement::add_reaction_partials(const Motion& motion, double lambda, Equations& eq) const {
  const PairMotion pair = pair_motion(motion, I_, J_);
  apply_partials(pair, spread(pair, reaction_of(kind_, pair, lambda), Partials::yes), eq);
}

void PairDisplacement::wrench(const Motion& motion, double lambda, std::int32_t row, Partials wanted,
                              MarkerWrench& out) const {
  out.pair = pair_motion(motion, I_, J_);
  out.force = spread(out.pair, reaction_of(kind_, out.pair, lambda), wanted);
  if (wanted == Partials::yes) add_multiplier(displacement(kind_, path::nested(out.pair.relative)), row, out);
}

std::optional<JointFreedom> joint_freedom(const Model& model, const ElementLabel& user, JointRef joint,
                                          DrivenFreedom wanted, Diagnostics& diagnostics) {
  const auto* joints = dynamic_cast<const JointSetBase*>(&model.set(joint));
  if (!joints) return std::nullopt;
  const auto index = static_cast<std::size_t>(joint.index);
  const std::string name = model.label(joint).full_text();
  const auto self = model.find(user.statement, user.id);
  if (!joints->active && self && model.set(*self).active) {
    diagnostics.error("inactive-joint", user.at,
                      fmt::format("{} refers to {}, which a command has deactivated", user.full_text(), name),
                      fmt::format("deactivate {} first", user.text()));
    return std::nullopt;
  }
  if (!joints->rotates() && !joints->translates()) {
    diagnostics.error("undrivable-joint", user.at,
                      fmt::format("{} refers to {}, a {} joint, which has no freedom to drive", user.full_text(), name,
                                  joints->kind().variant));
    return std::nullopt;
  }
  const bool both = joints->rotates() && joints->translates();
  const bool unclear = wanted == DrivenFreedom::only && both;
  if (unclear || (wanted == DrivenFreedom::rotation && !joints->rotates()) ||
      (wanted == DrivenFreedom::translation && !joints->translates())) {
    diagnostics.error("wrong-freedom", user.at,
                      fmt::format("{} must name the freedom of {} that it drives", user.full_text(), name),
                      both                ? "it has two, a rotation and a translation"
                      : joints->rotates() ? "it has one, a rotation"
                                          : "it has one, a translation");
    return std::nullopt;
  }
  const bool turns = wanted == DrivenFreedom::only ? joints->rotates() : wanted == DrivenFreedom::rotation;
  return JointFreedom{joints->marker_I(index), joints->marker_J(index),
                      turns ? Displacement::rotation : translation_of_joint};
}

}  // namespace dynalin
