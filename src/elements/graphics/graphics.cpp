// GRAPHICS/id, type, …: a shape on a body, for the eye, for exports and for CONTACTs. Alone it has no effect on the
// linear model.
//
// The types and their arguments are in types.h. Datasets of all ages write arguments of one type into another: those
// are passed over.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "elements/families/common_frame.h"
#include "elements/graphics/types.h"
#include "geometry/shape_source.h"

namespace dynalin {

namespace {

using namespace drawing;  // NOLINT: the types of this statement

class Drawing {
 public:
  virtual ~Drawing() = default;
  virtual std::vector<MarkerId> markers() const = 0;
  virtual Shape::Origin origin() const = 0;
  virtual void check(const Model&, const ElementLabel&, Diagnostics&) const = 0;
  virtual void draw(Canvas&) const = 0;
  virtual std::optional<ContactShape> contact_shape(const Model&, std::string& why) const = 0;
  virtual std::string_view type() const = 0;
};

template <class T>
class DrawingOf final : public Drawing {
 public:
  std::vector<MarkerId> markers() const override { return value.markers(); }
  Shape::Origin origin() const override {
    if constexpr (requires { T::origin; }) return T::origin;
    return Shape::Origin::statement;
  }
  void check(const Model& model, const ElementLabel& label, Diagnostics& diagnostics) const override {
    if constexpr (requires { value.check(model, label, diagnostics); }) value.check(model, label, diagnostics);
  }
  void draw(Canvas& canvas) const override { value.draw(canvas); }
  std::optional<ContactShape> contact_shape(const Model& model, std::string& why) const override {
    if constexpr (requires { value.contact_shape(); }) return value.contact_shape();
    if constexpr (requires { value.contact_shape(model, why); }) return value.contact_shape(model, why);
    return std::nullopt;
  }
  std::string_view type() const override { return T::type; }
  T value;
};

// Arguments that any type may have.
struct AnyType {
  Obsolete colour;
  static constexpr std::array<Argument<AnyType>, 1> arguments = {{
      {.name = "COLOR", .slot = &AnyType::colour, .help = "read, without effect"},
  }};
};

// --- all types as one list

template <class... T>
struct TypeList {
  static constexpr std::size_t count = sizeof...(T);
};
// An abbreviation that fits one of the first list means it, whatever is in the second.
using DocumentedTypes = TypeList<Box, Cylinder, Frustum, Circle, Arc, Ellipsoid, Torus, OutlineOf, CurveLine, Plane,
                                 Point, External, SpringDamper, ForceArrow>;
using FurtherTypes = TypeList<Plate, Link, Extrusion, Revolution>;

using ReadType = std::unique_ptr<Drawing> (*)(ElementReader&, std::vector<std::string_view>& passed_over);
template <class T>
std::unique_ptr<Drawing> read_type(ElementReader&, std::vector<std::string_view>& passed_over);

struct TypeRow {
  std::string_view name;
  ReadType read;
};
template <class... T>
constexpr std::array<TypeRow, sizeof...(T)> rows_of(TypeList<T...>) {
  return {TypeRow{T::type, read_type<T>}...};
}
template <std::size_t n>
constexpr auto names_of(const std::array<TypeRow, n>& rows) {
  std::array<std::string_view, n> names{};
  for (std::size_t k = 0; k < n; ++k) names[k] = rows[k].name;
  return names;
}
constexpr auto documented = rows_of(DocumentedTypes{});
constexpr auto further = rows_of(FurtherTypes{});
constexpr auto documented_names = names_of(documented);
constexpr auto further_names = names_of(further);

// --- the arguments of all types together: types first, each name once

struct AllArguments {
  std::array<ArgumentInfo, 100> list{};
  std::size_t count = 0;

