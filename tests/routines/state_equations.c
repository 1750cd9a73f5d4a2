/* Routines of a GSE: linear equations whose matrices are the constants of the statement, A, B, C, D row by row, asked
 * for and given back in all ways that there are; and what goes wrong. */
#include <dynalin/user_routine.h>
#include <math.h>
#include <stddef.h>

enum { most = 8 };

/* Row r, column c of the matrices that lie one behind the other in par. */
struct Matrices {
  const double *A, *B, *C, *D;
  int n, m, p;
};
static struct Matrices matrices(const double* par, int n, int m, int p) {
  const struct Matrices all = {par, par + n * n, par + n * n + n * m, par + n * n + n * m + p * n, n, m, p};
  return all;
}
static void multiply(const double* M, int rows, int columns, const double* x, double* y) {
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) y[r] += M[r * columns + c] * x[c];
}
static void by_columns(const double* M, int rows, int columns, double factor, double* out) {
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) out[r + rows * c] = factor * M[r * columns + c];
}
static void clear(double* y, int n) {
  for (int k = 0; k < n; ++k) y[k] = 0;
}

/* The utilities that need no ids. */
static void linear(const double* M, const double* N, int rows, double* value) {
  const int n = c_gse_ns(), m = c_gse_ni();
  double x[most], u[most], partial[most * most];
  int wanted;
  c_gse_x(x, n);
  c_gse_u(u, m);
  clear(value, rows);
  multiply(M, rows, n, x, value);
  multiply(N, rows, m, u, value);
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  by_columns(M, rows, n, 1, partial);
  c_gsepar_x(partial, rows * n);
  by_columns(N, rows, m, 1, partial);
  c_gsepar_u(partial, rows * m);
}
void gse_deriv(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
               const int* iflag, const int* ns, double* xdot) {
  const struct Matrices s = matrices(par, c_gse_ns(), c_gse_ni(), c_gse_no());
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  linear(s.A, s.B, *ns, xdot);
}
void gse_output(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                const int* iflag, const int* no, double* y) {
  const struct Matrices s = matrices(par, c_gse_ns(), c_gse_ni(), c_gse_no());
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  linear(s.C, s.D, *no, y);
}

/* A statement first, and the ARRAYs by the ids that it says. */
static void by_arrays(const struct sAdamsGSE* s, const double* M, const double* N, int rows, double* value) {
  double x[most], u[most], partial[most * most];
  int n, m, error;
  c_sysary("ARRAY", &s->X, 1, x, &n, &error);
  c_sysary("ARRAY", &s->U, 1, u, &m, &error);
  if (n != s->NS || m != s->NI) c_errmes(1, "wrong sizes", s->ID, "STOP");
  clear(value, rows);
  multiply(M, rows, n, x, value);
  multiply(N, rows, m, u, value);
  by_columns(M, rows, n, 1, partial);
  c_syspar("ARRAY", &s->X, 1, partial, rows * n, &error);
  by_columns(N, rows, m, 1, partial);
  c_syspar("ARRAY", &s->U, 1, partial, rows * m, &error);
}
void Stated_deriv(const struct sAdamsGSE* s, double time, int dflag, int iflag, int ns, double* xdot) {
  const struct Matrices a = matrices(s->PAR, s->NS, s->NI, s->NO);
  (void)time, (void)dflag, (void)iflag;
  by_arrays(s, a.A, a.B, ns, xdot);
}
void Stated_output(const struct sAdamsGSE* s, double time, int dflag, int iflag, int no, double* y) {
  const struct Matrices a = matrices(s->PAR, s->NS, s->NI, s->NO);
  (void)time, (void)dflag, (void)iflag;
  by_arrays(s, a.C, a.D, no, y);
}

/* All in one, with routines for the partial derivatives. */
static void whole(const double* par, int n, const double* x, int m, const double* u, int p, double* xdot, double* y) {
  const struct Matrices s = matrices(par, n, m, p);
  clear(xdot, n), clear(y, p);
  multiply(s.A, n, n, x, xdot), multiply(s.B, n, m, u, xdot);
  multiply(s.C, p, n, x, y), multiply(s.D, p, m, u, y);
}
void gsesub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            const int* ns, const double* x, const int* ni, const double* u, const int* no, double* xdot, double* y) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  whole(par, *ns, x, *ni, u, *no, xdot, y);
}
void sub_alone(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
               const int* iflag, const int* ns, const double* x, const int* ni, const double* u, const int* no,
               double* xdot, double* y) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  whole(par, *ns, x, *ni, u, *no, xdot, y);
}
void Statedsub(const struct sAdamsGSE* s, double time, int dflag, int iflag, int ns, const double* x, int ni,
               const double* u, int no, double* xdot, double* y) {
  (void)time, (void)dflag, (void)iflag;
  whole(s->PAR, ns, x, ni, u, no, xdot, y);
}
#define PARTIALS(name, Name, M, rows, columns)                                                                      \
  void name(const int* id, const double* time, const double* par, const int* npar, const int* iflag, const int* ns, \
            const double* x, const int* ni, const double* u, const int* no, double* matrix) {                       \
    const struct Matrices s = matrices(par, *ns, *ni, *no);                                                         \
    (void)id, (void)time, (void)npar, (void)iflag, (void)x, (void)u;                                                \
    by_columns(s.M, s.rows, s.columns, 1, matrix);                                                                  \
  }                                                                                                                 \
  void Name(const struct sAdamsGSE* g, double time, int iflag, int ns, const double* x, int ni, const double* u,    \
            int no, double* matrix) {                                                                               \
    const struct Matrices s = matrices(g->PAR, ns, ni, no);                                                         \
    (void)time, (void)iflag, (void)x, (void)u;                                                                      \
    by_columns(s.M, s.rows, s.columns, 1, matrix);                                                                  \
  }
