#include "output/request_tables.h"

#include <fmt/ostream.h>

#include <cstring>

namespace dynalin {

namespace {

constexpr std::size_t width = 14;

std::string marker(std::int64_t id) { return id == 0 ? "the global origin" : fmt::format("MARKER/{}", id); }

std::string head_of(const RequestInfo& r) {
  static constexpr std::array<std::string_view, 4> names = {"DISPLACEMENT", "VELOCITY", "ACCELERATION", "FORCE"};
  std::string text = r.request.text();
  if (!r.view_name.empty()) text += " (" + r.view_name + ")";
  if (r.kind != RequestKind::functions) {
    const bool force = r.kind == RequestKind::force;
    text += fmt::format("   {} {} {}", names[static_cast<std::size_t>(r.kind) - 1], force ? "on" : "of",
                        marker(r.marker_I));
    if (!force || r.marker_J != 0) text += fmt::format(" from {}", marker(r.marker_J));
    text += r.axes == 0 ? ", along the global axes" : fmt::format(", along the axes of {}", marker(r.axes));
  }
  return r.comment.empty() ? text : text + "\n " + r.comment;
}

tl::unexpected<std::string> failed(int error) { return tl::unexpected(std::string(std::strerror(error))); }

}  // namespace

RequestTables::RequestTables(std::ostream& out, const std::string& title, std::string folder)
    : out_(out), folder_(std::move(folder)) {
  fmt::print(out_, " {}\n", title);
}

void RequestTables::begin(std::string what) { what_ = std::move(what), tables_.clear(), steps_.reset(); }

RequestTables::Result RequestTables::add(double time, const PointRequests& requests, const OutputSettings& settings) {
  if (!steps_) {
    settings_ = settings;
    for (const RequestInfo* r : requests.infos) {
      Table table{head_of(*r), {}, column_heads(*r, settings_)};
      for (const RequestComponent& c : r->components()) {
        if (c.place > 0) table.has[static_cast<std::size_t>(c.place - 1)] = true;
      }
      tables_.push_back(std::move(table));
    }
    auto made = RequestSpool::create(folder_, 1 + 8 * tables_.size());
    if (!made) return failed(made.error());
    steps_.emplace(std::move(*made));
  }
  std::vector<double> row{time};
  for (std::size_t k = 0; k < requests.infos.size(); ++k) {
    for (const auto& v : columns_of(*requests.infos[k], requests.values[k].values, settings_, AngleUnit::degrees))
      row.push_back(v.value_or(0));
  }
  if (const int error = steps_->add(row); error != 0) return failed(error);
  return {};
}

RequestTables::Result RequestTables::end() {
  if (!steps_) return {};
  fmt::print(out_, "\n\n {}\n", what_);
  for (std::size_t k = 0; k < tables_.size(); ++k) {
    const Table& table = tables_[k];
    fmt::print(out_, "\n {}\n{:>{}}", table.head, "TIME", width);
    for (std::size_t c = 0; c < 8; ++c) {
      if (table.has[c]) fmt::print(out_, " {:>{}.{}}", table.columns[c], width - 1, width - 1);
    }
    out_ << '\n';
    const auto field = settings_.fixed ? fixed_field : number_field;
    const int error = steps_->read([&](std::span<const double> row) {
      out_ << field(row[0], width);
      for (std::size_t c = 0; c < 8; ++c) {
        if (table.has[c]) out_ << field(row[1 + 8 * k + c], width);
      }
      out_ << '\n';
    });
    if (error != 0) return failed(error);
  }
  steps_.reset();
  return {};
}

}  // namespace dynalin
