/* Forces on many markers and on modal coordinates, and curves. */
#include <dynalin/user_routine.h>
#include <math.h>

/* ------------------------------------------------------------------------------------------------------------------
 * NFORCE: on marker a -k_r (y_a + s y_b) - c_r v_a, of all six components r, with s = 0.3 on the first marker and 0.1 on
 * the second. */
static const char* const shifts[6] = {"DX", "DY", "DZ", "AX", "AY", "AZ"};
static const char* const speeds[6] = {"VX", "VY", "VZ", "WX", "WY", "WZ"};
static const double stiffness[6] = {30, 50, 20, 4, 6, 3}, damping[6] = {1, 0.5, 2, 0.2, 0.1, 0.3};

static void several(const int* markers, int j, double turned, int partials, double* force) {
  const double from_other[2] = {0.3, 0.1};
  int a, r, n, wanted = 0, errflg = 0;
  for (n = 0; n < 12; ++n) force[n] = 0;
  c_adams_needs_partials(&wanted);
  for (a = 0; a < 2; ++a) {
    for (r = 0; r < 6; ++r) {
      int ids[4], of_shift = r < 3 ? 3 : 2, of_speed = r < 3 ? 4 : 3;
      double y, v, by_y[12] = {0}, by_v[12] = {0};
      ids[0] = markers[a], ids[1] = ids[2] = ids[3] = j;
      c_sysfnc(shifts[r], ids, of_shift, &y, &errflg);
      c_sysfnc(speeds[r], ids, of_speed, &v, &errflg);
      by_y[6 * a + r] = -stiffness[r], by_y[6 * (1 - a) + r] = -from_other[1 - a] * stiffness[r];
      by_v[6 * a + r] = -damping[r];
      for (n = 0; n < 12; ++n) force[n] += by_y[n] * y + by_v[n] * v;
      if (!wanted || !partials) continue;
      for (n = 0; n < 12; ++n) by_y[n] *= turned;
      c_syspar(shifts[r], ids, of_shift, by_y, 12, &errflg);
      c_syspar(speeds[r], ids, of_speed, by_v, 12, &errflg);
    }
  }
}
void nfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            double* force) {
  const int markers[2] = {(int)par[0], (int)par[1]};
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  several(markers, (int)par[2], 1, 1, force);
}
void Nfosubc(const struct sAdamsNforce* n, double time, int dflag, int iflag, double* force) {
  (void)time, (void)dflag, (void)iflag;
  if (n->NMARKERS == 2) several(n->IMARKERS, n->J, 1, 1, force);
}
void without_partials(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                      const int* iflag, double* force) {
  const int markers[2] = {(int)par[0], (int)par[1]};
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  several(markers, (int)par[2], 1, 0, force);
}
void with_wrong_partials(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                         const int* iflag, double* force) {
  const int markers[2] = {(int)par[0], (int)par[1]};
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  several(markers, (int)par[2], 1.2, 1, force);
}

/* ------------------------------------------------------------------------------------------------------------------
 * MFORCE: the first modal load times 2 - 40 q - 3 q', and half of the second one. */
static double scale_of(int body, int values, const double* by_scale) {
  double q = 0, rate = 0;
  int n = 1, k, wanted = 0, errflg = 0;
  c_sysary("Q", &body, 1, &q, &n, &errflg);
  c_errmes(errflg, "no modal coordinates", 1, "STOP");
  c_sysary("QDOT", &body, 1, &rate, &n, &errflg);
  c_errmes(errflg, "no modal rates", 1, "STOP");
  c_adams_needs_partials(&wanted);
  if (wanted) {
    double by_q[16], by_rate[16];
    for (k = 0; k < values; ++k) by_q[k] = -40 * by_scale[k], by_rate[k] = -3 * by_scale[k];
    c_syspar("Q", &body, 1, by_q, values, &errflg);
    c_syspar("QDOT", &body, 1, by_rate, values, &errflg);
  }
  return 2 - 40 * q - 3 * rate;
}
static void load_of(int body, const double* modloads, int nmodes, int ncases, double* load) {
  const int n = 6 + nmodes;
  const double scale = scale_of(body, n, modloads);
  int k;
  for (k = 0; k < n; ++k) load[k] = scale * modloads[k] + (ncases > 1 ? 0.5 * modloads[n + k] : 0);
}
void mfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            const double* modloads, const int* nmodes, const int* ncases, double* scale, int* number, double* load) {
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag, (void)scale, (void)number;
  load_of((int)par[0], modloads, *nmodes, *ncases, load);
}
void Mfosubc(const struct sAdamsMforce* m, double time, int dflag, int iflag, const double* modloads, int nmodes,
             int ncases, double* scale, int* number, double* load) {
  (void)time, (void)dflag, (void)iflag, (void)scale, (void)number;
  load_of(m->FlexBody.ID, modloads, nmodes, ncases, load);
  if (m->JFLOAT != 7 || m->ID != 1) load[0] += 1;
}
/* For FUNCTION: case par[1], or a load of its own where that is 0, the first one times par[2]. */
static const double one = 1;
void scaled(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            const double* modloads, const int* nmodes, const int* ncases, double* scale, int* number, double* load) {
  int k;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag, (void)ncases;
  *number = (int)par[1];
  if (*number == 0)
    for (k = 0; k < 6 + *nmodes; ++k) load[k] = par[2] * modloads[k];
  *scale = scale_of((int)par[0], 1, &one);
}
void Scaledc(const struct sAdamsMforce* m, double time, int dflag, int iflag, const double* modloads, int nmodes,
             int ncases, double* scale, int* number, double* load) {
  (void)time, (void)dflag, (void)iflag, (void)modloads, (void)nmodes, (void)ncases, (void)load;
  *number = (int)m->PAR[1];
  *scale = scale_of(m->FlexBody.ID, 1, &one);
}
/* A load of its own that changes with the modal coordinate, which no derivative of the scale says. */
void changes_its_load(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                      const int* iflag, const double* modloads, const int* nmodes, const int* ncases, double* scale,
                      int* number, double* load) {
  const double zero = 0;
  int body = (int)par[0], n, k, errflg;
  double q;
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag, (void)ncases;
  c_sysary("Q", &body, 1, &q, &n, &errflg);
  c_syspar("Q", &body, 1, &zero, 1, &errflg);
  for (k = 0; k < 6 + *nmodes; ++k) load[k] = (1 + q) * modloads[k];
  *scale = 2, *number = 0;
}

