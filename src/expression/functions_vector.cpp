// MAG and UV of a vector that is taken apart into its components.
#include <algorithm>
#include <cmath>

#include "expression/functions_define.h"

namespace dynalin {

namespace {

// MAG([x, y, z]) = SQRT(x² + y² + z²), at 0 with derivative 0. Of a vector that leaves 0 no rate is known.
double size_of_nothing(double, double, double) { return 0.0; }
template <std::size_t N>
Dual<N> size_of_nothing(const Dual<N>&, const Dual<N>&, const Dual<N>&) {
  return Dual<N>(0.0);
}
template <class T>
TimeTaylor<T> size_of_nothing(const TimeTaylor<T>& x, const TimeTaylor<T>& y, const TimeTaylor<T>& z) {
  const auto stays = [](const T& a, const T& b, const T& c) {
    return value_of(a) == 0.0 && value_of(b) == 0.0 && value_of(c) == 0.0;
  };
  TimeTaylor<T> size{T(0.0), undefined<T>(), undefined<T>()};
  if (!stays(x.rate, y.rate, z.rate)) return size;
  size.rate = T(0.0);
  if (stays(x.acceleration, y.acceleration, z.acceleration)) size.acceleration = T(0.0);
  return size;
}

constexpr auto size_of = []<class T>(const T& x, const T& y, const T& z) {
  using std::sqrt;
  if (value_of(x) == 0.0 && value_of(y) == 0.0 && value_of(z) == 0.0) return size_of_nothing(x, y, z);
  return T(sqrt(T(x * x + y * y + z * z)));
};

// The component x of UV([x, y, z]).
constexpr auto component_of_direction = []<class T>(const T& x, const T& y, const T& z) {
  using std::sqrt;
  const T square = x * x + y * y + z * z;
  if (value_of(square) == 0.0) return undefined<T>();
  return T(x / T(sqrt(square)));
};
std::string direction_domain(std::span<const double> a) {
  return std::all_of(a.begin(), a.end(), [](double x) { return x == 0.0; }) ? "UV of a vector that is zero" : "";
}

constexpr Function of_vector(Function f) {
  f.of_vector = true;
  return f;
}
constexpr Function growing_every_way(Function f) {
  f.is_size = true;
  f.flat_at_kinks = true;
  f.growth_at_infinity = 1;
  return f;
}

constexpr Function size_function = growing_every_way(of_vector(function<3>("MAG", {}, size_of)));
constexpr Function direction_function = of_vector(function<3>("UV", {}, component_of_direction, direction_domain));

}  // namespace

const Function& vector_size() { return size_function; }
const Function& vector_direction() { return direction_function; }

}  // namespace dynalin
