#include "output/graphics_file.h"

#include <fmt/ostream.h>

#include "output/request_columns.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

constexpr double before_the_first_time = -999999;

void write_pose(std::ostream& out, const Triple& position, const Triple& angles) {
  out << ' ';
  for (const Triple& three : {position, angles}) {
    for (const double x : three) out << number_field(x, 13);
  }
  out << '\n';
}

Triple plain(const Vector& v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }

}  // namespace

GraphicsFile::GraphicsFile(std::ostream& out, const Model& model, std::time_t when) : out_(out) {
  std::vector<const Marker*> markers;
  for (std::size_t m = 1; m < model.markers.size(); ++m) {
    if (!model.markers[m].floating) markers.push_back(&model.markers[m]);
  }
  fmt::print(out_, " A.G8    {}  {} {:.15E}\n{}\n", date_and_time(when), unit_code(model.units),
             units_per_metre(model.units), title_field(model.title));
  fmt::print(out_, "{:6d}{:5d}", model.bodies.size(), markers.size());
  for (int k = 0; k < 7; ++k) fmt::print(out_, "{:5d}", 0);
  out_ << '\n';
  for (const Body& b : model.bodies)
    fmt::print(out_, "{:11d}{:10d}\n", b.label.id, b.kind == BodyKind::point_mass ? 2 : 1);
  for (const Marker* m : markers) {
    fmt::print(out_, "{:11d}{:10d}", m->label->id, model.body(m->place.body).label.id);
    for (const double x : plain(m->place.p_BM)) out_ << number_field(x, 13);
    fmt::print(out_, "{:8d}\n ", 0);
    for (const double angle : angles_313(m->place.R_BM)) out_ << number_field(angle, 13);
    out_ << '\n';
  }
  out_ << number_field(before_the_first_time, 14) << '\n';
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    write_pose(out_, plain(body.pose.r), body.kind == BodyKind::part ? angles_313(body.pose.R) : Triple{});
  }
}

void GraphicsFile::add(double time, const std::vector<BodyState>& bodies) {
  out_ << number_field(time, 14) << '\n';
  for (const BodyState& b : bodies) write_pose(out_, b.position, b.angles);
}

}  // namespace dynalin
