// What the ids of one class of statements stand for, in as little memory as large datasets need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dynalin {

// An id is 1 to 2147483647; others are in no table.
template <class Value>
class IdTable {
 public:
  std::size_t size() const { return size_; }
  // So many are to come, and no room for more is wanted.
  void reserve(std::size_t count) {
    if (count > 0) resize(slots_for(count));
  }
  // Null if the id is not there.
  const Value* find(std::int64_t id) const {
    if (id < 1 || id > longest || entries_.empty()) return nullptr;
    const Entry& entry = entries_[slot_of(static_cast<std::int32_t>(id))];
    return entry.id == free_slot ? nullptr : &entry.value;
  }
  // What the id stands for, and whether it is new; the first one stays.
  std::pair<const Value*, bool> emplace(std::int32_t id, const Value& value) {
    if (slots_for(size_ + 1) > entries_.size()) resize(slots_for(2 * size_ + least));
    Entry& entry = entries_[slot_of(id)];
    const bool fresh = entry.id == free_slot;
    if (fresh) entry = {id, value}, ++size_;
    return {&entry.value, fresh};
  }
  // visit(id, value), in no order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Entry& entry : entries_) {
      if (entry.id != free_slot) visit(entry.id, entry.value);
    }
  }

 private:
  static constexpr std::int32_t free_slot = 0, longest = 0x7FFFFFFF;
  static constexpr std::size_t least = 8;
  struct Entry {
    std::int32_t id = free_slot;
    Value value{};
  };

  // A quarter of the slots stays free.
  static std::size_t slots_for(std::size_t count) { return count + count / 3 + 2; }

  // Its own slot, or the free one where it belongs. Ids that follow each other stand side by side, in places that a
  // multiplication strews over the table.
  std::size_t slot_of(std::int32_t id) const {
    constexpr std::uint32_t neighbours = 3;  // 2³ of them
    const auto number = static_cast<std::uint32_t>(id);
    const std::uint32_t strewn = (number >> neighbours) * 0x9E3779B1u;
    const std::uint64_t group = (std::uint64_t{strewn} * (entries_.size() >> neighbours)) >> 32;
    std::size_t slot = (group << neighbours) + (number & ((1u << neighbours) - 1));
    while (slot >= entries_.size() || (entries_[slot].id != free_slot && entries_[slot].id != id))
      slot = slot + 1 < entries_.size() ? slot + 1 : 0;
    return slot;
  }

  void resize(std::size_t slots) {
    if (slots <= entries_.size()) return;
    std::vector<Entry> before = std::exchange(entries_, std::vector<Entry>(slots));
    for (const Entry& entry : before) {
      if (entry.id != free_slot) entries_[slot_of(entry.id)] = entry;
    }
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

}  // namespace dynalin
