/* Routines that start a thread. */
#include <dynalin/user_routine.h>
#include <pthread.h>

struct work {
  double value;
  int error, count;
};
static void* read_displacement(void* data) {
  const int markers[2] = {2, 1};
  struct work* w = data;
  c_sysfnc("DZ", markers, 2, &w->value, &w->error);
  return NULL;
}
static void* read_displacements(void* data) {
  const int markers[2] = {2, 1};
  double all[6];
  struct work* w = data;
  c_sysary("DISP", markers, 2, all, &w->count, &w->error);
  w->value = all[2];
  return NULL;
}
static void* read_function(void* data) {
  struct work* w = data;
  c_step(w->value, 0, 0, 1, 1, 0, &w->value, &w->error);
  return NULL;
}
static double done_elsewhere(void* (*what)(void*), double value) {
  struct work w = {value, 0, 0};
  pthread_t thread;
  pthread_create(&thread, NULL, what, &w);
  pthread_join(thread, NULL);
  return w.error ? 0 : w.value;
}

/* The distance from 1 to 2 along z. par[0] 0: read here, and handed to a function in another thread; 1 and 2: read
 * there, alone or in an array; par[1] 1 only where a value is wanted, 2 only after time 0.5. */
void of_threads(const int* id, const double* time, const double* par, const int* npar, const int* dflag,
                const int* iflag, double* value) {
  const int markers[2] = {2, 1};
  const int elsewhere = par[0] != 0 && (par[1] == 0 || (par[1] == 1 && *iflag == 0) || (par[1] == 2 && *time > 0.5));
  int error = 0;
  double z = 0;
  (void)id, (void)npar, (void)dflag;
  if (!elsewhere || par[1] != 0) c_sysfnc("DZ", markers, 2, &z, &error);
  if (par[0] == 0) z = done_elsewhere(read_function, z);
  if (elsewhere) z = done_elsewhere(par[0] == 1 ? read_displacement : read_displacements, 0);
  *value = z;
}
