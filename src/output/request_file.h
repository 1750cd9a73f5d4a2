// The request file (.req): at each time six values of every request, in the layout of files of others:
//
//      A.R3    2026-11-23 02:13:00               2        12  3D     requests, values of a step
//     title (80)
//         0     M_KGS_N_RACA 1.000000000000000E+00                   units, lengths a metre
//             1         1        20         1         0              id, kind, I, J, RM; kinds in the order
//             DISPLACEMENT,
//     comment (80)                                                     VELOCITY, ACCELERATION, FORCE, functions
//        0.00000E+00                                                 time
//       0.00000E+00  …                                               six values of each request
//
// The six values are those of the columns 2 to 4 and 6 to 8 of its table, without the magnitudes; angles are in
// radians. No public sample has a request in it: how they stand in the head is a reading of our own.
#pragma once

#include <ctime>
#include <iosfwd>
#include <string>
#include <vector>

#include "output/request_columns.h"
#include "system/request_values.h"

namespace dynalin {

using RequestInfos = std::vector<const RequestInfo*>;

class RequestFile {
 public:
  // The requests that the file has from its beginning to its end. The infos are not needed after.
  RequestFile(std::ostream&, const std::string& title, const Units&, const RequestInfos&, std::time_t);
  // Requests that are not there at a step are zero; those that the head does not have are left out, and returned.
  std::vector<std::string> add(double time, const PointRequests&, const OutputSettings&);

 private:
  std::ostream& out_;
  std::vector<RequestName> elements_;  // of the head
};

// Components that have no place among the six values: "F1 of REQUEST/3".
std::vector<std::string> without_place_in_request_file(const RequestInfos&);

}  // namespace dynalin
