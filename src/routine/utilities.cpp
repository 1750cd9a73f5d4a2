// The utilities of include/dynalin/user_routine.h, and the same under the names by which Fortran calls them.
#include "routine/utilities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <string>

#include "routine/routine_context.h"

namespace dynalin {

namespace {

std::span<const int> ids_of(const int* ipar, int nsize) {
  return nsize > 0 && ipar ? std::span(ipar, static_cast<std::size_t>(nsize)) : std::span<const int>();
}

double input_value(const RoutineContext& c, std::int32_t input) {
  return c.phase == RoutineContext::Phase::asking ? 0.0 : c.inputs[static_cast<std::size_t>(input)];
}

void read(std::string_view name, const int* ipar, int nsize, Quantity quantity, double* out, int* count, int* errflg) {
  RoutineContext* c = RoutineContext::current();
  const RoutineRequest* r = c ? c->request(name, ids_of(ipar, nsize), quantity) : nullptr;
  *errflg = r == nullptr;
  if (count) *count = r ? static_cast<int>(r->inputs.size()) : 0;
  if (!r) {
    if (quantity == Quantity::number) *out = 0;
    return;
  }
  if (!out) return;  // who only wants to know how many
  for (std::size_t k = 0; k < r->inputs.size(); ++k) out[k] = input_value(*c, r->inputs[k]);
}

// Whether there are as many as there ought to be: one for each value and each input.
bool give_partials(RoutineContext& c, std::string_view name, std::span<const std::int32_t> inputs,
                   const double* partial, int count) {
  if (const std::size_t wanted = inputs.size() * c.values; count < 0 || static_cast<std::size_t>(count) != wanted) {
    c.miscount = fmt::format("tells {} partial derivatives by {}, and there are {}", count, name, wanted);
    return false;
  }
  if (!c.wants_partials()) return true;
  for (std::size_t s = 0; s < inputs.size(); ++s) {
    const auto input = static_cast<std::size_t>(inputs[s]);
    // What is asked for twice depends on the sum of both.
    for (std::size_t v = 0; v < c.values; ++v) c.partials[v * c.inputs.size() + input] += partial[v + c.values * s];
    c.given[input] = true;
  }
  return true;
}

void give(std::string_view name, const int* ipar, int nsize, const double* partial, int count, int* errflg) {
  RoutineContext* c = RoutineContext::current();
  *errflg = 1;
  if (!c) return;
  const auto ids = ids_of(ipar, nsize);
  if (ids.empty() && (name == "TIME" || name == "time")) {
    constexpr std::array<std::int32_t, 1> time = {0};
    *errflg = !give_partials(*c, "TIME", time, partial, count);
    return;
  }
  const RoutineRequest* r = c->known(name, ids, Quantity::list);
  if (!r) r = c->known(name, ids, Quantity::number);
  if (!r) return;
  *errflg = !give_partials(*c, name, r->inputs, partial, count);
}

// Of the GSE at work: 0 where none is.
int number_of(int sAdamsGSE::*member) {
  const RoutineContext* c = RoutineContext::current();
  return c && c->gse ? c->gse->*member : 0;
}

constexpr std::string_view rates_of_states = "GSE_XDOT";

// A list of the GSE at work, by the id of its ARRAY or by its own.
void read_list(std::string_view name, int id, double* out, int size, int expected) {
  RoutineContext* c = RoutineContext::current();
  if (!c || size == 0) return;
  if (!c->gse) return c->fail("it asks for states or inputs of a GSE, and is called for none");
  if (size != expected) {
    return c->fail(fmt::format("it asks for {} numbers where its GSE has {}", size, expected));
  }
  int count = 0, errflg = 0;
  read(name, &id, 1, Quantity::list, out, &count, &errflg);
}

void give_list(std::string_view name, int id, const double* partial, int count) {
  int errflg = 0;
  give(name, &id, 1, partial, count, &errflg);
}

// Iterations call a routine again and again: each text is said once, and no endless number of them.
void say_once(std::string_view text) {
  constexpr std::size_t most = 1000;
  static std::mutex mutex;
  static std::set<std::string, std::less<>> said;
  const std::lock_guard lock(mutex);
  if (said.size() >= most || !said.emplace(text).second) return;
  fmt::print(stderr, "{}: {}\n", RoutineContext::what(), text);
}

void message(int flag, std::string_view text, std::string_view end) {
  RoutineContext* c = RoutineContext::current();
  if (!c || flag == 0 || c->phase == RoutineContext::Phase::asking) return;
  std::string word(end);
  std::ranges::transform(word, word.begin(), [](unsigned char x) { return static_cast<char>(std::toupper(x)); });
  if (word == "STOP") return c->fail(fmt::format("it says: {}", text));
  say_once(text);
}

}  // namespace

std::string_view text_of(const char* text, std::size_t length) {
  std::string_view all(text, length);
  if (const auto end = all.find('\0'); end != std::string_view::npos) all = all.substr(0, end);
  while (!all.empty() && all.back() == ' ') all.remove_suffix(1);
  return all;
}

std::string_view text_of(const char* text) { return text_of(text, std::strlen(text)); }

void keep_utilities() {
  keep_function_utilities();
  keep_data_utilities();
  keep_rotation_utilities();
  keep_text_utilities();
  keep_missing_utilities();
}

}  // namespace dynalin

using namespace dynalin;

