/* Routines as users write them, with addresses for arguments and with a statement first. */
#define _GNU_SOURCE
#include <dynalin/user_routine.h>
#include <fenv.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* -(k x + h x^3 + c v), x and v of marker par[0] from par[1]; with derivatives where `exact`. */
static void spring(const double* par, double* value, int exact) {
  const int i = (int)par[0], j = (int)par[1];
  const int at[3] = {i, j, j}, moving[4] = {i, j, j, j};
  double x, v;
  int error, wanted;
  c_sysfnc("DX", at, 3, &x, &error);
  c_errmes(error, "DX is not there", 0, "STOP");
  c_sysfnc("vx", moving, 4, &v, &error);
  *value = -(par[2] * x + par[3] * x * x * x + par[4] * v);
  c_adams_needs_partials(&wanted);
  if (!wanted || !exact) return;
  const double by_x = -(par[2] + 3 * par[3] * x * x), by_v = -par[4];
  c_syspar("DX", at, 3, &by_x, 1, &error);
  c_syspar("VX", moving, 4, &by_v, 1, &error);
}

void sfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  spring(par, value, 1);
}
void spring_without_derivatives(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                                const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  spring(par, value, 0);
}
/* Leaves numbers of the processor rounded upwards, and divisions by zero as signals. */
void spring_that_rounds_upwards(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                                const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  spring(par, value, 1);
  fesetround(FE_UPWARD);
  feenableexcept(FE_DIVBYZERO | FE_INVALID);
}
/* A statement first: the markers are those of the SFORCE. */
void Springc(const struct sAdamsSforce* s, double time, int dflag, int iflag, double* value) {
  const double par[5] = {s->I, s->J, s->PAR[0], s->PAR[1], s->PAR[2]};
  (void)time, (void)dflag, (void)iflag;
  spring(par, value, s->NPAR == 3 && s->ID == 1 && s->ACTION_ONLY == 1 && strcmp(s->Type, "TRANSLATION") == 0);
}

/* -k x with k the sum of entries of the ARRAYs par[2] and par[3], whose derivatives nobody gives. */
void spring_by_arrays(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                      const int* iflag, double* value) {
  const int at[2] = {(int)par[0], (int)par[1]}, arrays[2] = {(int)par[2], (int)par[3]};
  double x, entries[2] = {0, 0}, k = 0;
  int error, count, wanted;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  for (int a = 0; a < 2; ++a) {
    c_sysary("ARRAY", &arrays[a], 1, entries, &count, &error);
    k += entries[0] + entries[1];
  }
  c_sysfnc("DX", at, 2, &x, &error);
  *value = -k * x;
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  const double by_x = -k;
  c_syspar("DX", at, 2, &by_x, 1, &error);
}

/* 1 where the statement says what it is, a translation or with par[0] a rotation. */
void Typec(const struct sAdamsSforce* s, double time, int dflag, int iflag, double* value) {
  (void)time, (void)dflag, (void)iflag;
  *value = strcmp(s->Type, s->PAR[0] > 0 ? "ROTATION" : "TRANSLATION") == 0;
}

/* par[0] VARVAL(par[1])^2 + par[2] TIME */
void varsub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const int of = (int)par[1];
  double other;
  int error, wanted;
  (void)id, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("VARVAL", &of, 1, &other, &error);
  *value = par[0] * other * other + par[2] * *time;
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  const double by_other = 2 * par[0] * other, by_time = par[2];
  c_syspar("VARVAL", &of, 1, &by_other, 1, &error);
  c_syspar("TIME", NULL, 0, &by_time, 1, &error);
}

