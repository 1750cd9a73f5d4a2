#pragma once

namespace dynalin {

// Whether partial derivatives are wanted beside values.
enum class Partials : bool { no, yes };

}  // namespace dynalin
