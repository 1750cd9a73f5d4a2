// Utilities of compiled routines that ask nothing of the model: numbers as texts, who calculates, how long, in how many
// threads, and the same under the names by which Fortran calls them.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <string>

#include "dynalin/user_routine.h"
#include "dynalin/version.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

// With blanks behind it, as Fortran has it. Too long a text is told, and not given.
void give_text(const std::string& text, char* string, int* length, int* istat, std::size_t room) {
  *istat = text.size() > room;
  *length = static_cast<int>(text.size());
  std::memset(string, ' ', room);
  if (*istat == 0) std::memcpy(string, text.data(), text.size());
}
void give_text(const std::string& text, char* string, int* length, int* istat) {
  *istat = 0;
  *length = static_cast<int>(text.size());
  std::memcpy(string, text.c_str(), text.size() + 1);
}

}  // namespace

void keep_text_utilities() {}

}  // namespace dynalin

using dynalin::give_text;

extern "C" {

void c_istrng(int number, char* string, int* length, int* istat) {
  give_text(fmt::format("{}", number), string, length, istat);
}
void istrng_(const int* number, char* string, int* length, int* istat, std::size_t room) {
  give_text(fmt::format("{}", *number), string, length, istat, room);
}
void c_rstrng(double reel, char* string, int* length, int* istat) {
  give_text(fmt::format("{}", reel), string, length, istat);
}
void rstrng_(const double* reel, char* string, int* length, int* istat, std::size_t room) {
  give_text(fmt::format("{}", *reel), string, length, istat, room);
}

void c_getver(char* value) {
  const std::string name = fmt::format("Dynalin {}", dynalin::version);
  std::memcpy(value, name.c_str(), name.size() + 1);
}
void getver_(char* value, std::size_t room) {
  int length = 0, istat = 0;
  give_text(fmt::format("Dynalin {}", dynalin::version), value, &length, &istat, room);
}
void c_getcpu(double* value) { *value = static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
void getcpu_(double* value) { c_getcpu(value); }

// Routines are called by one thread at a time, whatever they say, and derivatives are taken as the manual says.
void c_get_thread_index(int* index) { *index = 0; }
void c_get_nthread(int* n) { *n = 1; }
void c_adams_declare_threadsafe(void) {}
void c_adams_smp_group(int) {}
void c_set_partial_method(int) {}

}  // extern "C"
