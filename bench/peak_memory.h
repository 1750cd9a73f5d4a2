// Largest memory the process has had so far, MB; 0 where the system does not tell.
#pragma once

#include <fstream>
#include <string>

inline double peak_megabytes() {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  }
  return 0;
}
