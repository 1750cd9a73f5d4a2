// Names of Adams View. The path of one has those of the model, of the part that a marker is on, and of the element:
// car.wheel.cm. Names may hold dots of their own, as SPRING_1.sforce, and parts of their path.
#pragma once

#include <string>
#include <string_view>

#include "model/model.h"

namespace dynalin {

// What a title "Adams View model name: car" says, nothing where it says something else.
std::string_view view_model_name(std::string_view title);

// Whether a name has that of the model already, or begins with a dot as those of the whole session of View do.
bool is_whole_view_name(std::string_view of_model, std::string_view name);
// A name with those of the part and the model, empty if there are none, before it; nothing of nothing.
std::string view_path(std::string_view of_model, std::string_view of_part, std::string_view name);
std::string view_path(const Model&, const ElementLabel&);
std::string view_path(const Model&, const Marker&);

}  // namespace dynalin
