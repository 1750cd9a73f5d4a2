// What is in loads.c, by the header that differentiates it.
#include <dynalin/user_routine.hpp>

struct Several {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* force) const {
    const char* const shifts[6] = {"DX", "DY", "DZ", "AX", "AY", "AZ"};
    const char* const speeds[6] = {"VX", "VY", "VZ", "WX", "WY", "WZ"};
    const double k[6] = {30, 50, 20, 4, 6, 3}, c[6] = {1, 0.5, 2, 0.2, 0.1, 0.3}, s[2] = {0.3, 0.1};
    const int i[2] = {static_cast<int>(call.parameter(0)), static_cast<int>(call.parameter(1))};
    const int j = static_cast<int>(call.parameter(2));
    const auto y = [&](int a, int r) {
      return r < 3 ? call.measure(shifts[r], {i[a], j, j}) : call.measure(shifts[r], {i[a], j});
    };
    for (int a = 0; a < 2; ++a) {
      for (int r = 0; r < 6; ++r) {
        const T v = r < 3 ? call.measure(speeds[r], {i[a], j, j, j}) : call.measure(speeds[r], {i[a], j, j});
        force[6 * a + r] = -k[r] * (y(a, r) + s[a] * y(1 - a, r)) - c[r] * v;
      }
    }
  }
};
DYNALIN_USER_ROUTINE(several_by_formula, Several)

template <class T>
T scale_of(const dynalin::user::Call<T>& call) {
  const int body = static_cast<int>(call.parameter(0));
  return 2.0 - 40.0 * call.measure("Q", {body}, 0) - 3.0 * call.measure("QDOT", {body}, 0);
}
struct ModalLoad {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* load) const {
    const double first[7] = {0.3, -0.2, 0.5, 0.1, -0.4, 0.2, 1}, second[7] = {-0.5, 0.6, 0.1, 0.3, 0.2, 0.7, 0.4};
    const T scale = scale_of(call);
    for (int k = 0; k < 6 + call.modes(); ++k) load[k] = scale * first[k] + 0.5 * second[k];
  }
};
DYNALIN_USER_MODAL_FORCE(load_by_formula, ModalLoad)

struct Scale {
  static int load_case(const dynalin::user::Call<double>& call) { return static_cast<int>(call.parameter(1)); }
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* scale) const {
    scale[0] = scale_of(call);
  }
};
DYNALIN_USER_MODAL_SCALE(scale_by_formula, Scale)

struct Cubic {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* c) const {
    const T u = call.parameter(12) + call.parameter(13) * call.alpha();
    for (int k = 0; k < 3; ++k) {
      c[k] = call.parameter(4 * k) +
             u * (call.parameter(4 * k + 1) + u * (call.parameter(4 * k + 2) + u * call.parameter(4 * k + 3)));
    }
  }
};
DYNALIN_USER_CURVE(cubic_by_formula, Cubic)

struct Circle {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* c) const {
    const T angle = 2 * 3.14159265358979323846 / call.parameter(1) * call.alpha();
    c[0] = call.parameter(0) * cos(angle), c[1] = call.parameter(0) * sin(angle), c[2] = T(0.0);
  }
};
DYNALIN_USER_CURVE(circle_by_formula, Circle)

struct ScaleAlone {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* value) const {
    value[0] = scale_of(call);
  }
};
DYNALIN_USER_ROUTINE(scale_alone, ScaleAlone)
