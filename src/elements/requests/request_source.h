// Requests as those see them who write their values: what each component is and how it is called.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dynalin/request_values.h"
#include "mechanics/motion.h"

namespace dynalin {

enum class RequestKind : std::uint8_t { displacement = 1, velocity, acceleration, force, functions };

// The places of a request are those of the columns of its table, 1 to 8: a magnitude and its x, y and z, and the same
// for rotation. More than eight VARIABLEs have no place.
struct RequestComponent {
  std::string name;        // "MAG", "F2", "VARIABLE/7"
  int place = 0;           // 1 to 8, or 0
  std::string given = {};  // as CNAMES calls it
  std::string unit = {};   // CUNITS
  std::string label = {};  // CLABELS
  bool in_results = true;  // CNAMES leaves what it gives an empty name out of the results file

  const std::string& called() const { return given.empty() ? name : given; }
  friend bool operator==(const RequestComponent&, const RequestComponent&) = default;
};

struct RequestInfo {
  RequestName request;
  std::string view_name = {}, results_name = {}, comment = {};
  std::vector<std::string> heads = {};  // TITLE: of the columns of its table, by place
  RequestKind kind = RequestKind::functions;
  std::int64_t marker_I = 0, marker_J = 0, axes = 0;  // ids; of functions none
  std::shared_ptr<const std::vector<RequestComponent>> list = {};

  const std::vector<RequestComponent>& components() const { return *list; }
};

// Those of a request of markers, but for their texts: one list for all of a kind.
std::shared_ptr<const std::vector<RequestComponent>> components_of(RequestKind);

// The columns of a table of such a request, by place; empty where it has none.
std::array<std::string_view, 8> column_names(RequestKind);

class RequestSource {
 public:
  // Those that can be evaluated.
  virtual std::size_t count() const = 0;
  virtual const RequestInfo& info(std::size_t request) const = 0;
  // Appends the values of one, as many as it has components; what has none is not finite.
  virtual void evaluate(const Motion&, std::size_t request, std::vector<double>& values) const = 0;
  // Why a component has no finite value here, as a sentence that names it.
  virtual std::string undefined_value(const Motion&, std::size_t request) const = 0;

 protected:
  ~RequestSource() = default;
};

}  // namespace dynalin