  constexpr void add(ArgumentInfo info) {
    for (std::size_t k = 0; k < count; ++k) {
      if (list[k].name == info.name) return;
    }
    info.required = false;
    list[count++] = info;
  }
  template <class... T>
  constexpr void add_types(TypeList<T...>) {
    const auto add_type = [this](std::string_view name) {
      ArgumentInfo info;
      info.name = name, info.is_flag = true, info.help = "types: one of them is stated";
      add(info);
    };
    (..., (T::type == OutlineOf::type ? void() : add_type(T::type)));
  }
  template <class... T>
  constexpr void add_arguments(TypeList<T...>) {
    const auto add_all = [this](const auto& infos) {
      for (const ArgumentInfo& info : infos) add(info);
    };
    (..., add_all(detail::argument_infos<T>));
  }
};
constexpr AllArguments all_arguments = [] {
  AllArguments all;
  all.add_types(DocumentedTypes{}), all.add_types(FurtherTypes{});
  all.add_arguments(DocumentedTypes{}), all.add_arguments(FurtherTypes{}), all.add_arguments(TypeList<AnyType>{});
  return all;
}();
constexpr auto argument_list = [] {
  std::array<ArgumentInfo, all_arguments.count> list{};
  for (std::size_t k = 0; k < list.size(); ++k) list[k] = all_arguments.list[k];
  return list;
}();
constexpr auto all_names = [] {
  std::array<std::string_view, argument_list.size()> names{};
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = argument_list[k].name;
  return names;
}();

// --- reading

// The type that an argument states: a bare word, and OUTLINE with its markers.
const TypeRow* type_of(const WrittenArgument& w) {
  const std::string_view word = w.name.text();
  if (w.has_value) {
    const auto k = find_keyword(word, all_names);
    if (!k || all_names[*k] != OutlineOf::type) return nullptr;
    return &*std::ranges::find(documented, OutlineOf::type, &TypeRow::name);
  }
  std::vector<std::string_view> tied;
  if (const auto k = find_keyword(word, documented_names, &tied)) return &documented[*k];
  if (!tied.empty()) return nullptr;
  if (const auto k = find_keyword(word, further_names)) return &further[*k];
  return nullptr;
}

// Arguments of the type, then what is left to the others.
template <class T>
std::unique_ptr<Drawing> read_type(ElementReader& reader, std::vector<std::string_view>& passed_over) {
  auto drawing = std::make_unique<DrawingOf<T>>();
  const auto& infos = detail::argument_infos<T>;
  const auto& names = detail::argument_names<T>;
  bool ok = true;
  for (const WrittenArgument& w : reader.statement().arguments) {
    if (type_of(w) && !w.has_value) continue;
    std::vector<std::string_view> tied;
    const bool own = find_keyword(w.name.text(), names, &tied) || !tied.empty();
    const auto k = own ? detail::find_argument(w, infos, names, reader)
                       : detail::find_argument(w, argument_list, all_names, reader);
    ok = k && (!own || detail::read_argument(drawing->value, T::arguments[*k], w, reader)) && ok;
    if (k && !own && all_names[*k] != AnyType::arguments[0].name) passed_over.push_back(all_names[*k]);
  }
  if (detail::check_required(infos, reader) && ok) drawing->value.complete(reader);
  return drawing;
}

std::unique_ptr<Drawing> read_drawing(ElementReader& reader, std::vector<std::string_view>& passed_over) {
  const TypeRow* type = nullptr;
  for (const WrittenArgument& w : reader.statement().arguments) {
    const TypeRow* stated = type_of(w);
    if (!stated) continue;
    if (type && type != stated) {
      reader.error("duplicate-variant", w.name,
                   fmt::format("{} is both {} and {}", reader.label().text(), type->name, stated->name));
      return nullptr;
    }
    type = stated;
  }
  if (type) return type->read(reader, passed_over);
  const std::size_t errors = reader.diagnostics().error_count();
  for (const WrittenArgument& w : reader.statement().arguments)
    detail::find_argument(w, argument_list, all_names, reader);
  if (reader.diagnostics().error_count() == errors && !reader.statement().damaged) {
    reader.error("missing-variant", reader.statement().at, "GRAPHICS needs its type",
                 fmt::format("one of {}, {}", fmt::join(documented_names, ", "), fmt::join(further_names, ", ")));
  }
  return nullptr;
}

class GraphicsSet final : public ElementSet, public ShapeSource, public ContactShapeSource {
 public:
  using ElementSet::ElementSet;

