// Compiled user routines written once, with all derivatives that the program needs: a formula over any scalar.
//
//     #include <dynalin/user_routine.hpp>
//
//     struct Friction {
//       template <class T>
//       void operator()(const dynalin::user::Call<T>& call, T* value) const {
//         const T v = call.measure("VX", {10, 20, 20});
//         value[0] = -call.parameter(0) * tanh(v / call.parameter(1));
//       }
//     };
//     DYNALIN_USER_ROUTINE(sfosub, Friction)
//
// The formula is called with T = double for values, and with scalars that carry derivatives beside them. It takes
// functions without a namespace in front of them (sin, not std::sin), and compares scalars by their values: abs fabs
// sqrt cbrt pow hypot, sin cos tan asin acos atan atan2, sinh cosh tanh asinh acosh atanh, exp exp2 expm1 log log2
// log10 log1p, erf, floor ceil trunc fmod copysign. With `using namespace dynalin::user;` in it also value_of min max,
// and of the language sign step step5 havsin impact bistop, whose arguments behind the first (of impact and bistop the
// second) are plain numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <vector>

#include "dynalin/user_functions.hpp"
#include "dynalin/user_routine.h"
#include "dynalin/user_scalars.hpp"

namespace dynalin::user {

// What formulas of a GSE read: its states, inputs and discrete states by their places, counted from 0, and x′ of an
// implicit one.
template <class Self, class T>
struct CallOfStateEquations {
  T state(int k) const { return self().measure("ARRAY", {dynalin_gse_array('X')}, k); }
  T rate(int k) const { return self().measure("GSE_XDOT", {self().id()}, k); }
  T input(int k) const { return self().measure("ARRAY", {dynalin_gse_array('U')}, k); }
  T discrete(int k) const { return self().measure("ARRAY", {dynalin_gse_array('D')}, k); }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

// What formulas of a CONTACT get: number k of places, normals and slip, counted from 0. Those of its friction have no
// normals, and other places.
template <class Self, class T>
struct CallOfContact {
  T location_I(int k) const { return self().given(k); }
  T normal_I(int k) const { return self().given(3 + k); }
  T location_J(int k) const { return self().given(6 + k); }
  T normal_J(int k) const { return self().given(9 + k); }
  T gap() const { return self().given(12); }
  T gap_rate() const { return self().given(13); }
  T location_J_of_friction(int k) const { return self().given(3 + k); }
  T slip(int k) const { return self().given(6 + k); }
  T normal_force() const { return self().given(9); }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

// What a formula reads. All it asks for must be the same each time, whatever the values are.
template <class T>
class Call : public CallOfStateEquations<Call<T>, T>, public CallOfContact<Call<T>, T> {
 public:
  Call(const dynalin_course& course, int first) : course_(&course), first_(first) {}
  int id() const { return course_->id; }
  // Not a number where there is none.
  double parameter(int k) const { return k >= 0 && k < course_->npar ? course_->par[k] : std::nan(""); }
  int parameters() const { return course_->npar; }
  T time() const { return number(0); }
  // Of a FIELD: number k of disp and of velo, counted from 0.
  T displacement(int k) const { return number(2 + k); }
  T velocity(int k) const { return number(8 + k); }
  // What comes as an argument: of a COUPLER displacement k of its joints, of a CONTACT see above.
  T given(int k) const { return number(2 + k); }
  // Of a CURVE.
  T alpha() const { return given(0); }
  // Of an MFORCE with FORCE: how many modal coordinates its body has.
  int modes() const { return course_->values - 6; }
  // As c_sysfnc gives it.
  T measure(const char* name, std::initializer_list<int> ids) const {
    return number(dynalin_input(name, ids.begin(), static_cast<int>(ids.size())));
  }
  // Number n of what c_sysary gives.
  T measure(const char* name, std::initializer_list<int> ids, int n) const {
    return number(dynalin_input_of_array(name, ids.begin(), static_cast<int>(ids.size()), n));
  }

