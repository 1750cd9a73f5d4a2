// Utilities of compiled routines that read data of the model: AKISPL, CUBSPL, GTCURV, GTSTRG, NMODES, MODINF,
// matrices and gravity, and the same under the names by which Fortran calls them. Where a routine is only asked what it
// reads they give zeros, but for texts.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "routine/routine_context.h"
#include "routine/routine_data.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

// Null outside of routines, and in those that are called before there is a model.
const RoutineData* data_at_work() {
  RoutineContext* c = RoutineContext::current();
  if (c && !c->data) c->fail("it reads data of the model, which are not there yet when it is called");
  return c ? c->data : nullptr;
}
bool gives_zeros() {
  return !data_at_work()->is_read || RoutineContext::current()->phase == RoutineContext::Phase::asking;
}

// Whether there is such a SPLINE.
bool expand(SplineMethod method, int id, double x, double z, SplineCurves::Expansion& out) {
  const RoutineData* data = data_at_work();
  if (!data) return false;
  const auto found = data->splines.find(id);
  if (found == data->splines.end()) return false;
  if (gives_zeros()) return true;
  const auto& curves = method == SplineMethod::akima ? found->second.akima : found->second.cubic;
  if (curves) out = curves->expand(x, z);
  return curves != nullptr;
}

void interpolate(SplineMethod method, double x, double z, int id, int iord, double* array, int* errflg) {
  SplineCurves::Expansion e;
  *errflg = 1;
  if (iord < 0 || iord > 2) return;
  *errflg = !expand(method, id, x, z, e);
  if (iord == 0) array[0] = e.along[0];
  if (iord == 1) array[0] = e.along[1], array[1] = e.by_z[0];
  if (iord == 2) array[0] = 2 * e.along[2], array[1] = e.by_z[1], array[2] = 0;
}

// Null where there is no such flexible body.
const RoutineData::Modes* modes_of(int id) {
  const RoutineData* data = data_at_work();
  if (!data) return nullptr;
  const auto found = data->flexible_bodies.find(id);
  return found == data->flexible_bodies.end() ? nullptr : &found->second;
}

// Null where there is no such MATRIX.
const RoutineData::Numbers* matrix_of(int id) {
  const RoutineData* data = data_at_work();
  if (!data) return nullptr;
  const auto found = data->matrices.find(id);
  return found == data->matrices.end() ? nullptr : &found->second;
}
// A full one has all of its numbers, a sparse one those that are not zero.
bool is_listed(const RoutineData::Numbers& m, double value) { return !m.by_entries || value != 0; }

// Null where there is none.
const std::string* text_of_string(int id) {
  const RoutineData* data = data_at_work();
  if (!data) return nullptr;
  const auto found = data->strings.find(id);
  return found == data->strings.end() ? nullptr : &found->second;
}

}  // namespace

void keep_data_utilities() {}

}  // namespace dynalin

using namespace dynalin;

