// Numbers of a dataset by name, read and replaced. Other numbers are applied as a statement that states them, like any
// edit (dataset_edits.h), so that whatever follows from them (checks of ranges, inertia in other axes, curves through
// points) is made anew by the same readers.
#pragma once

#include <span>
#include <string_view>
#include <tl/expected.hpp>

#include "dynalin/parameter.h"
#include "model/dataset_edits.h"

namespace dynalin {

// What ParameterRef::text() writes; otherwise what is wrong with it.
tl::expected<ParameterRef, Diagnostic> parse_parameter(std::string_view);

// The number that the dataset states, or that holds because it does not; or why there is none. The statements must have
// their arguments.
tl::expected<double, Diagnostic> parameter(const Dataset&, const ParameterRef&, Catalogue);

// The dataset with other numbers in these places, or what stands in the way: every one that is wrong. A number that is
// not stated is stated so, with those beside it as they were. The new dataset shares the text of the old one.
tl::expected<EditedDataset, Diagnostics> with_parameters(std::shared_ptr<const Dataset>,
                                                         std::span<const ParameterChange>, Catalogue);

}  // namespace dynalin