 private:
  T number(int k) const {
    if (k < 0) return T(std::nan(""));
    const int stride = course_->order + 1;
    T x(course_->input[stride * k]);
    const int seed = k - first_;
    const bool seeded = seed >= 0 && seed < pass;
    if constexpr (std::same_as<T, Course>) {
      x.x1 = course_->input[stride * k + 1], x.x2 = course_->input[stride * k + 2];
      if (seeded) x.x.d[static_cast<std::size_t>(seed)] = 1.0;
    } else if (seeded) {
      x.d[static_cast<std::size_t>(seed)] = 1.0;
    }
    return x;
  }
  const dynalin_course* course_;
  int first_;
};

template <>
class Call<double> : public CallOfStateEquations<Call<double>, double>, public CallOfContact<Call<double>, double> {
 public:
  Call(int id, double time, const double* par, int npar, const double* disp = nullptr, const double* velo = nullptr)
      : id_(id), time_(time), par_(par), npar_(npar), disp_(disp), velo_(velo) {}
  Call(int id, double time, const double* par, int npar, std::initializer_list<double> given)
      : id_(id), time_(time), par_(par), npar_(npar), disp_(nullptr), velo_(nullptr) {
    std::copy(given.begin(), given.end(), given_.begin());
  }
  double given(int k) const { return given_[static_cast<std::size_t>(k)]; }
  double alpha() const { return given(0); }
  int modes() const { return modes_; }
  Call& with_modes(int modes) {
    modes_ = modes;
    return *this;
  }
  int id() const { return id_; }
  double parameter(int k) const { return k >= 0 && k < npar_ ? par_[k] : std::nan(""); }
  int parameters() const { return npar_; }
  double time() const { return time_; }
  double displacement(int k) const { return disp_[k]; }
  double velocity(int k) const { return velo_[k]; }
  double measure(const char* name, std::initializer_list<int> ids) const {
    double state = 0;
    int error = 0;
    c_sysfnc(name, ids.begin(), static_cast<int>(ids.size()), &state, &error);
    return state;
  }
  double measure(const char* name, std::initializer_list<int> ids, int n) const {
    int error = 0, count = 0;
    c_sysary(name, ids.begin(), static_cast<int>(ids.size()), nullptr, &count, &error);
    std::vector<double> states(static_cast<std::size_t>(std::max(count, 1)));
    c_sysary(name, ids.begin(), static_cast<int>(ids.size()), states.data(), &count, &error);
    return n < count ? states[static_cast<std::size_t>(n)] : std::nan("");
  }

 private:
  int id_;
  double time_;
  const double* par_;
  int npar_;
  const double *disp_, *velo_;
  std::array<double, 14> given_{};
  int modes_ = 0;
};

// Fills in the values and derivatives of a course, a pass of inputs at a time.
template <class Formula>
void fill_course(const dynalin_course& c) {
  const int stride = c.order + 1;
  for (int first = 0; first < c.inputs; first += pass) {
    const auto take = [&]<class T>(T) {
      std::vector<T> value(static_cast<std::size_t>(c.values));
      Formula{}(Call<T>(c, first), value.data());
      for (int v = 0; v < c.values; ++v) {
        const auto put = [&](const Partials& p, int d) {
          c.value[stride * v + d] = p.x;
          for (int k = first; k < std::min(first + pass, c.inputs); ++k)
            c.partial[stride * (c.inputs * v + k) + d] = p.d[static_cast<std::size_t>(k - first)];
        };
        const T& of = value[static_cast<std::size_t>(v)];
        if constexpr (std::same_as<T, Course>) {
          put(of.x, 0), put(of.x1, 1), put(of.x2, 2);
        } else {
          put(of, 0);
        }
      }
    };
    if (c.order == 0) {
      take(Partials());
    } else {
      take(Course());
    }
  }
}

// A point of a curve, or one of its first two derivatives.
template <class Formula>
void fill_curve(int id, const double* par, int npar, double alpha, int order, double* values) {
  if (order == 0) return Formula{}(Call<double>(id, 0, par, npar, {alpha}), values);
  const std::array<double, 9> input = {0, 0, 0, 0, 0, 0, alpha, 1, 0};
  std::array<double, 9> value{};
  std::array<double, 27> partial{};
  fill_course<Formula>({id, npar, par, 3, 3, 2, input.data(), value.data(), partial.data()});
  for (std::size_t v = 0; v < 3; ++v) values[v] = value[3 * v + static_cast<std::size_t>(order)];
}

}  // namespace dynalin::user

// The routine `name` of a VARIABLE, SFORCE, GFORCE, VFORCE, VTORQUE, NFORCE, DIFF or MOTION, and its entry with
// derivatives.
#define DYNALIN_USER_ROUTINE(name, Formula)                                                                           \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, const int*, \
                       double* value) {                                                                               \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                            \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine reqsub of a REQUEST, with eight values, of which those that are not written are 0; of sensub or
// sevsub of a SENSOR, with one. Nobody asks for their derivatives.
#define DYNALIN_USER_REQUEST(name, Formula)                                                               \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, \
                       double* value) {                                                                   \
    std::fill_n(value, 8, 0.0);                                                                           \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                \
  }
#define DYNALIN_USER_SENSOR(name, Formula)                                                                \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, \
                       double* value) {                                                                   \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                \
  }