extern "C" {

void c_akispl(double xval, double zval, int id, int iord, double* array, int* errflg) {
  interpolate(SplineMethod::akima, xval, zval, id, iord, array, errflg);
}
void akispl_(const double* xval, const double* zval, const int* id, const int* iord, double* array, int* errflg) {
  c_akispl(*xval, *zval, *id, *iord, array, errflg);
}
void c_cubspl(double xval, double zval, int id, int iord, double* array, int* errflg) {
  interpolate(SplineMethod::cubic, xval, zval, id, iord, array, errflg);
}
void cubspl_(const double* xval, const double* zval, const int* id, const int* iord, double* array, int* errflg) {
  c_cubspl(*xval, *zval, *id, *iord, array, errflg);
}
int dynalin_spline(int method, int id, double x, double z, double* coefficients) {
  SplineCurves::Expansion e;
  const bool known = expand(method == 'A' ? SplineMethod::akima : SplineMethod::cubic, id, x, z, e);
  if (!known) e.along[0] = std::numeric_limits<double>::quiet_NaN();
  std::ranges::copy(e.along, coefficients);
  std::ranges::copy(e.by_z, coefficients + e.along.size());
  return known;
}

void c_gtcurv(int id, double alpha, int iord, double* array, int* istat) {
  const RoutineData* data = data_at_work();
  std::fill_n(array, 3, 0.0);
  *istat = 1;
  if (!data || !data->curves.contains(id) || iord < 0 || iord > 2) return;
  const auto& curve = data->curves.at(id);
  *istat = !gives_zeros() && !curve;
  if (gives_zeros() || !curve) return;
  const Vec3<double> v = curve->at(alpha, iord);
  array[0] = v.x, array[1] = v.y, array[2] = v.z;
}
void gtcurv_(const int* id, const double* alpha, const int* iord, double* array, int* istat) {
  c_gtcurv(*id, *alpha, *iord, array, istat);
}

void c_gtstrg(int id, char* string, int* nchars, int* istat) {
  const std::string* text = text_of_string(id);
  *istat = !text;
  *nchars = text ? static_cast<int>(text->size()) : 0;
  if (text) std::memcpy(string, text->c_str(), text->size() + 1);
}
void gtstrg_(const int* id, char* string, int* nchars, int* istat, std::size_t length) {
  const std::string* text = text_of_string(*id);
  *istat = !text || text->size() > length;
  *nchars = text ? static_cast<int>(text->size()) : 0;
  std::memset(string, ' ', length);
  if (text) std::memcpy(string, text->data(), std::min(text->size(), length));
}

void c_get_matrix_info(int id, int* type, int* nrows, int* ncols, int* size, int* ierr) {
  const RoutineData::Numbers* m = matrix_of(id);
  *ierr = !m;
  *type = m && m->by_entries ? 2 : 1;
  *nrows = m ? static_cast<int>(m->rows) : 0, *ncols = m ? static_cast<int>(m->columns) : 0;
  *size = m ? static_cast<int>(std::ranges::count_if(m->values, [&](double v) { return is_listed(*m, v); })) : 0;
}
void get_matrix_info_(const int* id, int* type, int* nrows, int* ncols, int* size, int* ierr) {
  c_get_matrix_info(*id, type, nrows, ncols, size, ierr);
}
void c_get_full_matrix_data(int id, double* vals, int size, int* ierr) {
  const RoutineData::Numbers* m = matrix_of(id);
  *ierr = !m || size < 0 || static_cast<std::size_t>(size) < m->values.size();
  if (!*ierr) std::ranges::copy(m->values, vals);
}
void get_full_matrix_data_(const int* id, double* vals, const int* size, int* ierr) {
  c_get_full_matrix_data(*id, vals, *size, ierr);
}
void c_get_sparse_matrix_data(int id, int* rows, int* cols, double* vals, int size, int* ierr) {
  const RoutineData::Numbers* m = matrix_of(id);
  *ierr = !m;
  int count = 0;
  for (std::size_t k = 0; m && k < m->values.size(); ++k) {
    if (!is_listed(*m, m->values[k])) continue;
    *ierr = count >= size;
    if (*ierr) return;
    rows[count] = static_cast<int>(k % m->rows) + 1, cols[count] = static_cast<int>(k / m->rows) + 1;
    vals[count++] = m->values[k];
  }
}
void get_sparse_matrix_data_(const int* id, int* rows, int* cols, double* vals, const int* size, int* ierr) {
  c_get_sparse_matrix_data(*id, rows, cols, vals, *size, ierr);
}

void c_nmodes(int id, int* nq, int* errflg) {
  const RoutineData::Modes* modes = modes_of(id);
  *errflg = !modes;
  *nq = modes ? static_cast<int>(modes->number.size()) : 0;
}
void nmodes_(const int* id, int* nq, int* errflg) { c_nmodes(*id, nq, errflg); }
void c_modinf(int id, int* mode, double* freq, int* errflg) {
  const RoutineData::Modes* modes = modes_of(id);
  *errflg = !modes;
  if (!modes) return;
  std::ranges::copy(modes->number, mode);
  std::ranges::copy(modes->frequency, freq);
}
void modinf_(const int* id, int* mode, double* freq, int* errflg) { c_modinf(*id, mode, freq, errflg); }

void c_get_gravity(double* gx, double* gy, double* gz) {
  const RoutineData* data = data_at_work();
  const Vec3<double> g = data ? data->gravity : Vec3<double>{};
  *gx = g.x, *gy = g.y, *gz = g.z;
}
void get_gravity_(double* gx, double* gy, double* gz) { c_get_gravity(gx, gy, gz); }

}  // extern "C"
