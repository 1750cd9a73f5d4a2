// One law, -(k x + h x^3 + c v) with x and v of marker par[0] from par[1], as a routine that tells its derivatives, as
// a formula, and as a routine that gives none.
#include <dynalin/user_routine.hpp>

namespace {

struct Reading {
  int at[4];
  double x, v;
};
Reading read(const double* par) {
  const int i = static_cast<int>(par[0]), j = static_cast<int>(par[1]);
  Reading r{{i, j, j, j}, 0, 0};
  int error = 0;
  c_sysfnc("DX", r.at, 3, &r.x, &error);
  c_sysfnc("VX", r.at, 4, &r.v, &error);
  return r;
}
double law(const double* par, const Reading& r) { return -(par[2] * r.x + par[3] * r.x * r.x * r.x + par[4] * r.v); }

struct Spring {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const int i = static_cast<int>(call.parameter(0)), j = static_cast<int>(call.parameter(1));
    const T x = call.measure("DX", {i, j, j}), v = call.measure("VX", {i, j, j, j});
    value[0] = -(call.parameter(2) * x + call.parameter(3) * x * x * x + call.parameter(4) * v);
  }
};

}  // namespace

DYNALIN_USER_ROUTINE(by_formula, Spring)

extern "C" void by_nothing(const int*, const double*, const double* par, const int*, const int*, const int*,
                           double* value) {
  *value = law(par, read(par));
}
extern "C" void by_syspar(const int*, const double*, const double* par, const int*, const int*, const int*,
                          double* value) {
  const Reading r = read(par);
  *value = law(par, r);
  int wanted = 0, error = 0;
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  const double by_x = -(par[2] + 3 * par[3] * r.x * r.x), by_v = -par[4];
  c_syspar("DX", r.at, 3, &by_x, 1, &error);
  c_syspar("VX", r.at, 4, &by_v, 1, &error);
}
