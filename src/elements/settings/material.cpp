// MATERIAL/id, NAME=, DENSITY=, YOUNGS_MODULUS=, POISSONS_RATIO=
//
// An elastic material that is the same in all directions, G = E/(2 (1 + ν)). An FE_PART is made of it; on a rigid part
// it has no effect, so that what else old datasets state here is passed over, with a warning, unless an FE_PART asks
// for it.
#include "elements/settings/material.h"

#include "dataset/characters.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct Material : MaterialData {
  std::string name;

  static constexpr std::array<Argument<Material>, 4> arguments = {{
      {.name = "NAME", .slot = &Material::name, .help = "for the reader"},
      {.name = "DENSITY", .slot = &Material::density, .unit = "mass/length³", .minimum = 0, .help = "0 unless stated"},
      {.name = "YOUNGS_MODULUS",
       .slot = &Material::youngs_modulus,
       .unit = "force/length²",
       .minimum = 0,
       .help = "of stretching"},
      {.name = "POISSONS_RATIO",
       .slot = &Material::poissons_ratio,
       .minimum = -1,
       .help = "contraction across by stretch along, -1 to 0.5",
       .maximum = 0.5},
  }};
};

class MaterialSet final : public TypedSet<Material> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    for (const WrittenArgument& w : reader.statement().arguments) {
      if (is_foreign(w.name.text())) {
        if (!elements[k].other.source) elements[k].other = w.name;
        passed_over_.push_back("MATERIAL/" + upper_case(w.name.text()));
        continue;
      }
      const auto row =
          detail::find_argument(w, detail::argument_infos<Material>, detail::argument_names<Material>, reader);
      if (row && *row < Material::arguments.size())
        detail::read_argument(elements[k], Material::arguments[*row], w, reader);
    }
  }
  void finish(Model& model, Diagnostics&) override {
    for (const std::string& name : passed_over_) model.settings.pass_over(name);
  }

 private:
  // Neither an argument nor the slip of a pen that meant one.
  static bool is_foreign(std::string_view name) {
    const std::span<const std::string_view> names = detail::argument_names<Material>;
    return !find_keyword(name, names) && nearest_word(name, names).empty();
  }

  std::vector<std::string> passed_over_;
};

}  // namespace

const MaterialData* material_data(const Model& model, ElementHandle handle) { return model.get<Material>(handle); }

extern constinit const Kind material = Kind{
    "MATERIAL",
    "",
    "What an FE_PART is made of.",
    Kind::Role::element,
    detail::argument_infos<Material>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<MaterialSet>(kind);
    }}.with_example("MATERIAL/1, DENSITY=7801");

}  // namespace dynalin