/* A linear spring in all six directions by lists: -par[2] times DISP of (par[0], par[1], par[1]). */
void gfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const int at[3] = {(int)par[0], (int)par[1], (int)par[1]};
  double x[3], w[3], by_x[18] = {0}, by_w[18] = {0};
  int n, error, wanted;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysary("TDISP", at, 3, x, &n, &error);
  c_sysary("RVEL", at, 3, w, &n, &error);
  for (int k = 0; k < 3; ++k) {
    value[k] = -par[2] * x[k], value[3 + k] = -par[3] * w[k];
    by_x[6 * k + k] = -par[2], by_w[6 * k + 3 + k] = -par[3];
  }
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  c_syspar("TDISP", at, 3, by_x, 18, &error);
  c_syspar("RVEL", at, 3, by_w, 18, &error);
}
void vfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  double all[6];
  int error, wanted;
  const int at[3] = {(int)par[0], (int)par[1], (int)par[1]};
  double by_x[9] = {0}, x[3];
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag, (void)all;
  c_sysary("TDISP", at, 3, x, &error, &wanted);
  for (int k = 0; k < 3; ++k) value[k] = -par[2] * x[k], by_x[3 * k + k] = -par[2];
  c_syspar("TDISP", at, 3, by_x, 9, &error);
}
void vtosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const int at[3] = {(int)par[0], (int)par[1], (int)par[1]};
  double by_w[9] = {0}, w[3];
  int n, error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysary("RVEL", at, 3, w, &n, &error);
  for (int k = 0; k < 3; ++k) value[k] = -par[2] * w[k], by_w[3 * k + k] = -par[2];
  c_syspar("RVEL", at, 3, by_w, 9, &error);
}

/* A stiffness that is not symmetric, par[0] times it as damping, and par[1] disp[0]^3 against x. */
static const double field_stiffness[6][6] = {{100, 0, 0, 0, 0, 0}, {0, 12, 0, 0, 0, -6}, {0, 0, 36, 0, 0, 0},
                                             {0, 0, 0, 25, 0, 0},  {0, 0, 0, 0, 9, 0},   {3, -6, 0, 0, 0, 4}};
static void field(const double* par, const double* disp, const double* velo, double* value) {
  for (int i = 0; i < 6; ++i) {
    value[i] = 0;
    for (int j = 0; j < 6; ++j) value[i] -= field_stiffness[i][j] * (disp[j] + par[0] * velo[j]);
  }
  value[0] -= par[1] * disp[0] * disp[0] * disp[0];
}
void field_without_derivatives(const int* id, const double* time, const double* par, const int* npar,
                               const double* disp, const double* velo, const int* dflag, const int* iflag,
                               double* value, double* dfddis, double* dfdvel) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag, (void)dfddis, (void)dfdvel;
  field(par, disp, velo, value);
}
void fiesub(const int* id, const double* time, const double* par, const int* npar, const double* disp,
            const double* velo, const int* dflag, const int* iflag, double* value, double* dfddis, double* dfdvel) {
  (void)id, (void)time, (void)npar, (void)iflag;
  field(par, disp, velo, value);
  if (!*dflag) return;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      dfddis[i + 6 * j] = -field_stiffness[i][j];
      dfdvel[i + 6 * j] = -par[0] * field_stiffness[i][j];
    }
  }
  dfddis[0] -= 3 * par[1] * disp[0] * disp[0];
}
void Fieldc(const struct sAdamsField* f, double time, const double* disp, const double* velo, int dflag, int iflag,
            double* value, double* dfddis, double* dfdvel) {
  const int markers = f->ID == 1 && f->I == 20 && f->J == 2;
  fiesub(&f->ID, &time, f->PAR, &f->NPAR, disp, velo, &dflag, &iflag, value, dfddis, dfdvel);
  if (!markers) value[0] = sqrt(-1.0);
}
/* A column that is not written: nobody may take it for zeros. */
void field_with_gap(const int* id, const double* time, const double* par, const int* npar, const double* disp,
                    const double* velo, const int* dflag, const int* iflag, double* value, double* dfddis,
                    double* dfdvel) {
  double velocity[36];
  fiesub(id, time, par, npar, disp, velo, dflag, iflag, value, dfddis, velocity);
  if (*dflag) memcpy(dfdvel, velocity, 30 * sizeof(double));
}
void field_without_number(const int* id, const double* time, const double* par, const int* npar, const double* disp,
                          const double* velo, const int* dflag, const int* iflag, double* value, double* dfddis,
                          double* dfdvel) {
  fiesub(id, time, par, npar, disp, velo, dflag, iflag, value, dfddis, dfdvel);
  value[4] = sqrt(par[0]);
}
void field_that_asks(const int* id, const double* time, const double* par, const int* npar, const double* disp,
                     const double* velo, const int* dflag, const int* iflag, double* value, double* dfddis,
                     double* dfdvel) {
  const int at[2] = {20, 1};
  double x;
  int error;
  fiesub(id, time, par, npar, disp, velo, dflag, iflag, value, dfddis, dfdvel);
  c_sysfnc("DM", at, 2, &x, &error);
  value[0] += x;
}

