/* Couplers as routines: q0 - par[0] sin(q1) - par[1] q1, with q2 par[2] q2^2 more; and what goes wrong. */
#include <dynalin/user_routine.h>
#include <math.h>

static double held(const double* par, const double* q, int n) {
  return q[0] - par[0] * sin(q[1]) - par[1] * q[1] - (n > 2 ? par[2] * q[2] * q[2] : 0);
}
static void first(const double* par, const double* q, int n, double* by) {
  by[0] = 1, by[1] = -par[0] * cos(q[1]) - par[1];
  if (n > 2) by[2] = -2 * par[2] * q[2];
}
static void second(const double* par, const double* q, int n, double* by) {
  for (int k = 0; k < n * n; ++k) by[k] = 0;
  by[n + 1] = par[0] * sin(q[1]);
  if (n > 2) by[8] = -2 * par[2];
}

void cousub(const int* id, const double* time, const double* par, const int* npar, const double* disp, const int* ndisp,
            const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)iflag;
  *value = held(par, disp, *ndisp);
}
void couxx(const int* id, const double* time, const double* par, const int* npar, const double* disp, const int* ndisp,
           const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)iflag;
  first(par, disp, *ndisp, value);
}
void couxx2(const int* id, const double* time, const double* par, const int* npar, const double* disp, const int* ndisp,
            const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)iflag;
  second(par, disp, *ndisp, value);
}

static int is_right(const struct sAdamsCoupler* c) {
  return c->NJOINT == 2 && c->JOINTS[0] == 1 && c->JOINTS[1] == 2 && c->TYPE[0] == 'R' && c->TYPE[1] == 'T';
}
void Heldc(const struct sAdamsCoupler* c, double time, const double* disp, int iflag, double* value) {
  (void)time, (void)iflag;
  *value = is_right(c) ? held(c->PAR, disp, c->NJOINT) : disp[0];
}
void Firstc(const struct sAdamsCoupler* c, double time, const double* disp, int iflag, double* value) {
  (void)time, (void)iflag;
  first(c->PAR, disp, c->NJOINT, value);
}
void Secondc(const struct sAdamsCoupler* c, double time, const double* disp, int iflag, double* value) {
  (void)time, (void)iflag;
  second(c->PAR, disp, c->NJOINT, value);
}

void swings(const int* id, const double* time, const double* par, const int* npar, const double* disp, const int* ndisp,
            const int* iflag, double* value) {
  (void)id, (void)npar, (void)iflag;
  *value = held(par, disp, *ndisp) + 0.01 * sin(*time);
}
/* Derivatives that are none of cousub: the second of the first ones is too large by a fifth, or the whole matrix negative. */
void wrong_first(const int* id, const double* time, const double* par, const int* npar, const double* disp,
                 const int* ndisp, const int* iflag, double* value) {
  couxx(id, time, par, npar, disp, ndisp, iflag, value);
  value[1] *= 1.2;
}
void wrong_second(const int* id, const double* time, const double* par, const int* npar, const double* disp,
                  const int* ndisp, const int* iflag, double* value) {
  int k;
  couxx2(id, time, par, npar, disp, ndisp, iflag, value);
  for (k = 0; k < *ndisp * *ndisp; ++k) value[k] *= -1;
}
