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

// Drag by the square of the speed. Nothing but the header is included here: abs is that of numbers.
struct Drag {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const T v = call.measure("VX", {20, 1, 1, 1});
    value[0] = -call.parameter(0) * abs(v) * v;
  }
};
DYNALIN_USER_ROUTINE(drag_by_formula, Drag)

// What law_along of laws.c is with 0, of DX.
struct Detent {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    using dynalin::user::value_of;
    const T x = call.measure("DX", {20, 1, 1}), s = x / call.parameter(0);
    value[0] = value_of(abs(s)) < 1 ? -1e5 * x * (1.0 - s * s) * (1.0 - s * s) : T(0.0);
  }
};
DYNALIN_USER_ROUTINE(detent_by_formula, Detent)

// (1 + w²) x' + x³ + x - 0.8 with w = VARVAL(1).
struct Implicit {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const T x = call.measure("DIF", {1}), rate = call.measure("DIF1", {1}), w = call.measure("VARVAL", {1});
    value[0] = (1.0 + w * w) * rate + x * x * x + x - 0.8;
  }
};
DYNALIN_USER_ROUTINE(implicit_by_formula, Implicit)

// Three columns of eight, and what a sensor watches.
struct Columns {
  void operator()(const dynalin::user::Call<double>& call, double* value) const {
    value[0] = call.time(), value[2] = call.measure("VX", {20, 1, 1, 1}), value[5] = call.parameter(0);
  }
};
DYNALIN_USER_REQUEST(columns_by_formula, Columns)
struct Watched {
  void operator()(const dynalin::user::Call<double>& call, double* value) const {
    value[0] = call.time() * call.parameter(0);
  }
};
DYNALIN_USER_SENSOR(watched_by_formula, Watched)

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

// What of_a_spline of routines.c is.
struct OfASpline {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const auto id = [&](int k) {  // 0 where it is not stated
      const double stated = call.parameter(k);
      return stated == stated ? static_cast<int>(stated) : 0;
    };
    const int of = id(0), i = id(2), j = id(3);
    const T x = call.measure("DX", {i, j, j}), z = call.parameter(4) * call.measure("DY", {i, j, j});
    value[0] = -(call.parameter(1) == 0 ? dynalin::user::akispl(x, z, of) : dynalin::user::cubspl(x, z, of));
  }
};
DYNALIN_USER_ROUTINE(spline_by_formula, OfASpline)

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

// What cnfsub and cffsub of contact.c are, in the region between speed 0 and the second one.
struct Pressure {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const T g = -1.0 * call.gap(), s = g / call.parameter(3);
    const T share = s < 1.0 ? s * s * (3.0 - 2.0 * s) : T(1.0);
    value[0] = call.parameter(0) * pow(g, call.parameter(1)) - call.parameter(2) * share * call.gap_rate();
    if (value[0] < 0.0) value[0] = T(0.0);
    value[1] = value[2] = T(0.0);
  }
};
DYNALIN_USER_CONTACT(pressure_by_formula, Pressure)

struct Slip {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const double still = call.parameter(2), sliding = call.parameter(3);
    const T v = call.slip(0), u = v / still, s = (v - still) / (sliding - still);
    const T rising = call.parameter(0) * 0.5 * u * (3.0 - u * u);
    const T falling = call.parameter(0) + (call.parameter(1) - call.parameter(0)) * s * s * (3.0 - 2.0 * s);
    const T mu = v < still ? rising : v < sliding ? falling : T(call.parameter(1));
    value[0] = -1.0 * mu * call.normal_force();
    value[1] = T(0.0);
    value[2] = -call.parameter(4) * call.slip(2);
  }
};
DYNALIN_USER_CONTACT_FRICTION(friction_by_formula, Slip)

// What `places` of contact.c is.
struct Places {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    const T i = call.location_I(0), j = call.location_J(0);
    value[0] = -call.parameter(0) * call.gap() / (1.0 + i * i + j * j) + 3.0 * call.normal_I(0) +
               2.0 * call.normal_J(2) + call.location_I(2) + call.location_J(1);
    value[1] = value[2] = T(0.0);
  }
};
DYNALIN_USER_CONTACT(places_by_formula, Places)

// What cousub of coupler.c is of two displacements, and with par[2] an oscillation in time.
struct Coupled {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    value[0] = call.given(0) - call.parameter(0) * sin(call.given(1)) - call.parameter(1) * call.given(1);
    if (call.parameters() > 2) value[0] += call.parameter(2) * sin(call.time());
  }
};
DYNALIN_USER_COUPLER(coupled_by_formula, Coupled)
