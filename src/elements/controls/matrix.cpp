#include "elements/controls/matrix.h"
#include "model/schema.h"
namespace dynalin { namespace { struct S final : TypedSet<Matrix> { using TypedSet::TypedSet; void read(std::size_t, ElementReader&) override {} }; }
extern constinit const Kind matrix = {"MATRIX","","",Kind::Role::element,{},[](const Kind& k)->std::unique_ptr<ElementSet>{return std::make_unique<S>(k);}};
}
