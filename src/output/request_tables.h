// Tables of requests (.out): for each simulation one table a request, a row for each time. They are written when a
// simulation ends; until then its steps are set aside (request_spool).
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "output/request_columns.h"
#include "output/request_spool.h"
#include "system/request_values.h"

namespace dynalin {

class RequestTables {
 public:
  // What is set aside lies in `folder`.
  RequestTables(std::ostream&, const std::string& title, std::string folder);
  // What the tables are about: "Dynamic simulation".
  void begin(std::string what);
  using Result = tl::expected<void, std::string>;  // the error is a reason to stand behind a name
  // All steps between begin and end have the same requests.
  Result add(double time, const PointRequests&, const OutputSettings&);
  Result end();

 private:
  struct Table {
    std::string head;           // what is requested, and its comment
    std::array<bool, 8> has{};  // columns
    std::array<std::string, 8> columns;
  };
  std::ostream& out_;
  std::string folder_, what_;
  OutputSettings settings_;  // at the first step
  std::vector<Table> tables_;
  std::optional<RequestSpool> steps_;
};

}  // namespace dynalin
