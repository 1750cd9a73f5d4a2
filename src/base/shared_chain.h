// A list that is only ever added to at its end, and of which every earlier state lives on by itself. A copy costs no
// more than a pointer, and two lists share what they have in common.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace dynalin {

template <class T>
class SharedChain {
 public:
  void add(T value) {
    auto link = std::make_shared<Link>(std::move(value));
    link->before = std::move(last_);
    last_ = std::move(link);
    ++size_;
  }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  const T& back() const { return last_->value; }
  // From the first to the last.
  std::vector<T> list() const {
    std::vector<T> all(size_);
    std::size_t k = size_;
    for (const Link* link = last_.get(); link; link = link->before.get()) all[--k] = link->value;
    return all;
  }

 private:
  struct Link {
    explicit Link(T of) : value(std::move(of)) {}
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    // One after the other: each from within the next would take a stack as deep as the list is long.
    ~Link() {
      std::shared_ptr<Link> link = std::move(before);
      while (link && link.use_count() == 1) link = std::shared_ptr<Link>(std::move(link->before));
    }
    T value;
    std::shared_ptr<Link> before;
  };

  std::shared_ptr<Link> last_;
  std::size_t size_ = 0;
};

}  // namespace dynalin
