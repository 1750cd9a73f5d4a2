/* What compiled user routines and the program say to each other. For C and C++; Fortran reaches the same without it.
 *
 * A routine gives the value of FUNCTION = USER(r1, ...) of a statement. It stands in a shared library, which
 * --user-library names, or ROUTINE = library::function of the statement. What it reads of the model it asks for with
 * the utilities below: the program must know all of it before it evaluates anything, so it calls the routine first with
 * iflag = 1 and 3, in which utilities give zeros and note what is asked for. A routine must be a function of what it
 * asks for, of time and of its constants, and of nothing else: no memory from call to call.
 *
 * Each routine may be written in two ways, which its name tells apart:
 *
 *     void sfosub(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
 *                 const int* iflag, double* value);                      lower case, also sfosub_ as Fortran names it
 *     void Sfosub(const struct sAdamsSforce*, double time, int dflag, int iflag, double* value);       first letter
 * only
 *
 *     statement   routine      values     between npar (or time) and the values
 *     VARIABLE    varsub       1          dflag, iflag
 *     SFORCE      sfosub       1          dflag, iflag
 *     GFORCE      gfosub       6          dflag, iflag
 *     VFORCE      vfosub       3          dflag, iflag
 *     VTORQUE     vtosub       3          dflag, iflag
 *     FIELD       fiesub       6          disp, velo, dflag, iflag; behind the values dfddis and dfdvel
 *     CONTACT     cnfsub       3          of NFUNCTION: see below
 *                 cffsub       3          of FFUNCTION: see below
 *     COUPLER     cousub       1          disp, ndisp, iflag: displacements of its joints; what is held at zero
 *     DIFF        difsub       1          dflag, iflag
 *     MOTION      motsub       1          iord, iflag: derivative 0, 1 or 2 with respect to time
 *     REQUEST     reqsub       8          iflag
 *     SENSOR      sensub       1          iflag
 *                 sevsub       1          iflag: what EVALUATE = USER is when it triggers
 *     FLEX_BODY   dmpsub       modes      freqs, nmode, stepsize: parts of critical damping, of CRATIO = USER
 *     GSE         gse_deriv    NS         dflag, iflag, how many values: x', or with IMPLICIT what is zero
 *                 gse_output   NO         the same: y
 *                 gse_update   ND         the same: discrete states behind a sample
 *                 gse_samp     1          iflag: time to the next sample (also gse_sample)
 *
 * A GSE may have gsesub instead of the first two, with gsexx, gsexu, gseyx and gseyu for its partial derivatives, each
 * a matrix column by column: of x' with respect to states and inputs, of y with respect to the same.
 *
 *     gsesub: id, time, par, npar, dflag, iflag, ns, x, ni, u, no, x', y
 *     Gsesub: const struct sAdamsGSE*, time, dflag, iflag, ns, x, ni, u, no, x', y
 *     gsexx:  id, time, par, npar, iflag, ns, x, ni, u, no, matrix
 *
 * fiesub gives force and torque on I along the axes of J as a function of disp (DX, DY, DZ, AX, AY, AZ of I from J less
 * LENGTH), of velo (VX, VY, VZ, WX, WY, WZ) and of time, and calls no utility for more. dfddis and dfdvel are 6 x 6,
 * column by column: dfddis[i + 6 * j] of force i by displacement j; where dflag is 1 all 72 are written.
 *
 * dmpsub gets the frequencies of the modes in cycles per second, ascending. It is called before the model is whole, so
 * it reads nothing of it, and what it gives must not change with time or stepsize.
 *
 * nfosub of an NFORCE takes the arguments of sfosub and gives 6 values for each of IMARKERS, force and torque on it
 * along the axes of J. What is in sAdamsNforce is a reading: the routine is none of the published ones of C.
 *
 * mfosub of an MFORCE gives a load on the coordinates of a flexible body, 6 + nmodes numbers: force and torque about
 * the BCS along its axes, and one for each modal coordinate.
 *
 *     mfosub: id, time, par, npar, dflag, iflag, modloads, nmodes, ncases, scale, case, loadvec
 *     Mfosub: const struct sAdamsMforce*, time, dflag, iflag, modloads, nmodes, ncases, scale, case, loadvec
 *
 * modloads are the loads of the body, column by column, 6 + nmodes numbers for each of ncases. FORCE = USER takes
 * loadvec as it is, whatever the model does. FUNCTION = USER takes *scale times load *case, counted from 1, or times
 * loadvec where *case is 0; the load is a function of time alone, so that c_syspar and the entry below tell derivatives
 * of the scale, as if that were the only value.
 *
 * cursub of a CURVE gives the point x, y, z at the parameter alpha, or its derivative iord (0, 1, 2) by it. It knows no
 * time, and is called before the model is whole: it reads nothing of it.
 *
 *     cursub: id, par, npar, alpha, iord, iflag, values
 *     Cursub: const struct sAdamsCurve*, alpha, iord, iflag, values
 *
 * A COUPLER needs couxx and couxx2 as well, which take the same arguments and give the ndisp first and the ndisp x
 * ndisp second partial derivatives, or the entry below. ROUTINE names three: ROUTINE = library::value, first, second.
 * A function of time as well needs the entry. Those with a capital: const struct sAdamsCoupler*, time, disp, iflag,
 * values. None of them calls a utility for more.
 *
 * A CONTACT calls its routines at every place where its shapes overlap:
 *
 *     cnfsub: id, time, par, npar, loci, ni, locj, nj, gap, gapdot, gapdotdot, area, dflag, iflag, values
 *     Cnfsub: const struct sAdamsContactFriction*, time, loci, ni, locj, nj, gap, gapdot, ..., values (C: no addresses)
 *     cffsub: id, time, par, npar, loci, locj, x, xdot, nforce, area, dflag, iflag, values
 *     Cffsub: const struct sAdamsContactFriction*, time, loci, locj, x, xdot, nforce, area, dflag, iflag, values
 *
 * loci is the place on the surface of I from the origin of the marker of that GRAPHICS along its axes, ni the unit
 * normal out of I along the same axes; locj and nj are those of J. gap is negative where they overlap, gapdot its rate.
 * values[0] of cnfsub pushes them apart, the other two are 0. xdot[0] is the speed with which the material of I slips
 * over that of J, xdot[1] always 0, xdot[2] the angular velocity of I seen from J about nj. nforce is what cnfsub (or
 * the law of the CONTACT) gives. values of cffsub: force on I along the slip, force on I across it (about nj by a right
 * angle ahead), torque on I about nj. gapdotdot, area and x are not known: they are not numbers, and neither is what is
 * calculated with them. No utility gives these routines more.
 *
 * id is that of the statement, par and npar are the constants between the parentheses of USER, dflag is 1 where
 * derivatives are wanted. iflag is 0 where the values are wanted, 1 and 3 as above.
 */
