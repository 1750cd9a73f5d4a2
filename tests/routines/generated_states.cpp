// Routines of the GSEs that tests/oracle draws. Constants: the numbers of states, of inputs and of outputs, then A, B,
// C and D row by row, a number for each state, e, and one for each output, g:
//
//     x' = A x + B u + e sin(x) u1     y = C x + D u + g tanh(x1)
//
// and as what is zero (2 + sin x) x' - (A x + B u + e sin(x) u1).
#include <dynalin/user_routine.hpp>

namespace {

struct Places {
  int n, m, p;
  template <class Call>
  explicit Places(const Call& call)
      : n(static_cast<int>(call.parameter(0))),
        m(static_cast<int>(call.parameter(1))),
        p(static_cast<int>(call.parameter(2))) {}
  int A() const { return 3; }
  int B() const { return A() + n * n; }
  int C() const { return B() + n * m; }
  int D() const { return C() + p * n; }
  int e() const { return D() + p * m; }
  int g() const { return e() + n; }
};

// A row of A and B, or of C and D.
template <class T>
T row(const dynalin::user::Call<T>& call, const Places& at, int states, int inputs, int k) {
  T sum = 0.0;
  for (int c = 0; c < at.n; ++c) sum = sum + call.parameter(states + k * at.n + c) * call.state(c);
  for (int c = 0; c < at.m; ++c) sum = sum + call.parameter(inputs + k * at.m + c) * call.input(c);
  return sum;
}

struct Rate {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* rate) const {
    const Places at(call);
    for (int k = 0; k < at.n; ++k)
      rate[k] = row(call, at, at.A(), at.B(), k) + call.parameter(at.e() + k) * (sin(call.state(k)) * call.input(0));
  }
};

struct Balance {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* zero) const {
    Rate{}(call, zero);
    for (int k = 0; k < Places(call).n; ++k) zero[k] = (2.0 + sin(call.state(k))) * call.rate(k) - zero[k];
  }
};

struct Output {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* y) const {
    const Places at(call);
    for (int k = 0; k < at.p; ++k)
      y[k] = row(call, at, at.C(), at.D(), k) + call.parameter(at.g() + k) * tanh(call.state(0));
  }
};

}  // namespace

DYNALIN_USER_STATE_EQUATIONS(gse_deriv, Rate)
DYNALIN_USER_STATE_EQUATIONS(balance_deriv, Balance)
DYNALIN_USER_STATE_EQUATIONS(gse_output, Output)
