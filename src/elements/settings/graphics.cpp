// GRAPHICS/id, type, …: a shape for the display. Its arguments are checked; nothing here draws it.
#include "elements/families/kept_as_text.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct WrittenGraphics {
  bool type = false;
  Obsolete list;
  std::optional<std::int64_t> id;
  std::optional<double> number;
  std::string file;
  std::vector<std::string> words;

  using E = WrittenGraphics;
  static constexpr std::array<Argument<E>, 59> arguments = {{
      {.name = "BOX", .slot = &E::type},
      {.name = "CYLINDER", .slot = &E::type},
      {.name = "FRUSTUM", .slot = &E::type},
      {.name = "CIRCLE", .slot = &E::type},
      {.name = "ARC", .slot = &E::type},
      {.name = "ELLIPSOID", .slot = &E::type},
      {.name = "TORUS", .slot = &E::type},
      {.name = "OUTLINE", .slot = &E::list},
      {.name = "CURVE", .slot = &E::type},
      {.name = "PLANE", .slot = &E::type},
      {.name = "POINT", .slot = &E::type},
      {.name = "EXTERNAL", .slot = &E::type},
      {.name = "SPDP", .slot = &E::type},
      {.name = "FORCE", .slot = &E::type},
      {.name = "CORNER", .slot = &E::id},
      {.name = "X", .slot = &E::number},
      {.name = "Y", .slot = &E::number},
      {.name = "Z", .slot = &E::number},
      {.name = "CM", .slot = &E::id},
      {.name = "LENGTH", .slot = &E::number},
      {.name = "RADIUS", .slot = &E::number},
      {.name = "RANGLE", .slot = &E::number},
      {.name = "SEG", .slot = &E::number},
      {.name = "SIDES", .slot = &E::number},
      {.name = "TOP", .slot = &E::number},
      {.name = "BOTTOM", .slot = &E::number},
      {.name = "XSCALE", .slot = &E::number},
      {.name = "YSCALE", .slot = &E::number},
      {.name = "ZSCALE", .slot = &E::number},
      {.name = "MAJOR_RADIUS", .slot = &E::number},
      {.name = "MINOR_RADIUS", .slot = &E::number},
      {.name = "RMAJOR", .slot = &E::number},
      {.name = "RMINOR", .slot = &E::number},
      {.name = "CID", .slot = &E::id},
      {.name = "CRM", .slot = &E::id},
      {.name = "RM", .slot = &E::id},
      {.name = "XMIN", .slot = &E::number},
      {.name = "XMAX", .slot = &E::number},
      {.name = "YMIN", .slot = &E::number},
      {.name = "YMAX", .slot = &E::number},
      {.name = "FILE", .slot = &E::file},
      {.name = "ELEMENT", .slot = &E::file},
      {.name = "FACETING_TOLERANCE", .slot = &E::number},
      {.name = "I", .slot = &E::id},
      {.name = "J", .slot = &E::id},
      {.name = "COILS", .slot = &E::number},
      {.name = "DA", .slot = &E::number},
      {.name = "DB", .slot = &E::number},
      {.name = "DC", .slot = &E::number},
      {.name = "DD", .slot = &E::number},
      {.name = "LA", .slot = &E::number},
      {.name = "LB", .slot = &E::number},
      {.name = "LC", .slot = &E::number},
      {.name = "LD", .slot = &E::number},
      {.name = "ETYPE", .slot = &E::words},
      {.name = "EID", .slot = &E::id},
      {.name = "EMARKER", .slot = &E::id},
      {.name = "MARKERS", .slot = &E::list},
      {.name = "COLOR", .slot = &E::list},
  }};
};

class GraphicsSet final : public TextSet {
 public:
  using TextSet::TextSet;
  void read(std::size_t, ElementReader& reader) override {
    WrittenGraphics checked;
    read_arguments(checked, reader);
  }
};

}  // namespace

extern constinit const Kind graphics = {
    "GRAPHICS",
    "",
    "A shape for the display.",
    Kind::Role::inert,
    detail::argument_infos<WrittenGraphics>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<GraphicsSet>(kind); }};

}  // namespace dynalin
