// Routines by the header that differentiates them.
#include <dynalin/user_routine.hpp>

// -(k x + h x^3 + c v), x and v of marker par[0] from par[1].
struct Spring {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const int i = static_cast<int>(call.parameter(0)), j = static_cast<int>(call.parameter(1));
    const T x = call.measure("DX", {i, j, j}), v = call.measure("VX", {i, j, j, j});
    value[0] = -(call.parameter(2) * x + call.parameter(3) * pow(x, 3) + call.parameter(4) * v);
  }
};
DYNALIN_USER_ROUTINE(spring_by_formula, Spring)

// All six components in one, as smooth functions of a whole list of measures.
struct Wrench {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const int i = static_cast<int>(call.parameter(0)), j = static_cast<int>(call.parameter(1));
    for (int k = 0; k < 3; ++k) {
      const T d = call.measure("TDISP", {i, j, j}, k), w = call.measure("RVEL", {i, j, j}, k);
      value[k] = -100.0 * (1.0 + k) * sin(d) - 5.0 * call.measure("TVEL", {i, j, j, j}, k) / sqrt(1.0 + d * d);
      value[3 + k] = -tanh(w) - 3.0 * atan(call.measure("UVX", {i, j}, k)) * exp(-0.5 * d);
    }
  }
};
DYNALIN_USER_ROUTINE(wrench_by_formula, Wrench)

// What fiesub of routines.c is.
struct Field {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const double ratio = call.parameter(0);
    const auto against = [&](int k) { return -(call.displacement(k) + ratio * call.velocity(k)); };
    const T x = call.displacement(0);
    value[0] = 100.0 * against(0) - call.parameter(1) * pow(x, 3);
    value[1] = 12.0 * against(1) - 6.0 * against(5);
    value[2] = 36.0 * against(2);
    value[3] = 25.0 * against(3);
    value[4] = 9.0 * against(4);
    value[5] = 3.0 * against(0) - 6.0 * against(1) + 4.0 * against(5);
  }
};
DYNALIN_USER_FIELD(field_by_formula, Field)

struct Course {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    value[0] = call.parameter(0) * sin(call.parameter(1) * call.time());
  }
};
DYNALIN_USER_ROUTINE(course_by_formula, Course)