PARTIALS(gsexx, Statedxx, A, n, n)
PARTIALS(gsexu, Statedxu, B, n, m)
PARTIALS(gseyx, Statedyx, C, p, n)
PARTIALS(gseyu, Statedyu, D, p, m)

/* Without derivatives. */
void bare_deriv(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                const int* iflag, const int* ns, double* xdot) {
  double x[most], u[most];
  const struct Matrices s = matrices(par, c_gse_ns(), c_gse_ni(), c_gse_no());
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_gse_x(x, s.n), c_gse_u(u, s.m);
  clear(xdot, *ns);
  multiply(s.A, s.n, s.n, x, xdot), multiply(s.B, s.n, s.m, u, xdot);
}

/* E x' - E A x - E B u with E = [[2, 1], [1, 3]], or of rank 1 where the last constant is negative. */
void implicit_deriv(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                    const int* iflag, const int* ns, double* value) {
  const double regular[4] = {2, 1, 1, 3}, singular[4] = {2, 1, 4, 2};
  const double* E = par[*npar - 1] < 0 ? singular : regular;
  const struct Matrices s = matrices(par, 2, c_gse_ni(), c_gse_no());
  double x[2], rate[2], u[most], rest[2], A[4] = {0}, B[2 * most] = {0}, partial[2 * most];
  int wanted;
  (void)id, (void)time, (void)dflag, (void)iflag, (void)ns;
  c_gse_x(x, 2), c_gse_xdot(rate, 2), c_gse_u(u, s.m);
  clear(value, 2);
  for (int k = 0; k < 2; ++k) rest[k] = rate[k];
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 2; ++c) rest[r] -= s.A[2 * r + c] * x[c];
    for (int c = 0; c < s.m; ++c) rest[r] -= s.B[s.m * r + c] * u[c];
  }
  multiply(E, 2, 2, rest, value);
  c_adams_needs_partials(&wanted);
  if (!wanted) return;
  for (int r = 0; r < 2; ++r)
    for (int k = 0; k < 2; ++k) {
      for (int c = 0; c < 2; ++c) A[2 * r + c] += E[2 * r + k] * s.A[2 * k + c];
      for (int c = 0; c < s.m; ++c) B[s.m * r + c] += E[2 * r + k] * s.B[s.m * k + c];
    }
  by_columns(E, 2, 2, 1, partial);
  c_gsepar_xdot(partial, 4);
  by_columns(A, 2, 2, -1, partial);
  c_gsepar_x(partial, 4);
  by_columns(B, 2, s.m, -1, partial);
  c_gsepar_u(partial, 2 * s.m);
}

/* Sampled: xd+ = par[0] xd + par[1] u, y = xd; the time between samples grows by par[2] with each. */
void gse_update(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                const int* iflag, const int* nd, double* next) {
  double xd[most], u[most];
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_gse_xd(xd, *nd), c_gse_u(u, c_gse_ni());
  for (int k = 0; k < *nd; ++k) next[k] = par[0] * xd[k] + par[1] * u[k];
}
void sampled_output(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                    const int* iflag, const int* no, double* y) {
  double xd[most], partial[most * most] = {0};
  int id_of_xd = 0, error;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_gse_xd(xd, c_gse_nd());
  for (int k = 0; k < *no; ++k) y[k] = xd[k], partial[k + *no * k] = 1;
  id_of_xd = (int)par[3];
  if (id_of_xd != 0) c_syspar("ARRAY", &id_of_xd, 1, partial, *no * c_gse_nd(), &error);
}
/* The sample's own time and number are what it gives. */
void clock_update(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                  const int* iflag, const int* nd, double* next) {
  double xd[most];
  (void)id, (void)par, (void)npar, (void)dflag, (void)iflag;
  c_gse_xd(xd, *nd);
  next[0] = *time;
  if (*nd > 1) next[1] = xd[1] + 1;
}
void gse_samp(const int* id, const double* time, const double* par, const int* npar, const int* iflag, double* step) {
  (void)id, (void)npar, (void)iflag;
  *step = par[0] + par[1] * *time;
}

/* What goes wrong. */
void lost_deriv(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                const int* iflag, const int* ns, double* xdot) {
  double x[most], partial[most * most] = {0};
  (void)id, (void)time, (void)par, (void)npar, (void)dflag, (void)iflag;
  c_gse_x(x, *ns);
  for (int k = 0; k < *ns; ++k) xdot[k] = sqrt(-1 - x[k] * x[k]);
  c_gsepar_x(partial, *ns * *ns);
}
void lost_update(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                 const int* iflag, const int* nd, double* next) {
  (void)id, (void)par, (void)npar, (void)dflag, (void)iflag;
  for (int k = 0; k < *nd; ++k) next[k] = sqrt(0.25 - *time);
}
void crashing_deriv(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                    const int* iflag, const int* ns, double* xdot) {
  double* volatile nowhere = NULL;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag, (void)ns;
  xdot[0] = par[0] != 0 ? *nowhere : 0;
}
void greedy_deriv(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                  const int* iflag, const int* ns, double* xdot) {
  double x[most];
  (void)id, (void)time, (void)par, (void)npar, (void)dflag, (void)iflag;
  c_gse_x(x, *ns + 1);
  clear(xdot, *ns);
}
