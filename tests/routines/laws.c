/* Laws of one dimension that have another slope close to a point than further off, or none that a step could have. */
#include <dynalin/user_routine.h>
#include <math.h>

static double law(int which, double u, double a) {
  const double s = u / a;
  switch (which) {
    case 0: return fabs(s) < 1 ? -1e5 * u * (1 - s * s) * (1 - s * s) : 0; /* a detent */
    case 1: return -10 * u - 2 * s * exp(-s * s); /* Stribeck */
    case 2: return -100 * u - 0.05 * sin(2 * acos(-1.0) * u / a); /* cogging */
    case 3: return -a * u * fabs(u); /* drag */
    case 4: return -a * copysign(pow(fabs(u), 1.5), u);
    case 5: return u < 0 ? 0 : -a * u * u;
    case 6: return u < 0 ? 0 : -a * pow(u, 1.5); /* Hertz */
    default: return -a * (u > 0 ? 1 : -1); /* a jump */
  }
}
/* The law par[0] with par[1], of DX or, where par[2] is 1, VX of marker 20, and -par[3] DX. */
void law_along(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
               const int* iflag, double* value) {
  const int at[4] = {20, 1, 1, 1};
  double x, v;
  int error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX", at, 3, &x, &error);
  c_sysfnc("VX", at, 4, &v, &error);
  *value = law((int)par[0], par[2] == 1 ? v : x, par[1]) - par[3] * x;
}
void law_of_slip(const int* id, const double* time, const double* par, const int* npar, const double* loci,
                 const double* locj, const double* x, const double* xdot, const double* nforce, const double* area,
                 const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)locj, (void)x, (void)area, (void)dflag, (void)iflag;
  value[0] = *nforce * law((int)par[0], xdot[0], par[1]);
  value[1] = 0, value[2] = -0.01 * *nforce * xdot[2];
}
/* x' = VARVAL(1) - x |x| */
void law_of_state(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                  const int* iflag, double* value) {
  const int variable = 1;
  double u, x;
  int error;
  (void)time, (void)npar, (void)dflag, (void)iflag, (void)par;
  c_sysfnc("VARVAL", &variable, 1, &u, &error);
  c_sysfnc("DIF", id, 1, &x, &error);
  *value = u - x * fabs(x);
}