/* x' = (VARVAL(par[0]) - x) / par[1] */
void difsub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const int of = (int)par[0];
  double u, x;
  int error;
  (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("VARVAL", &of, 1, &u, &error);
  c_sysfnc("DIF", id, 1, &x, &error);
  *value = (u - x) / par[1];
  const double by_u = 1 / par[1], by_x = -1 / par[1];
  c_syspar("VARVAL", &of, 1, &by_u, 1, &error);
  c_syspar("DIF", id, 1, &by_x, 1, &error);
}

/* par[0] sin(par[1] t) and its derivatives */
void motsub(const int* id, const double* time, const double* par, const int* npar, const int* iord, const int* iflag,
            double* value) {
  (void)id, (void)npar, (void)iflag;
  const double a = par[1] * *time;
  *value = *iord == 0 ? par[0] * sin(a) : *iord == 1 ? par[0] * par[1] * cos(a) : -par[0] * par[1] * par[1] * sin(a);
}

/* sin t that stands still by what it says of its rates, as routines do whose author did not look at the order */
void still_motsub(const int* id, const double* time, const double* par, const int* npar, const int* iord,
                  const int* iflag, double* value) {
  (void)id, (void)par, (void)npar, (void)iflag;
  *value = *iord == 0 ? sin(*time) : 0;
}
/* t, without a number for the order par[0] */
void lost_motsub(const int* id, const double* time, const double* par, const int* npar, const int* iord,
                 const int* iflag, double* value) {
  (void)id, (void)npar, (void)iflag;
  *value = *iord == 0 ? *time : *iord == 1 ? 1 : 0;
  if (*iord == (int)par[0]) *value = sqrt(-1 - *time);
}

void reqsub(const int* id, const double* time, const double* par, const int* npar, const int* iflag, double* value) {
  const int at[2] = {(int)par[0], (int)par[1]};
  double x;
  int error;
  (void)id, (void)time, (void)npar, (void)iflag;
  c_sysfnc("DX", at, 2, &x, &error);
  for (int k = 0; k < 8; ++k) value[k] = k + x;
}
void sensub(const int* id, const double* time, const double* par, const int* npar, const int* iflag, double* value) {
  (void)id, (void)npar, (void)iflag;
  *value = par[0] * *time;
}

/* par[0] DX(par[1], par[2]) at the instant at which a SENSOR triggers */
void sevsub(const int* id, const double* time, const double* par, const int* npar, const int* iflag, double* value) {
  const int at[2] = {(int)par[1], (int)par[2]};
  double x;
  int error;
  (void)id, (void)time, (void)npar, (void)iflag;
  c_sysfnc("DX", at, 2, &x, &error);
  *value = par[0] * x;
}
void doubled_sevsub(const int* id, const double* time, const double* par, const int* npar, const int* iflag,
                    double* value) {
  sevsub(id, time, par, npar, iflag, value);
  *value *= 2;
}

