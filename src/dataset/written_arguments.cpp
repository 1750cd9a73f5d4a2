#include "dataset/written_arguments.h"

#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace dynalin {

void WrittenArgument::set_value(std::span<const Token> tokens) {
  constexpr std::size_t most = (1u << 30) - 1;
  if (tokens.size() > most) throw std::length_error("a value of an argument is too long");
  tokens_ = tokens.data(), count_ = static_cast<std::uint32_t>(tokens.size()) & most, offset_ = tokens.front().offset;
}

Span WrittenArgument::value_span() const {
  if (count_ == 0) return {name.source, offset_, 0};
  const Token& last = tokens_[count_ - 1];
  return {name.source, offset_, last.offset + last.length - offset_};
}

WrittenArguments::List* WrittenArguments::make_list(std::size_t room, std::pmr::memory_resource& memory) {
  if (room > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("a statement has too many arguments");
  void* const place = memory.allocate(List::bytes(room), alignof(List));
  return new (place) List{&memory, 0, static_cast<std::uint32_t>(room)};
}

WrittenArguments::WrittenArguments(std::span<const WrittenArgument> arguments, std::pmr::memory_resource& memory) {
  if (arguments.empty()) return;
  list_ = make_list(arguments.size(), memory);
  std::uninitialized_copy(arguments.begin(), arguments.end(), list_->first());
  list_->count = list_->room;
}

const WrittenArgument& WrittenArguments::at(std::size_t k) const {
  if (k >= size()) throw std::out_of_range("a statement has fewer arguments");
  return (*this)[k];
}

void WrittenArguments::insert(std::size_t before, std::span<const WrittenArgument> more) {
  constexpr std::size_t least = 4;
  const std::size_t count = size() + more.size();
  WrittenArguments longer;
  if (!list_ || count > list_->room) {
    auto& memory = list_ ? *list_->memory : *std::pmr::new_delete_resource();
    longer.list_ = make_list(std::max({count, 2 * size(), least}), memory);
    std::uninitialized_copy(begin(), end(), longer.list_->first());
    longer.list_->count = static_cast<std::uint32_t>(size());
    std::swap(list_, longer.list_);
  }
  std::move_backward(begin() + before, end(), begin() + count);
  std::copy(more.begin(), more.end(), begin() + before);
  list_->count = static_cast<std::uint32_t>(count);
}

void WrittenArguments::erase(std::size_t which) {
  std::move(begin() + which + 1, end(), begin() + which);
  --list_->count;
}

void WrittenArguments::release() {
  if (!list_) return;
  list_->memory->deallocate(list_, List::bytes(list_->room), alignof(List));
  list_ = nullptr;
}

}  // namespace dynalin
