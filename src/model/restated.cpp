#include "model/restated.h"

namespace dynalin {

namespace {

Restated::Element element_of(const ElementLabel& label) { return {std::string(label.statement), label.id}; }

}  // namespace

Restated Restated::all() {
  Restated restated;
  restated.all_ = true;
  return restated;
}

void Restated::state(const Element& element, std::string_view argument) { arguments_[element].emplace(argument); }

void Restated::append(const Restated& more) {
  all_ = all_ || more.all_;
  anew_.insert(more.anew_.begin(), more.anew_.end());
  for (const auto& [element, arguments] : more.arguments_)
    arguments_[element].insert(arguments.begin(), arguments.end());
}

bool Restated::begins(const ElementLabel& label) const { return all_ || anew_.contains(element_of(label)); }

bool Restated::holds(const ElementLabel& label, std::string_view argument) const {
  if (begins(label)) return true;
  const auto stated = arguments_.find(element_of(label));
  return stated != arguments_.end() && stated->second.contains(std::string(argument));
}

}  // namespace dynalin
