// Routines of a GSE by the header that differentiates them.
#include <dynalin/user_routine.hpp>

// x1′ = x2, x2′ = −sin x1 − par[0] (x1² − 1) x2 + u, y = x1 x2 + exp(−u²)
struct Oscillator {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* rate) const {
    const T x1 = call.state(0), x2 = call.state(1);
    rate[0] = x2;
    rate[1] = -sin(x1) - call.parameter(0) * (x1 * x1 - 1.0) * x2 + call.input(0);
  }
};
DYNALIN_USER_STATE_EQUATIONS(oscillator_deriv, Oscillator)

struct Product {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* y) const {
    const T u = call.input(0);
    y[0] = call.state(0) * call.state(1) + exp(-(u * u));
  }
};
DYNALIN_USER_STATE_EQUATIONS(product_output, Product)

// (1 + x1²) x1′ − x2 and x2′ + x1′ x2 + sin x1 − u, which are zero.
struct Balance {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* zero) const {
    const T x1 = call.state(0), x2 = call.state(1);
    zero[0] = (1.0 + x1 * x1) * call.rate(0) - x2;
    zero[1] = call.rate(1) + call.rate(0) * x2 + sin(x1) - call.input(0);
  }
};
DYNALIN_USER_STATE_EQUATIONS(balance_deriv, Balance)

// What a sampled controller holds, and how it goes on: d1 is the input before, d2 a sum.
struct Held {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* y) const {
    y[0] = call.parameter(0) * call.discrete(0) + call.parameter(1) * call.discrete(1);
  }
};
DYNALIN_USER_STATE_EQUATIONS(held_output, Held)

struct Held_update {
  template <class T>
  void operator()(const dynalin::user::Call<T>& call, T* next) const {
    next[0] = call.input(0);
    next[1] = call.discrete(1) + call.parameter(2) * call.input(0);
  }
};
DYNALIN_USER_STATE_EQUATIONS(held_update, Held_update)
