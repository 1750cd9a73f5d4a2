/* Hoist rope that stiffens as it is pulled. par: hook, trolley, VARIABLEs of the length that is let out and of its
 * rate, EA, how the strain bends the law, damping. Pulls: negative. */
#include <dynalin/user_routine.h>

void rope(const int* id, const double* time, const double* par, const int* npar, const int* dflag, const int* iflag,
          double* value) {
  const int ends[2] = {(int)par[0], (int)par[1]}, out = (int)par[2], rate = (int)par[3];
  double distance, apart, length, paid_out;
  int error;
  (void)id, (void)time, (void)npar, (void)iflag;
  c_sysfnc("DM", ends, 2, &distance, &error);
  c_sysfnc("VR", ends, 2, &apart, &error);
  c_sysfnc("VARVAL", &out, 1, &length, &error);
  c_sysfnc("VARVAL", &rate, 1, &paid_out, &error);
  if (*iflag != 0) length = 1; /* nothing has a value yet */
  {
    const double strain = distance / length - 1, stiffness = par[4] * (1 + 2 * par[5] * strain);
    double by[4];
    *value = -(par[4] * strain * (1 + par[5] * strain) + par[6] * (apart - paid_out));
    by[0] = -stiffness / length, by[1] = -par[6];
    by[2] = stiffness * distance / (length * length), by[3] = par[6];
    if (*dflag) {
      c_syspar("DM", ends, 2, by, 1, &error);
      c_syspar("VR", ends, 2, by + 1, 1, &error);
      c_syspar("VARVAL", &out, 1, by + 2, 1, &error);
      c_syspar("VARVAL", &rate, 1, by + 3, 1, &error);
    }
  }
}
