// `dynalin reduce`: matrices of a finite-element program to a body file.
#pragma once

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace dynalin::reduction {

struct ReduceOptions {
  std::string stiffness, mass;            // CalculiX .sti and .mas, Matrix Market, or punch files with DMIG
  std::string freedoms;                   // of CalculiX and Matrix Market; empty: .dof beside the stiffness
  std::string nodes;                      // where the nodes are
  std::string stiffness_name, mass_name;  // of DMIG; empty for the only ones
  std::string output;                     // the body file
  std::vector<std::string> interface;     // node, or node:rotation-node
  std::vector<std::string> also;          // further nodes that the body file has
  long modes = -1;                        // fixed-interface modes, at most; negative: 20, or all up to the frequency
  double frequency_limit = std::numeric_limits<double>::infinity();  // of these [cycles/time]
  bool translations_only = false;
  double length_factor = 1, mass_factor = 1, force_factor = 1;
};

// Exit statuses are those of the program: 0 done, 1 the input is wrong, 2 the reduction failed, 3 usage.
int reduce(const ReduceOptions&, std::ostream& out, std::ostream& err);

}  // namespace dynalin::reduction
