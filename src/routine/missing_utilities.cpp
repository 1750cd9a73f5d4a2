// Utilities that routines for Adams may call and that are not built. They are there so that a library loads that calls
// one of them in some case; whoever does call it is told which one it was. What they are given and should give does
// not matter: nothing goes on behind the call.
#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "routine/routine_context.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

struct MissingUtility : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void missing(std::string_view name) {
  const std::string reason = fmt::format("it calls the utility {}, which is not built", name);
  if (RoutineContext* c = RoutineContext::current()) c->fail(reason);
  throw MissingUtility(reason);
}

}  // namespace

void keep_missing_utilities() {}

}  // namespace dynalin

using dynalin::missing;

extern "C" {

void c_modify() { missing("MODIFY"); }
void modify_() { missing("MODIFY"); }
void c_analys() { missing("ANALYS"); }
void analys_() { missing("ANALYS"); }
void c_datout() { missing("DATOUT"); }
void datout_() { missing("DATOUT"); }
void c_put_spline() { missing("PUT_SPLINE"); }
void put_spline_() { missing("PUT_SPLINE"); }
void c_gtcmat() { missing("GTCMAT"); }
void gtcmat_() { missing("GTCMAT"); }
void c_gtunts() { missing("GTUNTS"); }
void gtunts_() { missing("GTUNTS"); }
void c_anlmod() { missing("ANLMOD"); }
void anlmod_() { missing("ANLMOD"); }
void c_getinm() { missing("GETINM"); }
void getinm_() { missing("GETINM"); }
void c_getint() { missing("GETINT"); }
void getint_() { missing("GETINT"); }
void c_getslv() { missing("GETSLV"); }
void getslv_() { missing("GETSLV"); }
void c_getstm() { missing("GETSTM"); }
void getstm_() { missing("GETSTM"); }
void c_get_solver() { missing("GET_SOLVER"); }
void get_solver_() { missing("GET_SOLVER"); }
void c_naninf() { missing("NANINF"); }
void naninf_() { missing("NANINF"); }
void c_tcnvrt() { missing("TCNVRT"); }
void tcnvrt_() { missing("TCNVRT"); }
void c_tirary() { missing("TIRARY"); }
void tirary_() { missing("TIRARY"); }
void c_ucovar() { missing("UCOVAR"); }
void ucovar_() { missing("UCOVAR"); }
void c_simsta() { missing("SIMSTA"); }
void simsta_() { missing("SIMSTA"); }
void c_setvelic() { missing("SETVELIC"); }
void setvelic_() { missing("SETVELIC"); }
void c_realtime() { missing("REALTIME"); }
void realtime_() { missing("REALTIME"); }
void c_get_n_contact_incidents() { missing("GET_N_CONTACT_INCIDENTS"); }
void get_n_contact_incidents_() { missing("GET_N_CONTACT_INCIDENTS"); }
void c_gsemap_x() { missing("GSEMAP_X"); }
void gsemap_x_() { missing("GSEMAP_X"); }
void c_gsemap_xdot() { missing("GSEMAP_XDOT"); }
void gsemap_xdot_() { missing("GSEMAP_XDOT"); }
void c_gsemap_u() { missing("GSEMAP_U"); }
void gsemap_u_() { missing("GSEMAP_U"); }

void c_sysfn2() { missing("c_sysfn2"); }
void c_get_linear_mat_states() { missing("c_get_linear_mat_states"); }
void c_set_gse_state_tolerance() { missing("c_set_gse_state_tolerance"); }
void c_system_kinetic_energy() { missing("c_system_kinetic_energy"); }
void c_system_momentum() { missing("c_system_momentum"); }
void c_body_mass_property() { missing("c_body_mass_property"); }
void c_add_mass_property() { missing("c_add_mass_property"); }
void c_subtract_mass_property() { missing("c_subtract_mass_property"); }
void c_get_solver_data() { missing("c_get_solver_data"); }
void c_get_integrator_details() { missing("c_get_integrator_details"); }
void c_get_HHT_parameters() { missing("c_get_HHT_parameters"); }
void c_get_numdif_info() { missing("c_get_numdif_info"); }
void c_get_tinu() { missing("c_get_tinu"); }
void c_gse_output_ics() { missing("c_gse_output_ics"); }
void c_set_dgse_type() { missing("c_set_dgse_type"); }
void c_adams_serialize_integers() { missing("c_adams_serialize_integers"); }
void c_adams_unserialize_integers() { missing("c_adams_unserialize_integers"); }
void c_adams_serialize_doubles() { missing("c_adams_serialize_doubles"); }
void c_adams_unserialize_doubles() { missing("c_adams_unserialize_doubles"); }
void c_adams_serialize_characters() { missing("c_adams_serialize_characters"); }
void c_adams_unserialize_characters() { missing("c_adams_unserialize_characters"); }

}  // extern "C"