extern "C" {

void c_sysfnc(const char* name, const int* ipar, int nsize, double* state, int* errflg) {
  read(text_of(name), ipar, nsize, Quantity::number, state, nullptr, errflg);
}
void sysfnc_(const char* name, const int* ipar, const int* nsize, double* state, int* errflg, std::size_t length) {
  read(text_of(name, length), ipar, *nsize, Quantity::number, state, nullptr, errflg);
}

void c_sysary(const char* name, const int* ipar, int nsize, double* states, int* nstates, int* errflg) {
  read(text_of(name), ipar, nsize, Quantity::list, states, nstates, errflg);
}
void sysary_(const char* name, const int* ipar, const int* nsize, double* states, int* nstates, int* errflg,
             std::size_t length) {
  read(text_of(name, length), ipar, *nsize, Quantity::list, states, nstates, errflg);
}

void c_gtaray(int id, double* array, int* number, int* istat) {
  read("ARRAY", &id, 1, Quantity::list, array, number, istat);
}
void gtaray_(const int* id, double* array, int* number, int* istat) { c_gtaray(*id, array, number, istat); }

void c_adams_needs_partials(int* wanted) {
  const RoutineContext* c = RoutineContext::current();
  *wanted = c && c->wants_partials();
}
void adams_needs_partials_(int* wanted) { c_adams_needs_partials(wanted); }

void c_syspar(const char* name, const int* ipar, int nsize, const double* partial, int npartial, int* errflg) {
  give(text_of(name), ipar, nsize, partial, npartial, errflg);
}
void syspar_(const char* name, const int* ipar, const int* nsize, const double* partial, const int* npartial,
             int* errflg, std::size_t length) {
  give(text_of(name, length), ipar, *nsize, partial, *npartial, errflg);
}

void c_errmes(int errflg, const char* text, int, const char* endflg) { message(errflg, text, text_of(endflg)); }
void errmes_(const int* errflg, const char* text, const int*, const char* endflg, std::size_t length,
             std::size_t end_length) {
  message(*errflg, text_of(text, length), text_of(endflg, end_length));
}
void c_usrmes(int msgflg, const char* text, int, const char* endflg) { message(msgflg, text, text_of(endflg)); }
void usrmes_(const int* msgflg, const char* text, const int*, const char* endflg, std::size_t length,
             std::size_t end_length) {
  message(*msgflg, text_of(text, length), text_of(endflg, end_length));
}

void c_timget(double* time) {
  const RoutineContext* c = RoutineContext::current();
  *time = c ? input_value(*c, 0) : 0.0;
}
void timget_(double* time) { c_timget(time); }
void c_getmod(int* mode) {
  const RoutineContext* c = RoutineContext::current();
  *mode = c ? static_cast<int>(input_value(*c, 1)) : 0;
}
void getmod_(int* mode) { c_getmod(mode); }

int c_gse_ns(void) { return number_of(&sAdamsGSE::NS); }
int c_gse_nd(void) { return number_of(&sAdamsGSE::ND); }
int c_gse_ni(void) { return number_of(&sAdamsGSE::NI); }
int c_gse_no(void) { return number_of(&sAdamsGSE::NO); }
void gse_ns_(int* n) { *n = c_gse_ns(); }
void gse_nd_(int* n) { *n = c_gse_nd(); }
void gse_ni_(int* n) { *n = c_gse_ni(); }
void gse_no_(int* n) { *n = c_gse_no(); }

void c_gse_x(double* x, int ns) { read_list("ARRAY", number_of(&sAdamsGSE::X), x, ns, c_gse_ns()); }
void c_gse_xdot(double* xdot, int ns) { read_list(rates_of_states, number_of(&sAdamsGSE::ID), xdot, ns, c_gse_ns()); }
void c_gse_xd(double* xd, int nd) { read_list("ARRAY", number_of(&sAdamsGSE::XD), xd, nd, c_gse_nd()); }
void c_gse_u(double* u, int ni) { read_list("ARRAY", number_of(&sAdamsGSE::U), u, ni, c_gse_ni()); }
void gse_x_(double* x, const int* ns) { c_gse_x(x, *ns); }
void gse_xdot_(double* xdot, const int* ns) { c_gse_xdot(xdot, *ns); }
void gse_xd_(double* xd, const int* nd) { c_gse_xd(xd, *nd); }
void gse_u_(double* u, const int* ni) { c_gse_u(u, *ni); }

void c_gsepar_x(const double* partial, int n) { give_list("ARRAY", number_of(&sAdamsGSE::X), partial, n); }
void c_gsepar_xdot(const double* partial, int n) { give_list(rates_of_states, number_of(&sAdamsGSE::ID), partial, n); }
void c_gsepar_u(const double* partial, int n) { give_list("ARRAY", number_of(&sAdamsGSE::U), partial, n); }
void gsepar_x_(const double* partial, const int* n) { c_gsepar_x(partial, *n); }
void gsepar_xdot_(const double* partial, const int* n) { c_gsepar_xdot(partial, *n); }
void gsepar_u_(const double* partial, const int* n) { c_gsepar_u(partial, *n); }

int dynalin_gse_array(int which) {
  if (which == 'X') return number_of(&sAdamsGSE::X);
  if (which == 'D') return number_of(&sAdamsGSE::XD);
  return which == 'U' ? number_of(&sAdamsGSE::U) : 0;
}

int dynalin_input(const char* name, const int* ipar, int nsize) {
  const RoutineContext* c = RoutineContext::current();
  const RoutineRequest* r = c ? c->known(text_of(name), ids_of(ipar, nsize), Quantity::number) : nullptr;
  return r ? r->inputs.front() : -1;
}
int dynalin_input_of_array(const char* name, const int* ipar, int nsize, int n) {
  const RoutineContext* c = RoutineContext::current();
  const RoutineRequest* r = c ? c->known(text_of(name), ids_of(ipar, nsize), Quantity::list) : nullptr;
  return r && n >= 0 && static_cast<std::size_t>(n) < r->inputs.size() ? r->inputs[static_cast<std::size_t>(n)] : -1;
}

}  // extern "C"
