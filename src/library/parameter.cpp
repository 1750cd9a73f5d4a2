#include "model/parameter.h"

#include "base/remark_of.h"
#include "dynalin/error.h"

namespace dynalin {

ParameterRef::ParameterRef(const char* name) : ParameterRef(std::string(name)) {}

ParameterRef::ParameterRef(const std::string& name) {
  auto parsed = parse_parameter(name);
  if (!parsed) throw Error(render(parsed.error()), {remark_of(parsed.error())});
  *this = std::move(*parsed);
}

}  // namespace dynalin
