// What routines can be told of a model before it is read: how long its lists are, which of them are constants, and
// which data it has, as the elements say (told_beforehand.h). How many modes flexible bodies have, and their modal
// loads, takes reading these by themselves, once, where a routine needs them.
#include "model/told_beforehand.h"

#include <algorithm>

#include "model/called_words.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

const RoutineConstants no_constants;

}  // namespace

const Kind* CalledRoutines::kind_told_of(std::string_view statement) const {
  const auto found = told_.find(statement);
  return found == told_.end() ? nullptr : found->second;
}

template <class Tell>
void CalledRoutines::for_each_told(const Tell& tell) const {
  for (const Statement& s : dataset_.statements) {
    const Kind* kind = kind_told_of(s.name);
    if (kind && kind->told_beforehand) tell(s, *kind->told_beforehand, Words(*this, s, no_constants));
  }
}

const RoutineData::Modes* CalledRoutines::modes_of(std::int64_t flex_body) const {
  if (!bodies_) {
    auto bodies = std::make_shared<Dataset>();
    bodies->source = dataset_.source, bodies->title = dataset_.title;
    for (const Statement& s : dataset_.statements) {
      const Kind* kind = kind_told_of(s.name);
      if (!kind) continue;
      const std::string_view ground_word = kind->ground_word;
      const bool ground = !ground_word.empty() && argument(s, ground_word) != nullptr;
      const ToldBeforehand* part = kind->told_beforehand;
      if (!ground && !(part && part->makes_modes)) continue;
      bodies->statements.emplace_back(s).arguments.erase_if([&](const WrittenArgument& w) {
        const std::string_view name = full_name(s, w);
        return ground ? name != ground_word
                      : !name.empty() && std::ranges::find(part->not_for_modes, name) != part->not_for_modes.end();
      });
    }
    bodies_ = std::make_shared<RoutineData>();
    RoutineOptions alone;
    alone.data = bodies_;
    // Whoever reads the whole model says what is wrong.
    if (build_model(std::move(bodies), catalogue_, {}, alone).diagnostics.has_errors())
      bodies_->flexible_bodies.clear();
  }
  const auto found = bodies_->flexible_bodies.find(static_cast<int>(flex_body));
  return found == bodies_->flexible_bodies.end() ? nullptr : &found->second;
}

const CalledRoutines::Index& CalledRoutines::index() const {
  if (index_) return *index_;
  index_ = std::make_unique<Index>();
  for (const Statement& s : dataset_.statements) {
    if (s.id) index_->statements.emplace(std::pair(std::string_view(s.name), *s.id), &s);
  }
  // What gives lists may look other statements up.
  for_each_told([this](const Statement&, const ToldBeforehand& told, const Words& words) {
    if (!told.fills) return;
    for (const FilledList& f : told.fills(words))
      index_->filled.emplace(std::pair(f.statement, std::int64_t{f.id}), f.size);
  });
  return *index_;
}

const Statement* CalledRoutines::statement(std::string_view name, std::int64_t id) const {
  const auto& all = index().statements;
  const auto found = all.find(std::pair(name, id));
  return found == all.end() ? nullptr : found->second;
}

std::optional<std::size_t> CalledRoutines::size_of_list(std::string_view name, std::int32_t id) const {
  const Statement* s = statement(name, id);
  const Kind* kind = s ? kind_told_of(name) : nullptr;
  const ToldBeforehand* told = kind ? kind->told_beforehand : nullptr;
  if (!told) return std::nullopt;
  if (told->has_modes) {
    const RoutineData::Modes* modes = modes_of(id);
    return modes ? std::optional(modes->number.size()) : std::nullopt;
  }
  const auto filled = index().filled.find(std::pair(name, std::int64_t{id}));
  if (filled != index().filled.end()) return filled->second;
  return told->size ? told->size(Words(*this, *s, no_constants)) : std::nullopt;
}

std::shared_ptr<const std::vector<int>> CalledRoutines::constant_arrays() const {
  auto ids = std::make_shared<std::vector<int>>();
  for_each_told([&](const Statement&, const ToldBeforehand& told, const Words& words) {
    if (told.is_constant && told.is_constant(words)) ids->push_back(words.id());
    if (!told.fills) return;
    for (const FilledList& f : told.fills(words)) {
      if (f.is_constant) ids->push_back(f.id);
    }
  });
  std::ranges::sort(*ids);
  return ids;
}

std::shared_ptr<RoutineData> CalledRoutines::ids_of_data() const {
  auto data = std::make_shared<RoutineData>();
  for_each_told([&](const Statement&, const ToldBeforehand& told, const Words& words) {
    if (told.data) told.data(words, *data);
  });
  return data;
}

}  // namespace dynalin
