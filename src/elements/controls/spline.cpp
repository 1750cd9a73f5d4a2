// SPLINE/id, {X=, Y= [, Y= …] | FILE= [, BLOCK=] [, CHANNEL=]} [, LINEAR_EXTRAPOLATE]
//
// Data points for AKISPL, CUBSPL and INTERP: one curve, or a family of curves over the same x, where each list Y begins
// with the z of its curve.
//
// A file holds lines of numbers, x first (spline_file.h). Two columns are one curve; with more, CHANNEL picks one, and
// a line `Z z1 z2 …` before the numbers makes the columns a family.
#include "elements/controls/spline.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/read_file.h"
#include "elements/controls/spline_file.h"
#include "elements/families/curve.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

struct WrittenSpline {
  std::vector<double> x;
  std::vector<std::vector<double>> y;
  std::string file, block;
  std::optional<std::int64_t> channel;
  bool linear = false;

  static constexpr std::array<Argument<WrittenSpline>, 6> arguments = {{
      {.name = "X", .slot = &WrittenSpline::x, .help = "at least 4 values, increasing", .ends = "FILE BLOCK CHANNEL"},
      {.name = "Y",
       .slot = &WrittenSpline::y,
       .help = "as many; in a family z of the curve comes first",
       .ends = "FILE BLOCK CHANNEL"},
      {.name = "FILE", .slot = &WrittenSpline::file, .help = "text file with the points", .ends = "X Y"},
      {.name = "BLOCK", .slot = &WrittenSpline::block, .help = "the block of the file, [NAME]"},
      {.name = "CHANNEL", .slot = &WrittenSpline::channel, .minimum = 1, .help = "which column behind x"},
      {.name = "LINEAR_EXTRAPOLATE",
       .slot = &WrittenSpline::linear,
       .help = "a line beyond the points, not a parabola"},
  }};
};