/* ------------------------------------------------------------------------------------------------------------------
 * CURVE: a cubic of u = par[12] + par[13] alpha for each coordinate, its coefficients one after the other. */
static void cubic(const double* par, double alpha, int order, double* c) {
  const double u = par[12] + par[13] * alpha, f = pow(par[13], order);
  int k;
  for (k = 0; k < 3; ++k) {
    const double* a = par + 4 * k;
    c[k] = order == 0   ? a[0] + u * (a[1] + u * (a[2] + u * a[3]))
           : order == 1 ? f * (a[1] + u * (2 * a[2] + u * 3 * a[3]))
                        : f * (2 * a[2] + 6 * a[3] * u);
  }
}
void cursub(const int* id, const double* par, const int* npar, const double* alpha, const int* iord, const int* iflag,
            double* values) {
  (void)id, (void)npar, (void)iflag;
  cubic(par, *alpha, *iord, values);
}
void Cursubc(const struct sAdamsCurve* c, double alpha, int iord, int iflag, double* values) {
  (void)iflag;
  cubic(c->PAR, alpha, iord, values);
  if (c->ID != 1 || c->CLOSED || c->MINPAR != -1 || c->MAXPAR != 1 || c->NPAR != 14) values[1] += 1;
}
void wrong_slope(const int* id, const double* par, const int* npar, const double* alpha, const int* iord,
                 const int* iflag, double* values) {
  cursub(id, par, npar, alpha, iord, iflag, values);
  if (*iord == 1) values[1] *= 1.1;
}
void wrong_bend(const int* id, const double* par, const int* npar, const double* alpha, const int* iord,
                const int* iflag, double* values) {
  cursub(id, par, npar, alpha, iord, iflag, values);
  if (*iord == 2) values[2] *= -1;
}
/* A circle of radius par[0], once round for alpha from 0 to par[1]. */
void circle(const int* id, const double* par, const int* npar, const double* alpha, const int* iord, const int* iflag,
            double* values) {
  const double w = 2 * 3.14159265358979323846 / par[1], a = w * *alpha + *iord * 3.14159265358979323846 / 2;
  (void)id, (void)npar, (void)iflag;
  values[0] = par[0] * pow(w, *iord) * cos(a), values[1] = par[0] * pow(w, *iord) * sin(a), values[2] = 0;
}
void no_curve(const int* id, const double* par, const int* npar, const double* alpha, const int* iord, const int* iflag,
              double* values) {
  int ids[2] = {20, 1}, errflg, k;
  double x;
  (void)id, (void)npar, (void)iflag, (void)iord;
  for (k = 0; k < (par[0] == 2 ? 4 : 3); ++k) values[k] = *alpha;
  if (par[0] == 0) c_sysfnc("DX", ids, 2, &x, &errflg);
  if (par[0] == 1) c_errmes(1, "no such curve", 1, "STOP");
  if (par[0] == 3) values[2] = NAN;
}

/* ------------------------------------------------------------------------------------------------------------------
 * What utilities say of a MATRIX: number par[2] of the list that par[1] asks for. */
void of_a_matrix(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                 const int* iflag, double* value) {
  int of = (int)par[0], number = (int)par[2], type, rows, columns, size, error, r[64], c[64];
  double v[64] = {0};
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_get_matrix_info(of, &type, &rows, &columns, &size, &error);
  if (par[1] == 0) *value = number == 0 ? type : number == 1 ? rows : number == 2 ? columns : number == 3 ? size : error;
  if (par[1] == 1) c_get_full_matrix_data(of, v, 64, &error), *value = number < 0 ? error : v[number];
  if (par[1] == 2) {
    c_get_sparse_matrix_data(of, r, c, v, 64, &error);
    *value = number < 0 ? error : 100 * r[number] + 10 * c[number] + v[number];
  }
  if (par[1] == 3) c_get_full_matrix_data(of, v, 2, &error), *value = error;
  if (par[1] == 4) c_get_sparse_matrix_data(of, r, c, v, 2, &error), *value = error;
}

/* A GSE, x' = u - 3 x and y = x, without any partial derivatives. */
void gsesub(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
            const int* ns, const double* x, const int* ni, const double* u, const int* no, double* rate, double* y) {
  (void)id, (void)time, (void)par, (void)npar, (void)dflag, (void)iflag, (void)ns, (void)ni, (void)no;
  rate[0] = u[0] - 3 * x[0], y[0] = x[0];
}
