#include "model/view_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace dynalin {

namespace {

// Whether a name is that of something in another: car.arm.cm in car.arm.
bool is_below(std::string_view name, std::string_view owner) {
  return name.size() > owner.size() && name.starts_with(owner) && name[owner.size()] == '.';
}

std::string joined(std::string_view owner, std::string_view name) {
  return owner.empty() ? std::string(name) : fmt::format("{}.{}", owner, name);
}

}  // namespace

bool is_whole_view_name(std::string_view of_model, std::string_view name) {
  return name.starts_with('.') || (!of_model.empty() && is_below(name, of_model));
}

std::string_view view_model_name(std::string_view title) {
  constexpr std::string_view before = "VIEW MODEL NAME:";
  const auto found = std::search(title.begin(), title.end(), before.begin(), before.end(),
                                 [](char t, char b) { return std::toupper(static_cast<unsigned char>(t)) == b; });
  if (found == title.end()) return {};
  std::string_view name = title.substr(static_cast<std::size_t>(found - title.begin()) + before.size());
  while (name.starts_with(' ')) name.remove_prefix(1);
  while (name.ends_with(' ')) name.remove_suffix(1);
  return name;
}

std::string view_path(std::string_view of_model, std::string_view of_part, std::string_view name) {
  if (name.empty() || is_whole_view_name(of_model, name)) return std::string(name);
  if (of_part.empty()) return joined(of_model, name);
  // The part may have the name of the model, and its own name may stand before that of the marker already.
  const std::string part = view_path(of_model, {}, of_part);
  return is_below(name, of_part) ? part + std::string(name.substr(of_part.size())) : joined(part, name);
}

std::string view_path(const Model& model, const ElementLabel& label) {
  return view_path(view_model_name(model.title), {}, label.view_name);
}

std::string view_path(const Model& model, const Marker& marker) {
  return view_path(view_model_name(model.title), model.body(marker.place.body).label.view_name,
                   marker.label->view_name);
}

}  // namespace dynalin
