/* The laws of a CONTACT as routines, with addresses for arguments and with a statement first. */
#include <dynalin/user_routine.h>
#include <math.h>
#include <stddef.h>

/* IMPACT with par: stiffness, exponent, damping, penetration of full damping. */
static void normal(const double* par, double gap, double gapdot, double* value) {
  int error;
  value[0] = value[1] = value[2] = 0;
  c_impact(gap, gapdot, 0, par[0], par[1], par[2], par[3], 0, value, &error);
  c_errmes(error, "no impact", 0, "STOP");
}
/* Coulomb's friction with par: static, dynamic coefficient, speeds of both. */
static void friction(const double* par, const double* xdot, double nforce, double* value) {
  double sign, size;
  int error;
  c_step(xdot[0], -par[2], -1, par[2], 1, 0, &sign, &error);
  c_step(xdot[0], par[2], par[0], par[3], par[1], 0, &size, &error);
  value[0] = -nforce * sign * size, value[1] = 0, value[2] = -par[4] * xdot[2];
}

void cnfsub(const int* id, const double* time, const double* par, const int* npar, const double* loci, const double* ni,
            const double* locj, const double* nj, const double* gap, const double* gapdot, const double* gapdotdot,
            const double* area, const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)ni, (void)locj, (void)nj, (void)gapdotdot, (void)area;
  (void)dflag, (void)iflag;
  normal(par, *gap, *gapdot, value);
}
void cffsub(const int* id, const double* time, const double* par, const int* npar, const double* loci,
            const double* locj, const double* x, const double* xdot, const double* nforce, const double* area,
            const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)locj, (void)x, (void)area, (void)dflag, (void)iflag;
  friction(par, xdot, *nforce, value);
}

/* Statements first, which say what they should. */
void Normalc(const struct sAdamsContactFriction* s, double time, const double* loci, const double* ni,
             const double* locj, const double* nj, double gap, double gapdot, double gapdotdot, double area, int dflag,
             int iflag, double* value) {
  (void)time, (void)loci, (void)ni, (void)locj, (void)nj, (void)gapdotdot, (void)area, (void)dflag, (void)iflag;
  normal(s->PAR, gap, gapdot, value);
  const struct sAdamsContact* c = &s->contact;
  const int right = c->ID == 1 && s->NPAR == 4 && c->nIGEOM == 2 && c->nJGEOM == 1 && c->IGEOM[0] == 2 &&
                    c->IGEOM[1] == 3 && c->JGEOM[0] == 1 && c->IFLIP_GEOM[0] == 0 && c->IFLIP_GEOM[1] == 0 &&
                    c->JFLIP_GEOM[0] == 1;
  if (!right) value[0] = 0;
}
void Frictionc(const struct sAdamsContactFriction* s, double time, const double* loci, const double* locj,
               const double* x, const double* xdot, double nforce, double area, int dflag, int iflag, double* value) {
  (void)time, (void)loci, (void)locj, (void)x, (void)area, (void)dflag, (void)iflag;
  friction(s->PAR, xdot, nforce, value);
}

/* A spring that is softer the farther the place of contact is from the plane of y and z of either marker, and what
 * else the places and normals are. */
void places(const int* id, const double* time, const double* par, const int* npar, const double* loci, const double* ni,
            const double* locj, const double* nj, const double* gap, const double* gapdot, const double* gapdotdot,
            const double* area, const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)gapdot, (void)gapdotdot, (void)area, (void)dflag, (void)iflag;
  value[0] = -par[0] * *gap / (1 + loci[0] * loci[0] + locj[0] * locj[0]) + 3 * ni[0] + 2 * nj[2] + loci[2] + locj[1];
  value[1] = value[2] = 0;
}

/* What cannot be. */
void uses_area(const int* id, const double* time, const double* par, const int* npar, const double* loci,
               const double* ni, const double* locj, const double* nj, const double* gap, const double* gapdot,
               const double* gapdotdot, const double* area, const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)ni, (void)locj, (void)nj, (void)gapdot, (void)gapdotdot;
  (void)dflag, (void)iflag;
  value[0] = -par[0] * *gap * *area, value[1] = value[2] = 0;
}
void three_values(const int* id, const double* time, const double* par, const int* npar, const double* loci,
                  const double* ni, const double* locj, const double* nj, const double* gap, const double* gapdot,
                  const double* gapdotdot, const double* area, const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)ni, (void)locj, (void)nj, (void)gapdot, (void)gapdotdot;
  (void)area, (void)dflag, (void)iflag;
  value[0] = -par[0] * *gap, value[1] = 1, value[2] = 0;
}
void asks_for_more(const int* id, const double* time, const double* par, const int* npar, const double* loci,
                   const double* ni, const double* locj, const double* nj, const double* gap, const double* gapdot,
                   const double* gapdotdot, const double* area, const int* dflag, const int* iflag, double* value) {
  const int at[2] = {2, 1};
  int error;
  double x;
  (void)id, (void)time, (void)npar, (void)loci, (void)ni, (void)locj, (void)nj, (void)gapdot, (void)gapdotdot;
  (void)area, (void)dflag, (void)iflag;
  c_sysfnc("DM", at, 2, &x, &error);
  value[0] = -par[0] * *gap * x, value[1] = value[2] = 0;
}
void pushes_at_rest(const int* id, const double* time, const double* par, const int* npar, const double* loci,
                    const double* locj, const double* x, const double* xdot, const double* nforce, const double* area,
                    const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)locj, (void)x, (void)xdot, (void)area, (void)dflag, (void)iflag;
  value[0] = -par[0] * *nforce, value[1] = value[2] = 0;
}
void deforms(const int* id, const double* time, const double* par, const int* npar, const double* loci,
             const double* locj, const double* x, const double* xdot, const double* nforce, const double* area,
             const int* dflag, const int* iflag, double* value) {
  (void)id, (void)time, (void)npar, (void)loci, (void)locj, (void)xdot, (void)area, (void)dflag, (void)iflag;
  value[0] = -par[0] * *nforce * x[0], value[1] = value[2] = 0;
}