#ifndef DYNALIN_USER_ROUTINE_H
#define DYNALIN_USER_ROUTINE_H

#ifdef __cplusplus
extern "C" {
#endif

/* What a statement says, for routines with a capital. Ids are 0 where nothing is written. */
struct sAdamsVariable {
  int ID, NPAR;
  const double* PAR;
  double IC;
};
struct sAdamsSforce {
  int ID, NPAR;
  const double* PAR;
  int I, J, ACTION_ONLY;
  const char* Type; /* "TRANSLATION" or "ROTATION" */
};
struct sAdamsGforce {
  int ID, NPAR;
  const double* PAR;
  int I, RM, JFLOAT;
};
struct sAdamsVforce {
  int ID, NPAR;
  const double* PAR;
  int I, JFLOAT, RM;
};
struct sAdamsVtorque {
  int ID, NPAR;
  const double* PAR;
  int I, JFLOAT, RM;
};
struct sAdamsField {
  int ID, NPAR;
  const double* PAR;
  int I, J;
};
/* IFLIP_GEOM and JFLIP_GEOM have a number for each of IGEOM and JGEOM: 1 where it is turned inside out. */
struct sAdamsContact {
  int ID, nIGEOM, nJGEOM;
  const int *IGEOM, *JGEOM, *IFLIP_GEOM, *JFLIP_GEOM;
};
struct sAdamsContactFriction {
  struct sAdamsContact contact;
  int NPAR;
  const double* PAR;
};
struct sAdamsFlexBody {
  int ID;
};
struct sAdamsCratio {
  struct sAdamsFlexBody FlexBody;
  int NPAR;
  const double* PAR;
};
/* TYPE has T or R for each joint: whether its translation or its rotation is meant. */
struct sAdamsCoupler {
  int ID, NPAR;
  const double* PAR;
  int NJOINT;
  int JOINTS[3];
  char TYPE[3];
};
/* ORDER is 0 where nothing is written. */
struct sAdamsCurve {
  int ID, NPAR;
  const double* PAR;
  int CLOSED, ORDER;
  double MINPAR, MAXPAR;
};
struct sAdamsDiff {
  int ID, NPAR;
  const double* PAR;
  int STATIC_HOLD, IMPLICIT;
  double IC_R1, IC_R2;
};
struct sAdamsNforce {
  int ID, NPAR;
  const double* PAR;
  int NMARKERS;
  const int* IMARKERS;
  int J;
};
struct sAdamsMforce {
  struct sAdamsFlexBody FlexBody;
  int ID, NPAR;
  const double* PAR;
  int JFLOAT;
};
struct sAdamsMotion {
  int ID, NPAR;
  const double* PAR;
  int JOINT;
  const char* Type; /* "TRANSLATION" or "ROTATION" */
  int I, J;
  char Which[2];   /* X, Y, Z, B1, B2 or B3 between markers, else zeros */
  const char* DVA; /* "DISPLACEMENT", "VELOCITY" or "ACCELERATION" */
};
struct sAdamsRequest {
  int ID, NPAR;
  const double* PAR;
  const char *COMMENT, *TITLE[8]; /* "" where nothing is written */
};
struct sAdamsSensor {
  int ID, NPAR;
  const double* PAR;
  double VALUE, Error;
  char Logic[2]; /* EQ, GE or LE, without a 0 behind it */
};
struct sAdamsGSE {
  int ID, NPAR;
  const double* PAR;
  int NI, NO, U, Y; /* numbers of inputs and outputs, and their ARRAYs */
  int NS, X, IC;    /* of continuous states */
  int STATIC_HOLD, IMPLICIT, STATICS_ONLY;
  int ND, XD, ICD; /* of discrete states */
  double SAMPLE_OFFSET;
};

/* A measure of the model by the name of a function of expressions, "DX", "VR", "VARVAL", "JOINT" ..., with its
 * arguments in ipar. errflg is 1 if there is none, or if it was not asked for when iflag was 1 or 3. */
void c_sysfnc(const char* name, const int* ipar, int nsize, double* state, int* errflg);
/* Several at once; nstates is how many, and states may be a null pointer for that alone. ipar in parentheses, ids of
 * markers if nothing else is said:
 *
 *     DISP (i, j, k) 6      TDISP (i, j, k) 3      RDISP (i, j) 3: PSI, THETA, PHI
 *     VEL (i, j, k, l) 6    TVEL (i, j, k, l) 3    RVEL (i, j, k) 3
 *     ACC (i, j, k, l) 6    TACC (i, j, k, l) 3    RACC (i, j, k, l) 3
 *     FORCE (i, j, k) 6     TFORCE (i, j, k) 3     RFORCE (i, j, k) 3
 *     UVX, UVY, UVZ (i, j) 3
 *     DC (i, j) 9, row by row: components along the axes of j
 *     ARRAY (id)            PINPUT (id)            POUTPUT (id)
 *
 * Q, QDOT (id of a FLEX_BODY): its modal coordinates and their rates, in their order, as many as c_nmodes says */
void c_sysary(const char* name, const int* ipar, int nsize, double* states, int* nstates, int* errflg);
/* Whether partial derivatives are wanted, and what they are: partial[v + values * s] of value v of the routine with
 * respect to number s of what c_sysary or c_sysfnc gives for the same name and ipar. npartial is how many; 0 arguments
 * and the name "TIME" give those with respect to time. A routine that gives them for all that it asked for is exact;
 * one that does not is differenced where the program is allowed to. */
void c_adams_needs_partials(int* wanted);
void c_syspar(const char* name, const int* ipar, int nsize, const double* partial, int npartial, int* errflg);
/* If errflg is not 0 and endflg is "STOP": the routine has no value here, for the reason given. */
void c_errmes(int errflg, const char* message, int id, const char* endflg);
void c_usrmes(int msgflg, const char* message, int id, const char* endflg);
/* Time, and which analysis is at work, as the function MODE gives it: 3 initial conditions, 4 dynamics, 5 statics,
 * 6 quasi-statics, 7 linear. */
void c_timget(double* time);
void c_getmod(int* mode);

/* The numbers of an ARRAY, as c_sysary("ARRAY", ...) gives them. istat is 1 if there is none. */
void c_gtaray(int id, double* array, int* number, int* istat);

/* Functions of the language. iord 0 gives the value, 1 the first and 2 the second derivative by x; of c_impact and
 * c_bistop vec holds the value, or those by x and dxdt, or those by x twice, by both and by dxdt twice. errflg is 1
 * where there is none. par are the coefficients behind the arguments that are named. */
void c_step(double x, double x0, double h0, double x1, double h1, int iord, double* value, int* errflg);
void c_step5(double x, double x0, double h0, double x1, double h1, int iord, double* value, int* errflg);
void c_havsin(double x, double x0, double h0, double x1, double h1, int iord, double* value, int* errflg);
void c_impact(double x, double dxdt, double x1, double k, double e, double cmax, double d, int iord, double* vec,
              int* errflg);
void c_bistop(double x, double dxdt, double x1, double x2, double k, double e, double cmax, double d, int iord,
              double* vec, int* errflg);
void c_shf(double x, double x0, double a, double w, double phi, double b, int iord, double* value, int* errflg);
void c_poly(double x, double x0, const double* par, int npar, int iord, double* value, int* errflg);
void c_cheby(double x, double x0, const double* par, int npar, int iord, double* value, int* errflg);
void c_forcos(double x, double x0, double w, const double* par, int npar, int iord, double* value, int* errflg);
void c_forsin(double x, double x0, double w, const double* par, int npar, int iord, double* value, int* errflg);

/* Data of the model, which are no measures: nobody must ask for them beforehand. Where a routine is only asked what it
 * reads they give zeros, but texts are there. errflg or istat is 1 if there is no such statement.
 *
 * A SPLINE by Akima's method and as a cubic spline. iord 0: array[0] is y. iord 1: dy/dx, dy/dz. iord 2: the second
 * derivatives by x twice, by both, by z twice. array has room for three. z counts for families of curves. */
void c_akispl(double xval, double zval, int id, int iord, double* array, int* errflg);
void c_cubspl(double xval, double zval, int id, int iord, double* array, int* errflg);
/* A CURVE at the parameter alpha: x, y, z, or with iord 1 and 2 their derivatives. */
void c_gtcurv(int id, double alpha, int iord, double* array, int* istat);
/* The text of a STRING, 1024 characters at most with a 0 behind them, and how many it has. In Fortran blanks fill up
 * what is longer than the text; one that is shorter gets its beginning, and istat is 1. */
void c_gtstrg(int id, char* string, int* nchars, int* istat);
/* Along the global axes, in length and time of the model. */
void c_get_gravity(double* gx, double* gy, double* gz);
/* How many modal coordinates a FLEX_BODY has, and in their order the numbers of the modes in its file and their
 * frequencies in cycles per second. */
void c_nmodes(int id, int* nq, int* errflg);
void c_modinf(int id, int* mode, double* freq, int* errflg);
/* A MATRIX: type is 1 where it is full and 2 where it is sparse, size how many numbers it has, of a sparse one those
 * that are not zero. All numbers column by column, or those with their rows and columns, counted from 1; ierr is 1 if
 * there is none, or if size is less than it takes. Type and order are readings. */
void c_get_matrix_info(int id, int* type, int* nrows, int* ncols, int* size, int* ierr);
void c_get_full_matrix_data(int id, double* vals, int size, int* ierr);
void c_get_sparse_matrix_data(int id, int* rows, int* cols, double* vals, int size, int* ierr);

/* A rotation by one description from another, angles in radians: EULER or B313, B321, B312, B323, B123 (three angles
 * about axes of the body, one after the other), YPR (as the functions YAW, PITCH, ROLL), EULPAR (4), RODPAR (3, Euler
 * parameters by the first of them), COSINES (9, column by column), and as the second one AXAYAZ (as AX, AY, AZ). istat
 * is 1 for other words, for what is no rotation, and for half a turn in RODPAR. */
void c_rcnvrt(const char* sys1, const double* coord1, const char* sys2, double* coord2, int* istat);
/* A number as text, with a 0 behind it, and how many characters it has. */
void c_istrng(int number, char* string, int* length, int* istat);
void c_rstrng(double reel, char* string, int* length, int* istat);
/* "Dynalin" and its version; processor time of the run in seconds. */
void c_getver(char* value);
void c_getcpu(double* value);
/* Routines are called by one thread at a time: 0 and 1, and nothing comes of the rest. */
void c_get_thread_index(int* index);
void c_get_nthread(int* n);
void c_adams_declare_threadsafe(void);
void c_adams_smp_group(int group);
void c_set_partial_method(int method);

/* Of the GSE that a routine is called for: how many states, discrete states, inputs and outputs, their values, and x'
 * of an implicit one. Partial derivatives with respect to them as c_syspar takes them. From Fortran: GSE_NS(ns),
 * GSE_X(x, ns), GSEPAR_X(partial, n) ... */
int c_gse_ns(void);
int c_gse_nd(void);
int c_gse_ni(void);
int c_gse_no(void);
void c_gse_x(double* x, int ns);
void c_gse_xdot(double* xdot, int ns);
void c_gse_xd(double* xd, int nd);
void c_gse_u(double* u, int ni);
void c_gsepar_x(const double* partial, int npartial);
void c_gsepar_xdot(const double* partial, int npartial);
void c_gsepar_u(const double* partial, int npartial);

/* A second entry "<routine>_derivatives" takes the place of c_syspar, and gives derivatives of any order that the
 * program needs. dynalin/user_routine.hpp writes it by itself. */
struct dynalin_course {
  int id, npar;
  const double* par;
  int inputs;          /* time, a number without meaning, what was asked for, each once, in the order of asking; of a
                          FIELD disp and velo instead; of a CONTACT loci, ni, locj, nj, gap and gapdot, or loci,
                          locj, xdot and nforce; of a COUPLER disp; of a CURVE alpha */
  int values;          /* of the routine */
  int order;           /* 0: values and their partial derivatives; 2: also two time derivatives of both */
  const double* input; /* [(order + 1) * k + d]: derivative d of input k with respect to time */
  double* value;       /* [(order + 1) * v + d] */
  double* partial; /* [(order + 1) * (inputs * v + k) + d]: derivative d of the partial of v with respect to input k */
};
/* Which input c_sysfnc of the same arguments reads; for arrays the first. -1: none. Inside of that entry alone. */
int dynalin_input(const char* name, const int* ipar, int nsize);
/* The same of number n of what c_sysary gives. */
int dynalin_input_of_array(const char* name, const int* ipar, int nsize, int n);
/* A SPLINE around x and z, by 'A' Akima's method or 'C' as a cubic spline: y(x + s, z + h) = c0 + c1 s + c2 s^2 + c3
 * s^3
 * + h (c4 + c5 s + c6 s^2 + c7 s^3) on the piece there. 0 if there is none, and c0 is no number then. */
int dynalin_spline(int method, int id, double x, double z, double* c);
/* The id of the ARRAY of a GSE that 'X', 'D' (discrete states) or 'U' names, 0 if there is none. */
int dynalin_gse_array(int which);

#ifdef __cplusplus
}
#endif

#endif
