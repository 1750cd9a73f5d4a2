#include "dataset/dataset.h"

#include <algorithm>
#include <functional>

namespace dynalin {

namespace {

void give_back(std::pmr::vector<Token>& list) {
  list.clear();
  list.shrink_to_fit();
}

}  // namespace

std::span<const Token> TokenStore::add(std::span<const Token> tokens) {
  constexpr std::size_t first_block = 256, largest_block = 65536;
  if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < tokens.size()) {
    const std::size_t next = blocks_.empty() ? first_block : std::min(2 * blocks_.back().capacity(), largest_block);
    blocks_.emplace_back(&system_pages()).reserve(std::max(next, tokens.size()));
  }
  std::pmr::vector<Token>& block = blocks_.back();
  block.insert(block.end(), tokens.begin(), tokens.end());
  return std::span<const Token>(block).last(tokens.size());
}

void TokenStore::release_before(std::span<const Token> stored) {
  const auto holds = [&](const std::pmr::vector<Token>& block) {
    const std::less_equal<const Token*> before;
    return !block.empty() && before(block.data(), stored.data()) && before(stored.data(), &block.back());
  };
  std::size_t here = released_;
  while (here < blocks_.size() && !holds(blocks_[here])) ++here;
  if (stored.empty() || here == blocks_.size()) return;
  for (; released_ < here; ++released_) give_back(blocks_[released_]);
}

void Dataset::release_arguments(Statement& statement) {
  for (const WrittenArgument& w : statement.arguments) tokens.release_before(w.value());
  statement.arguments.release();
}

void Dataset::release_arguments() {
  for (Statement& statement : statements) statement.arguments.release();
  tokens = {};
}

}  // namespace dynalin
