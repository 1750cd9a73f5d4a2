// Functions of the language as utilities of compiled routines: STEP, IMPACT, POLY ... with their derivatives, and the
// same under the names by which Fortran calls them.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "dynalin/user_routine.h"
#include "expression/functions.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

// Value, first or second derivatives by the first `variables` arguments, the latter as xx, or xx, xy, yy. Says whether
// there are any.
bool evaluate(std::string_view name, std::span<const double> at, std::size_t variables, int order, double* out) {
  const Function& f = *find_function(name);
  const std::size_t results = order == 0 ? 1 : order == 1 ? variables : variables * (variables + 1) / 2;
  std::fill_n(out, results, 0.0);
  if (order < 0 || order > 2 || at.size() < f.minimum_arguments || at.size() > f.maximum_arguments) return false;
  if (!f.domain(at).empty()) return false;
  // Along a straight course of the arguments.
  const auto along = [&](std::array<double, 2> rate) {
    std::vector<TimeTaylor<double>> course;
    for (std::size_t k = 0; k < at.size(); ++k) course.emplace_back(at[k], k < variables ? rate[k] : 0.0, 0.0);
    return f(std::span<const TimeTaylor<double>>(course));
  };
  if (order == 0) {
    out[0] = f(at);
  } else if (variables == 1) {
    const auto x = along({1, 0});
    out[0] = order == 1 ? x.rate : x.acceleration;
  } else {
    const auto x = along({1, 0}), y = along({0, 1});
    if (order == 1) {
      out[0] = x.rate, out[1] = y.rate;
    } else {
      out[0] = x.acceleration, out[2] = y.acceleration;
      out[1] = 0.5 * (along({1, 1}).acceleration - x.acceleration - y.acceleration);
    }
  }
  return std::all_of(out, out + results, [](double v) { return std::isfinite(v); });
}

// What has no value, by its arguments or because of too many coefficients, is told by errflg alone.
void evaluate(std::string_view name, std::initializer_list<double> at, std::size_t variables, int order, double* out,
              int* errflg) {
  *errflg = !evaluate(name, std::span(at.begin(), at.size()), variables, order, out);
}

void evaluate_series(std::string_view name, std::initializer_list<double> first, const double* par, int npar, int order,
                     double* value, int* errflg) {
  std::vector<double> at(first);
  if (npar > 0) at.insert(at.end(), par, par + std::min<std::size_t>(static_cast<std::size_t>(npar), most_arguments));
  *errflg = !evaluate(name, at, 1, order, value);
}

}  // namespace

void keep_function_utilities() {}

}  // namespace dynalin

using dynalin::evaluate, dynalin::evaluate_series;

extern "C" {

void c_step(double x, double x0, double h0, double x1, double h1, int iord, double* value, int* errflg) {
  evaluate("STEP", {x, x0, h0, x1, h1}, 1, iord, value, errflg);
}
void c_step5(double x, double x0, double h0, double x1, double h1, int iord, double* value, int* errflg) {
  evaluate("STEP5", {x, x0, h0, x1, h1}, 1, iord, value, errflg);
}
void c_havsin(double x, double x0, double h0, double x1, double h1, int iord, double* value, int* errflg) {
  evaluate("HAVSIN", {x, x0, h0, x1, h1}, 1, iord, value, errflg);
}
void c_impact(double x, double dxdt, double x1, double k, double e, double cmax, double d, int iord, double* vec,
              int* errflg) {
  evaluate("IMPACT", {x, dxdt, x1, k, e, cmax, d}, 2, iord, vec, errflg);
}
void c_bistop(double x, double dxdt, double x1, double x2, double k, double e, double cmax, double d, int iord,
              double* vec, int* errflg) {
  evaluate("BISTOP", {x, dxdt, x1, x2, k, e, cmax, d}, 2, iord, vec, errflg);
}
void c_shf(double x, double x0, double a, double w, double phi, double b, int iord, double* value, int* errflg) {
  evaluate("SHF", {x, x0, a, w, phi, b}, 1, iord, value, errflg);
}
void c_poly(double x, double x0, const double* par, int npar, int iord, double* value, int* errflg) {
  evaluate_series("POLY", {x, x0}, par, npar, iord, value, errflg);
}
void c_cheby(double x, double x0, const double* par, int npar, int iord, double* value, int* errflg) {
  evaluate_series("CHEBY", {x, x0}, par, npar, iord, value, errflg);
}
void c_forcos(double x, double x0, double w, const double* par, int npar, int iord, double* value, int* errflg) {
  evaluate_series("FORCOS", {x, x0, w}, par, npar, iord, value, errflg);
}
void c_forsin(double x, double x0, double w, const double* par, int npar, int iord, double* value, int* errflg) {
  evaluate_series("FORSIN", {x, x0, w}, par, npar, iord, value, errflg);
}

void step_(const double* x, const double* x0, const double* h0, const double* x1, const double* h1, const int* iord,
           double* value, int* errflg) {
  c_step(*x, *x0, *h0, *x1, *h1, *iord, value, errflg);
}
void step5_(const double* x, const double* x0, const double* h0, const double* x1, const double* h1, const int* iord,
            double* value, int* errflg) {
  c_step5(*x, *x0, *h0, *x1, *h1, *iord, value, errflg);
}
void havsin_(const double* x, const double* x0, const double* h0, const double* x1, const double* h1, const int* iord,
             double* value, int* errflg) {
  c_havsin(*x, *x0, *h0, *x1, *h1, *iord, value, errflg);
}
void impact_(const double* x, const double* dxdt, const double* x1, const double* k, const double* e,
             const double* cmax, const double* d, const int* iord, double* vec, int* errflg) {
  c_impact(*x, *dxdt, *x1, *k, *e, *cmax, *d, *iord, vec, errflg);
}
void bistop_(const double* x, const double* dxdt, const double* x1, const double* x2, const double* k, const double* e,
             const double* cmax, const double* d, const int* iord, double* vec, int* errflg) {
  c_bistop(*x, *dxdt, *x1, *x2, *k, *e, *cmax, *d, *iord, vec, errflg);
}
void shf_(const double* x, const double* x0, const double* a, const double* w, const double* phi, const double* b,
          const int* iord, double* value, int* errflg) {
  c_shf(*x, *x0, *a, *w, *phi, *b, *iord, value, errflg);
}
void poly_(const double* x, const double* x0, const double* par, const int* npar, const int* iord, double* value,
           int* errflg) {
  c_poly(*x, *x0, par, *npar, *iord, value, errflg);
}
void cheby_(const double* x, const double* x0, const double* par, const int* npar, const int* iord, double* value,
            int* errflg) {
  c_cheby(*x, *x0, par, *npar, *iord, value, errflg);
}
void forcos_(const double* x, const double* x0, const double* w, const double* par, const int* npar, const int* iord,
             double* value, int* errflg) {
  c_forcos(*x, *x0, *w, par, *npar, *iord, value, errflg);
}
void forsin_(const double* x, const double* x0, const double* w, const double* par, const int* npar, const int* iord,
             double* value, int* errflg) {
  c_forsin(*x, *x0, *w, par, *npar, *iord, value, errflg);
}

}  // extern "C"