class SplineSet final : public TypedSet<Spline> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    WrittenSpline w;
    if (!read_arguments(w, reader)) return;
    SplineData data;
    data.linear_extrapolation = w.linear;
    const bool by_file = reader.given("FILE"), by_values = reader.given("X") || reader.given("Y");
    if (by_file && by_values) {
      const std::string_view other = reader.given("X") ? "X" : "Y";
      reader.error("excluded-arguments", reader.at(other),
                   fmt::format("FILE and {} of {} exclude each other", other, reader.label().text()));
      return;
    }
    if (!by_file && !(reader.given("X") && reader.given("Y"))) {
      reader.error("missing-argument", reader.statement().at,
                   fmt::format("{} needs X and Y, or FILE", reader.label().text()));
      return;
    }
    for (const auto name : {"BLOCK", "CHANNEL"}) {
      if (by_values && reader.given(name)) {
        reader.error("unexpected-argument", reader.at(name), fmt::format("{} goes with FILE", name));
        return;
      }
    }
    const bool ok = by_file ? read_file(w, data, reader) : take_values(w, data, reader);
    if (ok && check(data, reader, reader.at(by_file ? "FILE" : "X"))) {
      elements[k].data = std::make_shared<const SplineData>(std::move(data));
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    check_spectra(model, diagnostics);
    if (!model.routine_data) return;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (!elements[k].data) continue;
      const auto curves = [&](SplineMethod by) { return std::make_shared<const SplineCurves>(elements[k].data, by); };
      model.routine_data->splines[static_cast<int>(labels[k].id)] = {curves(SplineMethod::akima),
                                                                     curves(SplineMethod::cubic)};
    }
  }

 private:
  // A power spectral density is not negative, and nothing but positive where its logarithm counts.
  static void check_spectra(const Model& model, Diagnostics& diagnostics) {
    for (const SplineUse& use : model.spectra) {
      const Spline* s = model.get<Spline>(*model.find("SPLINE", use.id));
      if (!s || !s->data) continue;
      const std::string fault = why_no_spectrum(*s->data, use.spectrum->logarithmic);
      if (fault.empty()) continue;
      diagnostics.error("spline-data", use.id_at,
                        fmt::format("INVPSD takes SPLINE/{} as a power spectral density, one curve of numbers {}: {}",
                                    use.id, use.spectrum->logarithmic ? "above 0" : "that are 0 or more", fault));
    }
  }

  static bool take_values(const WrittenSpline& w, SplineData& data, ElementReader& reader) {
    data.x = w.x;
    data.y = w.y;
    const bool family = w.y.size() > 1 || w.y[0].size() == w.x.size() + 1;
    for (std::vector<double>& y : data.y) {
      if (y.size() != w.x.size() + (family ? 1 : 0)) {
        reader.error("wrong-count", reader.at("Y"),
                     fmt::format("{} has {} values of X and a list Y with {}{}", reader.label().text(), w.x.size(),
                                 y.size(), family ? ", where z and as many are needed" : ""));
        return false;
      }
      if (!family) continue;
      data.z.push_back(y.front());
      y.erase(y.begin());
    }
    if (data.z.size() == 1) data.z.clear();
    return true;
  }

  static bool read_file(const WrittenSpline& w, SplineData& data, ElementReader& reader) {
    const std::filesystem::path path = std::filesystem::path(reader.folder()) / w.file;
    reader.reads(path.string());
    auto text = dynalin::read_file(path.string());
    if (!text) {
      reader.error(
          "unreadable-file", reader.at("FILE"),
          fmt::format("the file {} of {} cannot be read: {}", path.string(), reader.label().text(), text.error()));
      return false;
    }
    const auto source = std::make_shared<const SourceText>(path.string(), std::move(*text));
    reader.keep(source);
    const auto table = read_spline_table(*source, w.block, reader);
    if (!table) return false;
    const auto& [rows, z] = *table;
    const std::size_t columns = rows.front().size() - 1;
    if (w.channel && static_cast<std::size_t>(*w.channel) > columns) {
      reader.error("value-out-of-range", reader.at("CHANNEL"),
                   fmt::format("CHANNEL is {}, the file has {} columns behind x", *w.channel, columns));
      return false;
    }
    if (!w.channel && columns > 1 && z.size() != columns) {
      reader.error("spline-data", reader.at("FILE"),
                   fmt::format("{} has {} columns behind x: CHANNEL, or a line Z with as many values, is needed",
                               path.string(), columns));
      return false;
    }
    for (const std::vector<double>& row : rows) data.x.push_back(row[0]);
    for (std::size_t c = 0; c < columns; ++c) {
      if (w.channel && static_cast<std::size_t>(*w.channel) != c + 1) continue;
      std::vector<double>& y = data.y.emplace_back();
      for (const std::vector<double>& row : rows) y.push_back(row[c + 1]);
    }
    if (data.y.size() > 1) data.z = z;
    return true;
  }

  static bool check(const SplineData& data, ElementReader& reader, const Span& at) {
    const std::string name = reader.label().text();
    if (data.x.size() < 4) {
      reader.error("spline-data", at, fmt::format("{} has {} points, it needs at least 4", name, data.x.size()));
      return false;
    }
    for (std::size_t k = 1; k < data.x.size(); ++k) {
      if (data.x[k] > data.x[k - 1]) continue;
      reader.error(
          "spline-data", at,
          fmt::format("X of {} must increase: value {} is {}, after {}", name, k + 1, data.x[k], data.x[k - 1]));
      return false;
    }
    for (std::size_t k = 1; k < data.z.size(); ++k) {
      if (data.z[k] > data.z[k - 1]) continue;
      reader.error(
          "spline-data", at,
          fmt::format("z of {} must increase: curve {} has {}, after {}", name, k + 1, data.z[k], data.z[k - 1]));
      return false;
    }
    return true;
  }
};

}  // namespace

void attach_data(const Model& model, SplineUse& use) {
  const auto handle = model.find(use.statement(), use.id);
  if (!handle) return;
  if (const Curve* c = model.get<Curve>(*handle)) use.parametric = c->shape;
  const Spline* s = model.get<Spline>(*handle);
  if (!s) return;
  if (use.spectrum) {
    use.signal = std::make_shared<const HarmonicSignal>(*s->data, *use.spectrum);
  } else {
    use.curves = std::make_shared<const SplineCurves>(s->data, use.method);
  }
}

namespace {

constexpr ToldBeforehand told_of_spline = {
    .data = [](const StatementWords& s, RoutineData& data) { data.splines[s.id()]; }};

}  // namespace

extern constinit const Kind spline =
    Kind{"SPLINE",
         "",
         "Data points of a curve or of a family of curves.",
         Kind::Role::element,
         detail::argument_infos<WrittenSpline>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<SplineSet>(kind); }}
        .telling(told_of_spline)
        .with_example("SPLINE/1, Y=0,1,4,9");

}  // namespace dynalin
