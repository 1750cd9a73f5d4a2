// Elements as directives name them: by the path of View, car.wheel.cm, without the parts before the name that are not
// needed to tell it from others. Case matters.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "model/model.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

// Why a name does not lead to one element.
struct NameProblem {
  std::string_view code;
  std::string message, hint;
};
template <class T>
using Named = tl::expected<T, NameProblem>;

Named<MarkerId> marker_of_id(const Model&, std::int64_t id);
Named<MarkerId> marker_of_name(const Model&, std::string_view name);
// Of a statement: SFORCE.
Named<const ElementLabel*> element_of_name(const Model&, std::string_view statement, std::string_view name);

// The marker of a channel by id or name, or by both if they say the same.
Named<MarkerId> marker_of_channel(const Model&, const ChannelMarker&);

}  // namespace dynalin::nastran