/* What goes wrong. */
void gives_no_number(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                     const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  *value = sqrt(-par[0]);
}
void says_stop(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
               const int* iflag, double* value) {
  (void)time, (void)par, (void)npar, (void)dflag, (void)iflag;
  *value = 1;
  c_errmes(1, "the table is missing", *id, "STOP");
}
void asks_too_late(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                   const int* iflag, double* value) {
  static int calls = 0;
  const int at[2] = {(int)par[0], (int)par[1]};
  int error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  *value = 0;
  if (++calls > 4) c_sysfnc("DX", at, 2, value, &error);
}
void asks_nonsense(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                   const int* iflag, double* value) {
  int error;
  (void)time, (void)par, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("HEIGHT", id, 1, value, &error);
}
void crashes(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
             double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  double* volatile nowhere = NULL;
  *value = par[0] > 0 ? *nowhere : 0;
}
void stops(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
           double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  *value = 0;
  if (par[0] > 0) par[1] > 0 ? quick_exit(0) : exit(0);
}
/* What is no routine of a REQUEST: one that writes too much, and those that ask for what is not there. */
void unusable_request(const int* id, const double* time, const double* par, const int* npar, const int* iflag,
                      double* value) {
  const int at[2] = {20, 1};
  double list[3];
  int n, error;
  (void)id, (void)time, (void)npar, (void)iflag;
  if (par[0] == 0) {
    for (int k = 0; k < 12; ++k) value[k] = k;
  } else if (par[0] == 1) {
    c_sysfnc("NONSENSE", at, 2, value, &error);
  } else {
    c_gtaray(88, list, &n, &error);
    value[0] = error;
  }
}
/* -par[0] DX(20,1) */
void padded_names(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                  const int* iflag, double* value) {
  const int at[2] = {20, 1};
  const double by_x = -par[0];
  double x;
  int error;
  (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX   ", at, 2, &x, &error);
  c_errmes(error, "DX is not there", *id, "STOP  ");
  c_syspar("Dx ", at, 2, &by_x, 1, &error);
  *value = -par[0] * x;
}
void speaks(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  spring_without_derivatives(id, time, par, npar, dflag, iflag, value);
  c_usrmes(1, "a spring of 50", *id, "CONT");
}
/* -par[2] x, and a jump of par[3] at x = 0.1. */
void jumps(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
           double* value) {
  const int at[2] = {(int)par[0], (int)par[1]};
  double x;
  int error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX", at, 2, &x, &error);
  *value = -par[2] * x + (x > 0.1 ? par[3] : 0);
}
/* -par[2] x - par[3] v, with the derivative by x alone. */
void forgets_damping(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                     const int* iflag, double* value) {
  const int at[2] = {(int)par[0], (int)par[1]}, moving[3] = {at[0], at[1], at[1]};
  double x, v;
  int error, wanted;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX", at, 2, &x, &error);
  c_sysfnc("VX", moving, 3, &v, &error);
  *value = -par[2] * x - par[3] * v;
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  const double by_x = -par[2];
  c_syspar("DX", at, 2, &by_x, 1, &error);
}

/* A spring of par[0] towards +x and par[1] towards -x, by DX of (par[2], par[3]), that tells no derivative. */
void bent(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
          double* value) {
  const int at[3] = {(int)par[2], (int)par[3], (int)par[3]};
  double x;
  int error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX", at, 3, &x, &error);
  *value = -par[x > 0.1 ? 0 : 1] * (x - 0.1);
}
/* -par[2] DX, with par[3] as what it says of the derivative. */
void misled(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* value) {
  const int at[3] = {(int)par[0], (int)par[1], (int)par[1]};
  double x;
  int error, wanted;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX", at, 3, &x, &error);
  *value = -par[2] * x;
  c_adams_needs_partials(&wanted);
  if (wanted) c_syspar("DX", at, 3, &par[3], 1, &error);
}
/* Looks at its first constant whether it has any or not. */
void first_constant(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                    const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  *value = par[0];
}

/* The function par[0] (0 IMPACT, 1 BISTOP, 2 STEP, 3 STEP5, 4 HAVSIN, 5 SHF, 6 POLY, 7 CHEBY, 8 FORCOS, 9 FORSIN) of DX and
 * VX of (par[1], par[2]) and of the numbers behind them, with its derivatives. */
static void language(int which, double x, double v, const double* a, int n, int order, double* y, int* error) {
  switch (which) {
    case 0: c_impact(x, v, a[0], a[1], a[2], a[3], a[4], order, y, error); break;
    case 1: c_bistop(x, v, a[0], a[1], a[2], a[3], a[4], a[5], order, y, error); break;
    case 2: c_step(x, a[0], a[1], a[2], a[3], order, y, error); break;
    case 3: c_step5(x, a[0], a[1], a[2], a[3], order, y, error); break;
    case 4: c_havsin(x, a[0], a[1], a[2], a[3], order, y, error); break;
    case 5: c_shf(x, a[0], a[1], a[2], a[3], a[4], order, y, error); break;
    case 6: c_poly(x, a[0], a + 1, n - 1, order, y, error); break;
    case 7: c_cheby(x, a[0], a + 1, n - 1, order, y, error); break;
    case 8: c_forcos(x, a[0], a[1], a + 2, n - 2, order, y, error); break;
    default: c_forsin(x, a[0], a[1], a + 2, n - 2, order, y, error); break;
  }
}
void of_the_language(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                     const int* iflag, double* value) {
  const int which = (int)par[0], i = (int)par[1], j = (int)par[2];
  const int at[3] = {i, j, j}, moving[4] = {i, j, j, j};
  double x, v, y[3] = {0, 0, 0};
  int error, wanted;
  (void)id, (void)time, (void)dflag, (void)iflag;
  c_sysfnc("DX", at, 3, &x, &error);
  c_sysfnc("VX", moving, 4, &v, &error);
  language(which, x, v, par + 3, *npar - 3, 0, y, &error);
  c_errmes(error, "there is no value", 0, "STOP");
  *value = y[0];
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  language(which, x, v, par + 3, *npar - 3, 1, y, &error);
  if (which > 1) y[1] = 0;
  c_syspar("DX", at, 3, &y[0], 1, &error);
  c_syspar("VX", moving, 4, &y[1], 1, &error);
}
/* -(SPLINE par[0] at DX of (par[2], par[3]), on the curve z = par[4] DY), by AKISPL if par[1] is 0 or CUBSPL, with its
 * derivatives. */
void of_a_spline(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                 const int* iflag, double* value) {
  const int at[3] = {(int)par[2], (int)par[3], (int)par[3]};
  double x, y, array[3] = {0, 0, 0};
  int error, wanted, order;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_adams_declare_threadsafe();
  c_sysfnc("DX", at, 3, &x, &error);
  c_sysfnc("DY", at, 3, &y, &error);
  c_adams_needs_partials(&wanted);
  for (order = wanted ? 1 : 0; order >= 0; --order) {
    if (par[1] == 0) c_akispl(x, par[4] * y, (int)par[0], order, array, &error);
    if (par[1] != 0) c_cubspl(x, par[4] * y, (int)par[0], order, array, &error);
    c_errmes(error, "there is no such spline", 0, "STOP");
    if (order == 0) break;
    array[0] = -array[0], array[1] = -par[4] * array[1];
    c_syspar("DX", at, 3, &array[0], 1, &error);
    c_syspar("DY", at, 3, &array[1], 1, &error);
  }
  *value = -array[0];
}
/* Number par[2] of what a utility reads of statement par[1]: par[0] 0 and 1 second derivatives of a spline at (1.5,
 * 0.5), 2 to 4 a curve and its derivatives at 0.25, 5 gravity, 6 the characters of a text, 7 how many they are. */
void of_the_data(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                 const int* iflag, double* value) {
  const int what = (int)par[0], of = (int)par[1], number = (int)par[2];
  double array[3] = {0, 0, 0};
  char text[1025] = "";
  int error = 0, count = 0;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  if (what == 0) c_akispl(1.5, 0.5, of, 2, array, &error);
  if (what == 1) c_cubspl(1.5, 0.5, of, 2, array, &error);
  if (what >= 2 && what <= 4) c_gtcurv(of, 0.25, what - 2, array, &error);
  if (what == 5) c_get_gravity(&array[0], &array[1], &array[2]);
  if (what >= 6) c_gtstrg(of, text, &count, &error);
  c_errmes(error, "there is no such statement", 0, "STOP");
  *value = what == 6 ? text[number] : what == 7 ? count : array[number];
}
/* A second derivative of IMPACT by DX twice, by both, by VX twice: par[0] says which. */
void curvature(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
               double* value) {
  double y[3];
  int error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_impact(0.4, -0.2, 1, 100, 2.5, 7, 1, 2, y, &error);
  *value = y[(int)par[0]];
}
/* The third number of the ARRAY par[0]. */
void of_an_array(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                 const int* iflag, double* value) {
  double numbers[3] = {0, 0, 0};
  int count, status;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_gtaray((int)par[0], numbers, &count, &status);
  *value = numbers[2];
}

/* The time t, as a MOTION asks for it; no value from par[0] on: for a reason that it gives, or par[1] not 0 no number. */
void stopping_motion(const int* id, const double* time, const double* par, const int* npar, const int* iord,
                     const int* iflag, double* value) {
  const int over = *time > par[0];
  (void)npar, (void)iflag;
  *value = *iord == 0 ? *time : *iord == 1 ? 1 : 0;
  if (par[1] != 0 && over) *value = 0.0 / 0.0;
  if (par[1] == 0) c_errmes(over, "the drive has burnt out", *id, "STOP");
}
/* EVALUATE of a SENSOR that has none, in the same ways by par[0]. */
void stopping_evaluation(const int* id, const double* time, const double* par, const int* npar, const int* iflag,
                         double* value) {
  (void)time, (void)npar;
  *value = par[0] != 0 && *iflag == 0 ? 0.0 / 0.0 : 1;
  if (par[0] == 0) c_errmes(1, "the gauge is broken", *id, "STOP");
}
/* Discrete states of a GSE, in the same way. */
void stopping_update(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                     const int* iflag, const int* count, double* values) {
  int k;
  (void)par, (void)npar, (void)dflag, (void)iflag;
  for (k = 0; k < *count; ++k) values[k] = 1;
  c_errmes(*time > 0.2, "the controller hangs", *id, "STOP");
}
void constant_output(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                     const int* iflag, const int* count, double* values) {
  int k;
  (void)id, (void)time, (void)par, (void)npar, (void)dflag, (void)iflag;
  for (k = 0; k < *count; ++k) values[k] = 2;
}

/* -5 times the measure of markers par[1] and par[2] whose name is the text of STRING par[0]. */
void named_by_text(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                   const int* iflag, double* value) {
  const int at[3] = {(int)par[1], (int)par[2], (int)par[2]};
  char name[1025] = "";
  double x = 0;
  int error, count;
  const double slope = -5;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_gtstrg((int)par[0], name, &count, &error);
  c_sysfnc(name, at, 3, &x, &error);
  c_syspar(name, at, 3, &slope, 1, &error);
  *value = slope * x;
}

/* The time cubed for every order. */
void forgetful_motion(const int* id, const double* time, const double* par, const int* npar, const int* iord,
                      const int* iflag, double* value) {
  (void)id, (void)par, (void)npar, (void)iord, (void)iflag;
  *value = *time * *time * *time;
}
/* The same with its derivatives. */
void cubic_motion(const int* id, const double* time, const double* par, const int* npar, const int* iord,
                  const int* iflag, double* value) {
  const double t = *time;
  (void)id, (void)par, (void)npar, (void)iflag;
  *value = *iord == 0 ? t * t * t : *iord == 1 ? 3 * t * t : 6 * t;
}
/* -DX of marker 20, whose derivative it tells as par[0] numbers. */
void miscounted(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                const int* iflag, double* value) {
  const int marker = 20;
  const double partials[6] = {-1, 0, 0, 0, 0, 0};
  double x;
  int error, wanted;
  (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysfnc("DX", &marker, 1, &x, &error);
  c_adams_needs_partials(&wanted);
  if (wanted) c_syspar("DX", &marker, 1, partials, (int)par[0], &error);
  *value = -x;
  (void)id;
}
/* Writes par[0] values. */
void overflowing(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                 const int* iflag, double* values) {
  int k;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  for (k = 0; k < (int)par[0]; ++k) values[k] = 0.5;
}
