/* Routines that say what their statement told them, and what utilities give. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "dynalin/user_routine.h"

/* Not built, and so not in the header. */
void c_modify(const char* command, int* istat);
void c_gtcmat(int nmid, const int* mid, int ndim, double* c, int* istat);

static void say(const char* text, int id) { c_errmes(1, text, id, "STOP"); }

void Tellingmotion(const struct sAdamsMotion* m, double time, int iord, int iflag, double* value) {
  char text[200];
  (void)time, (void)iord;
  *value = 0;
  if (iflag != 0) return;
  snprintf(text, sizeof text, "motion %d of %d, %s, %d %d, %.2s, %s, %d: %g", m->ID, m->JOINT, m->Type, m->I, m->J,
           m->Which[0] ? m->Which : "--", m->DVA, m->NPAR, m->PAR[0]);
  say(text, m->ID);
}
void Tellingsensor(const struct sAdamsSensor* s, double time, int iflag, double* value) {
  char text[200];
  (void)time;
  *value = 0;
  if (iflag != 0) return;
  snprintf(text, sizeof text, "sensor %d: %.2s %g by %g", s->ID, s->Logic, s->VALUE, s->Error);
  say(text, s->ID);
}
/* Lengths of its comment and of its titles. */
void Tellingrequest(const struct sAdamsRequest* r, double time, int iflag, double* values) {
  int k;
  (void)time, (void)iflag;
  for (k = 0; k < 7; ++k) values[k + 1] = (double)strlen(r->TITLE[k]);
  values[0] = (double)strlen(r->COMMENT);
}

static const char* const systems[] = {"EULER", "B321", "B312", "B323", "B123", "EULPAR", "RODPAR", "COSINES", "YPR"};

/* By par: 0 the largest deviation of rotations that went from EULER through every pair of descriptions and back to
 * COSINES; 1 what COSINES of PSI, THETA, PHI of the marker differ from DC; 2 the same of YPR; 3 of AXAYAZ; 4 how many
 * descriptions are refused of eight wrong ones; 5 modes of the FLEX_BODY, 6 to 8 their numbers, 9 to 11 their frequencies;
 * 12 and 13 the texts of numbers; 14 threads; 15 whether it has a name. */
void of_utilities(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                  const int* iflag, double* value) {
  const int what = (int)par[0], of = (int)par[1];
  const double angles[][3] = {{0.3, 1.1, -2.0}, {0, 0, 0},     {0.4, 0, 0},  {2.5, 3.14159265358979312, 0.7},
                              {-3, 0.001, 3},   {1.2, 1.57, 1}, {0, 1.2, -1}, {-0.7, 2.9, 0.1}};
  const int markers[2] = {20, 1};
  double dc[9], of_marker[9], a[9], b[9], c[9], frequency[20];
  int status, count, error, i, j, k, n, mode[20];
  char text[80] = "";
  (void)id, (void)time, (void)npar, (void)dflag, (void)iflag;
  c_sysary("DC", markers, 2, dc, &count, &error);
  c_sysary("RDISP", markers, 2, a, &count, &error);
  c_errmes(error, "no angles", 0, "STOP");
  *value = 0;
  if (*iflag != 0) return;
  if (what == 0) {
    for (n = 0; n < 8; ++n) {
      c_rcnvrt("EULER", angles[n], "COSINES", dc, &status);
      for (i = 0; i < 9; ++i)
        for (j = 0; j < 9; ++j) {
          c_rcnvrt("EULER", angles[n], systems[i], a, &status);
          if (status) continue; /* half a turn in RODPAR */
          c_rcnvrt(systems[i], a, systems[j], b, &status);
          if (status) continue;
          c_rcnvrt(systems[j], b, "COSINES", c, &status);
          if (status) *value = 1;
          for (k = 0; k < 9; ++k) *value = fmax(*value, fabs(c[k] - dc[k]));
        }
    }
  } else if (what <= 3) {
    c_rcnvrt("EULER", a, "COSINES", of_marker, &status);
    for (i = 0; i < 3; ++i)
      for (j = 0; j < 3; ++j) *value = fmax(*value, fabs(of_marker[i + 3 * j] - dc[3 * i + j]));
    if (what == 1) return;
    c_rcnvrt("cosines", of_marker, what == 2 ? "YPR" : "AXAYAZ", b, &status);
    *value = b[of];
  } else if (what == 4) {
    const double wrong[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1}, none[4] = {0, 0, 0, 0}, half[4] = {0, 1, 0, 0};
    c_rcnvrt("COSINES", wrong, "EULER", b, &status), *value += status;
    c_rcnvrt("EULPAR", none, "EULER", b, &status), *value += status;
    c_rcnvrt("EULPAR", half, "RODPAR", b, &status), *value += status;
    c_rcnvrt("EULER", none, "KREBS", b, &status), *value += status;
    c_rcnvrt("KREBS", none, "EULER", b, &status), *value += status;
    c_rcnvrt("AXAYAZ", none, "EULER", b, &status), *value += status;
    c_nmodes(99, &count, &error), *value += error;
    c_modinf(99, mode, frequency, &error), *value += error;
  } else if (what <= 11) {
    c_nmodes(of, &count, &error);
    c_modinf(of, mode, frequency, &error);
    *value = what == 5 ? count : what < 9 ? mode[what - 6] : frequency[what - 9];
  } else if (what == 12) {
    c_istrng(-1234, text, &count, &status);
    *value = strcmp(text, "-1234") == 0 ? count : -1;
  } else if (what == 13) {
    c_rstrng(0.1, text, &count, &status);
    *value = strcmp(text, "0.1") == 0 ? count : -1;
  } else if (what == 14) {
    c_get_thread_index(&i), c_get_nthread(&n);
    *value = i + n;
  } else if (what == 15) {
    c_getver(text);
    *value = strncmp(text, "Dynalin ", 8) == 0;
  } else if (what == 16) {
    c_modify("GFORCE/1", &status);
  } else {
    c_gtcmat(1, &i, 6, value, &error);
  }
}

/* par[0] for modes below par[1] cycles per second and twice that above, or as par[2] says: 1 more with time, 2 with the
 * step, 3 negative, 4 with words, 5 after SYSFNC, 6 after a spline. */
static void damping(const double* par, int npar, const double* freqs, int modes, double time, double step, int id,
                    double* ratios) {
  const int how = npar > 2 ? (int)par[2] : 0, marker = 20;
  double ignored;
  int k, error;
  for (k = 0; k < modes; ++k) ratios[k] = freqs[k] < par[1] ? par[0] : 2 * par[0];
  if (how == 1) ratios[modes - 1] += 0.01 * time;
  if (how == 2) ratios[0] += step;
  if (how == 3) ratios[modes - 1] = -0.5;
  if (how == 4) say("no paint that thick", id);
  if (how == 5) c_sysfnc("DX", &marker, 1, &ignored, &error);
  if (how == 6) c_akispl(0, 0, 7, 0, &ignored, &error);
}
void dmpsub(const int* id, const double* time, const double* par, const int* npar, const double* freqs,
            const int* nmode, const double* stepsize, double* cratios) {
  damping(par, *npar, freqs, *nmode, *time, *stepsize, *id, cratios);
}
void Paint(const struct sAdamsCratio* c, double time, const double* freqs, int nmode, double stepsize,
           double* cratios) {
  damping(c->PAR, c->NPAR, freqs, nmode, time, stepsize, c->FlexBody.ID, cratios);
}