  void append(ElementLabel label) override {
    labels.push_back(std::move(label));
    sound.push_back(true);
  }
  void make(std::size_t k) override { drawings_.resize(k + 1); }
  void read(std::size_t k, ElementReader& reader) override { drawings_[k] = read_drawing(reader, passed_over_); }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < drawings_.size(); ++k) check_markers(k, model, diagnostics);
    for (const std::string_view name : passed_over_) model.settings.pass_over("GRAPHICS/" + std::string(name));
  }

  void draw(const Model& model, std::span<const Pose> poses, const ShapeChoice& choice, std::vector<Shape>& shapes,
            Diagnostics& remarks) const override {
    for (std::size_t k = 0; k < drawings_.size(); ++k) {
      if (!drawings_[k] || !choice.wants(drawings_[k]->origin())) continue;
      Canvas canvas(model, poses, labels[k], drawings_[k]->origin(), shapes, remarks);
      drawings_[k]->draw(canvas);
    }
  }

  std::optional<ContactShape> contact_shape(std::size_t k, const Model& model, std::string& why) const override {
    if (!drawings_[k]) return std::nullopt;
    const std::string_view type = drawings_[k]->type();
    why =
        fmt::format("{} {}", std::string_view("AEIO").find(type.front()) == std::string_view::npos ? "a" : "an", type);
    auto shape = drawings_[k]->contact_shape(model, why);
    return shape || why.empty() ? shape : facets(k, model, why);
  }

 private:
  // As it is drawn, in the axes of its first marker.
  std::optional<ContactShape> facets(std::size_t k, const Model& model, std::string& why) const {
    const std::vector<MarkerId> markers = drawings_[k]->markers();
    if (markers.empty() || !sound[k]) return std::nullopt;
    // One end of a LINK may be on another body: the link is on that of the first.
    const auto bends = [&](MarkerId m) {
      return on_one_body(model, m, markers.front()) && !move_as_one(model, m, markers.front());
    };
    if (std::ranges::any_of(markers, bends)) {
      why += fmt::format(" on several nodes of {}", model.body(model.marker(markers.front()).place.body).label.text());
      return std::nullopt;
    }
    std::vector<Pose> poses;
    for (const Body& b : model.bodies) poses.push_back(b.pose);
    std::vector<Shape> shapes;
    Diagnostics remarks;
    Canvas canvas(model, poses, labels[k], drawings_[k]->origin(), shapes, remarks);
    drawings_[k]->draw(canvas);
    if (shapes.empty() && !remarks.items().empty()) why += fmt::format(" ({})", remarks.items().front().message);
    if (shapes.size() != 1 || shapes.front().mesh.faces() == 0) return std::nullopt;
    Mesh& mesh = shapes.front().mesh;
    const Marker& marker = model.marker(markers.front());
    for (Vector& p : mesh.vertices) p = transpose_times(marker.place.R_BM, p - marker.place.p_BM);
    if (!mesh.closed) {
      why += " whose facets do not bound a volume";
      if (const std::string where = leak(mesh); !where.empty())
        why += fmt::format(": in the axes of {}, {}", marker.label->text(), where);
      return std::nullopt;
    }
    return ContactShape{markers.front(), solid::Polyhedron{std::make_shared<const FacetBody>(mesh)}};
  }

  void check_markers(std::size_t k, const Model& model, Diagnostics& diagnostics) const {
    if (!drawings_[k]) return;
    for (const MarkerId m : drawings_[k]->markers()) {
      const Marker& marker = model.marker(m);
      if (!marker.floating) continue;
      diagnostics.error("floating-marker", labels[k].at,
                        fmt::format("{} uses {}, which is floating", labels[k].text(), marker.label->text()),
                        "a fixed marker is needed here");
    }
    drawings_[k]->check(model, labels[k], diagnostics);
  }

  std::vector<std::unique_ptr<Drawing>> drawings_;
  std::vector<std::string_view> passed_over_;
};

}  // namespace

extern constinit const Kind graphics = Kind{
    "GRAPHICS",
    "",
    "A shape on a body, for the eye, for exports and for contacts.",
    Kind::Role::inert,
    argument_list,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<GraphicsSet>(kind);
    }}.with_example("GRAPHICS/4, RADIUS=0.25");

}  // namespace dynalin
