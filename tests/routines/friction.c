/* A friction with bristles: the deflection z of an axis follows z' = v - s0 |v| / g(v) z, and the force is
 * -(s0 z + s1 z' + s2 v), with g(v) = Fc + (Fs - Fc) exp(-(v/vs)^2). par: axis, marker, other marker, id of the DIFF,
 * s0, s1, s2, Fc, Fs, vs. */
#include <dynalin/user_routine.h>
#include <math.h>

static const char* const velocities[3] = {"VX", "VY", "VZ"};

struct rate {
  double v, z, rate, by_v, by_z;
};
static struct rate rate_of(const double* par) {
  const int at[3] = {(int)par[1], (int)par[2], (int)par[2]}, diff = (int)par[3];
  struct rate r;
  int error;
  c_sysfnc(velocities[(int)par[0] - 1], at, 3, &r.v, &error);
  c_sysfnc("DIF", &diff, 1, &r.z, &error);
  const double drop = (par[8] - par[7]) * exp(-(r.v / par[9]) * (r.v / par[9])), g = par[7] + drop;
  const double g_by_v = -2 * r.v / (par[9] * par[9]) * drop, sign = r.v < 0 ? -1 : 1;
  r.rate = r.v - par[4] * fabs(r.v) / g * r.z;
  r.by_v = 1 - par[4] * r.z * (sign / g - fabs(r.v) * g_by_v / (g * g));
  r.by_z = -par[4] * fabs(r.v) / g;
  return r;
}
static void give(const double* par, double by_v, double by_z) {
  const int at[3] = {(int)par[1], (int)par[2], (int)par[2]}, diff = (int)par[3];
  int error;
  c_syspar(velocities[(int)par[0] - 1], at, 3, &by_v, 1, &error);
  c_syspar("DIF", &diff, 1, &by_z, 1, &error);
}

void difsub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const struct rate r = rate_of(par);
  (void)id, (void)time, (void)npar, (void)iflag;
  *value = r.rate;
  if (*dflag) give(par, r.by_v, r.by_z);
}
void sfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const struct rate r = rate_of(par);
  (void)id, (void)time, (void)npar, (void)iflag;
  *value = -(par[4] * r.z + par[5] * r.rate + par[6] * r.v);
  if (*dflag) give(par, -(par[5] * r.by_v + par[6]), -(par[4] + par[5] * r.by_z));
}