// The same of a routine gse_deriv, gse_output or gse_update of a GSE.
#define DYNALIN_USER_STATE_EQUATIONS(name, Formula)                                                                   \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, const int*, \
                       const int*, double* value) {                                                                   \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                            \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine fiesub of a FIELD: a formula of call.displacement and call.velocity, with six values.
#define DYNALIN_USER_FIELD(name, Formula)                                                                         \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* disp, \
                       const double* velo, const int*, const int*, double* field, double*, double*) {             \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar, disp, velo), field);                            \
  }                                                                                                               \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cnfsub of a CONTACT: a formula of call.gap and call.gap_rate, of places and normals, with three
// values.
#define DYNALIN_USER_CONTACT(name, Formula)                                                                           \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* loci,     \
                       const double* ni, const double* locj, const double* nj, const double* gap,                     \
                       const double* gapdot, const double*, const double*, const int*, const int*, double* value) {   \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar,                                                     \
                                          {loci[0], loci[1], loci[2], ni[0], ni[1], ni[2], locj[0], locj[1], locj[2], \
                                           nj[0], nj[1], nj[2], *gap, *gapdot}),                                      \
              value);                                                                                                 \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cffsub of a CONTACT: a formula of call.slip and call.normal_force, with three values.
#define DYNALIN_USER_CONTACT_FRICTION(name, Formula)                                                               \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* loci,  \
                       const double* locj, const double*, const double* xdot, const double* nforce, const double*, \
                       const int*, const int*, double* value) {                                                    \
    Formula{}(dynalin::user::Call<double>(                                                                         \
                  *id, *time, par, *npar,                                                                          \
                  {loci[0], loci[1], loci[2], locj[0], locj[1], locj[2], xdot[0], xdot[1], xdot[2], *nforce}),     \
              value);                                                                                              \
  }                                                                                                                \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cousub of a COUPLER: a formula of call.given(k), displacement k of its joints, with one value.
#define DYNALIN_USER_COUPLER(name, Formula)                                                                        \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* disp,  \
                       const int* ndisp, const int*, double* value) {                                              \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar, {disp[0], disp[1], *ndisp > 2 ? disp[2] : 0.0}), \
              value);                                                                                              \
  }                                                                                                                \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine mfosub of an MFORCE that FORCE calls: a formula with 6 + call.modes() values.
#define DYNALIN_USER_MODAL_FORCE(name, Formula)                                                                       \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, const int*, \
                       const double*, const int* nmodes, const int*, double*, int*, double* loadvec) {                \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar).with_modes(*nmodes), loadvec);                      \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same where FUNCTION calls it: a formula of the scale, with one value. Formula::load_case(call) says which of the
// modal loads of the body it scales.
#define DYNALIN_USER_MODAL_SCALE(name, Formula)                                                                       \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, const int*, \
                       const double*, const int*, const int*, double* scale, int* load_case, double*) {               \
    const dynalin::user::Call<double> call(*id, *time, par, *npar);                                                   \
    *load_case = Formula::load_case(call);                                                                            \
    Formula{}(call, scale);                                                                                           \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cursub of a CURVE: a formula of call.alpha(), with three values.
#define DYNALIN_USER_CURVE(name, Formula)                                                                       \
  extern "C" void name(const int* id, const double* par, const int* npar, const double* alpha, const int* iord, \
                       const int*, double* values) {                                                            \
    dynalin::user::fill_curve<Formula>(*id, par, *npar, *alpha, *iord, values);                                 \
  }                                                                                                             \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }
