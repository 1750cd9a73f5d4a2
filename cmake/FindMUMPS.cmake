# MUMPS for real and for complex numbers, as the target MUMPS::MUMPS: the sequential one, or where DYNALIN_DISTRIBUTED asks
# for it the one for MPI with PT-Scotch. Debian's other one for MPI has no nested dissection: of a lattice of 27 000 masses
# its factors are seven times as large.
find_path(MUMPS_INCLUDE_DIR dmumps_c.h PATH_SUFFIXES mumps_seq)
set(mumps_kind _seq)
if(DYNALIN_DISTRIBUTED)
  set(mumps_kind _ptscotch)
endif()
find_library(MUMPS_LIBRARY dmumps${mumps_kind})
find_library(MUMPS_COMPLEX_LIBRARY zmumps${mumps_kind})
find_library(MUMPS_COMMON_LIBRARY mumps_common${mumps_kind})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MUMPS REQUIRED_VARS MUMPS_LIBRARY MUMPS_COMPLEX_LIBRARY MUMPS_COMMON_LIBRARY MUMPS_INCLUDE_DIR)
if(MUMPS_FOUND AND NOT TARGET MUMPS::MUMPS)
  add_library(MUMPS::MUMPS UNKNOWN IMPORTED)
  set_target_properties(MUMPS::MUMPS PROPERTIES
    IMPORTED_LOCATION "${MUMPS_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${MUMPS_COMPLEX_LIBRARY};${MUMPS_COMMON_LIBRARY}")
endif()
