// The perturbation equations as they are, for others to work with.
#pragma once

#include "dynalin/descriptor_form.h"
#include "linear/linear_system.h"

namespace dynalin {

DescriptorForm descriptor_form(const Perturbation&);

}  // namespace dynalin
