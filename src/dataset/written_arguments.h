// The arguments of one statement, each with its tokens.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>

#include "base/source.h"

namespace dynalin {

enum class TokenKind : std::uint8_t {
  word,    // letters, digits, underscores; starts with a letter or underscore
  number,  // 12, 1.5E-3, 90D
  symbol,  // one of , = : / \ ( ) [ ] + - * % ; ** counts as one symbol
  other,   // a quoted text or other characters: legal only inside values read as raw text
  end,
};

// Eight bytes, since a dataset has as many as it has words and numbers.
struct Token {
  std::uint32_t offset = 0;
  std::uint32_t length : 26 = 0;
  TokenKind kind : 3 = TokenKind::end;
  bool continuation : 1 = false;  // a comma that is the continuation mark at the start of a line
  bool degrees : 1 = false;       // a number with the suffix D
  bool integer : 1 = false;       // a number written without point, exponent and suffix

  static constexpr std::uint32_t longest = (1u << 26) - 1;
};

// `NAME = value` or a bare `NAME`.
class WrittenArgument {
 public:
  Span name;

  // The tokens of the value, which exclude the separators around it and belong to the dataset.
  std::span<const Token> value() const { return {tokens_, count_}; }
  void set_value(std::span<const Token> tokens);
  void set_empty_value(std::uint32_t offset) { tokens_ = nullptr, count_ = 0, offset_ = offset; }
  // From the first to the last token of the value; after '=' if empty.
  Span value_span() const;

 private:
  const Token* tokens_ = nullptr;
  std::uint32_t offset_ = 0;
  std::uint32_t count_ : 30 = 0;

 public:
  bool has_value : 1 = false;  // '=' was written
  // An error inside of it is already reported: the readers below return nothing and add no second error, and
  // its tokens must not be parsed as an expression.
  bool damaged : 1 = false;
};

// The arguments of a statement, in their order. A list costs its statement one pointer, for most are given back early
// and large datasets have millions of them. A copy has memory of its own, whatever that of the arguments of a dataset
// is.
class WrittenArguments {
 public:
  using value_type = WrittenArgument;
  using iterator = WrittenArgument*;
  using const_iterator = const WrittenArgument*;

  WrittenArguments() = default;
  // Copies in that memory, which must outlive them.
  WrittenArguments(std::span<const WrittenArgument>, std::pmr::memory_resource&);
  WrittenArguments(const WrittenArguments& other) : WrittenArguments(other, *std::pmr::new_delete_resource()) {}
  WrittenArguments(WrittenArguments&& other) noexcept : list_(std::exchange(other.list_, nullptr)) {}
  WrittenArguments& operator=(WrittenArguments other) noexcept {
    std::swap(list_, other.list_);
    return *this;
  }
  ~WrittenArguments() { release(); }

  std::size_t size() const { return list_ ? list_->count : 0; }
  bool empty() const { return size() == 0; }
  iterator data() { return list_ ? list_->first() : nullptr; }
  const_iterator data() const { return list_ ? list_->first() : nullptr; }
  iterator begin() { return data(); }
  const_iterator begin() const { return data(); }
  iterator end() { return data() + size(); }
  const_iterator end() const { return data() + size(); }
  WrittenArgument& operator[](std::size_t k) { return data()[k]; }
  const WrittenArgument& operator[](std::size_t k) const { return data()[k]; }
  const WrittenArgument& at(std::size_t k) const;  // throws where there are not so many
  WrittenArgument& front() { return *data(); }
  const WrittenArgument& front() const { return *data(); }
  WrittenArgument& back() { return data()[size() - 1]; }
  const WrittenArgument& back() const { return data()[size() - 1]; }

  void push_back(const WrittenArgument& argument) { insert(size(), {&argument, 1}); }
  // In front of the one with that number; `more` are not of this list.
  void insert(std::size_t before, std::span<const WrittenArgument> more);
  void erase(std::size_t which);
  template <class Condition>
  void erase_if(const Condition& condition) {
    if (list_) list_->count = static_cast<std::uint32_t>(std::remove_if(begin(), end(), condition) - begin());
  }
  // Gives the memory back.
  void release();

 private:
  // Stands in front of its arguments.
  struct List {
    std::pmr::memory_resource* memory;
    std::uint32_t count, room;

    WrittenArgument* first() { return reinterpret_cast<WrittenArgument*>(this + 1); }
    static std::size_t bytes(std::size_t room) { return sizeof(List) + room * sizeof(WrittenArgument); }
  };
  static_assert(alignof(WrittenArgument) <= alignof(List));
  static List* make_list(std::size_t room, std::pmr::memory_resource&);

  List* list_ = nullptr;
};

}  // namespace dynalin
