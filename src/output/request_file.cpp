#include "output/request_file.h"

#include <fmt/ostream.h>

#include <algorithm>

namespace dynalin {

namespace {

constexpr std::array<std::size_t, 6> columns_of_file = {1, 2, 3, 5, 6, 7};

}  // namespace

RequestFile::RequestFile(std::ostream& out, const std::string& title, const Units& units, const RequestInfos& requests,
                         std::time_t when)
    : out_(out) {
  fmt::print(out_, " A.R3    {}{:16d}{:10d}  3D\n{}\n", date_and_time(when), requests.size(),
             requests.size() * columns_of_file.size(), title_field(title));
  fmt::print(out_, "{:5d}     {} {:.15E}\n", 0, unit_code(units), units_per_metre(units));
  for (const RequestInfo* r : requests) {
    elements_.push_back(r->request);
    fmt::print(out_, "{:10d}{:10d}{:10d}{:10d}{:10d}\n{}\n", r->request.element.id, static_cast<int>(r->kind),
               r->marker_I, r->marker_J, r->axes, title_field(r->comment));
  }
}

std::vector<std::string> RequestFile::add(double time, const PointRequests& at_time, const OutputSettings& settings) {
  const RequestInfos& requests = at_time.infos;
  out_ << number_field(time, 14) << '\n';
  std::vector<std::string> left_out;
  // Most often they are those of the head, one by one.
  std::vector<std::size_t> at(elements_.size(), requests.size());
  for (std::size_t k = 0; k < requests.size(); ++k) {
    const bool same = k < elements_.size() && elements_[k] == requests[k]->request;
    const auto found = same ? elements_.begin() + static_cast<std::ptrdiff_t>(k)
                            : std::find(elements_.begin(), elements_.end(), requests[k]->request);
    if (found == elements_.end())
      left_out.push_back(requests[k]->request.text());
    else
      at[static_cast<std::size_t>(found - elements_.begin())] = k;
  }
  for (const std::size_t k : at) {
    const RequestColumns columns =
        k < requests.size() ? columns_of(*requests[k], at_time.values[k].values, settings, AngleUnit::radians)
                            : RequestColumns{};
    out_ << ' ';
    for (const std::size_t c : columns_of_file) out_ << number_field(columns[c].value_or(0), 13);
    out_ << '\n';
  }
  return left_out;
}

std::vector<std::string> without_place_in_request_file(const RequestInfos& requests) {
  std::vector<std::string> list;
  for (const RequestInfo* r : requests) {
    for (const RequestComponent& c : r->components()) {
      const bool magnitude = r->kind != RequestKind::functions && (c.place == 1 || c.place == 5);
      const bool there = std::any_of(columns_of_file.begin(), columns_of_file.end(),
                                     [&](std::size_t k) { return static_cast<int>(k) + 1 == c.place; });
      if (!there && !magnitude) list.push_back(c.name + " of " + r->request.text());
    }
  }
  return list;
}

}  // namespace dynalin
