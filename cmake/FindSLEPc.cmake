# SLEPc and PETSc for complex numbers, as the target SLEPc::SLEPc. Debian installs each kind of numbers in a folder of its
# own; SLEPC_DIR and PETSC_DIR name others.
set(SLEPC_DIR "$ENV{SLEPC_DIR}" CACHE PATH "Where SLEPc for complex numbers is installed")
set(PETSC_DIR "$ENV{PETSC_DIR}" CACHE PATH "Where PETSc for complex numbers is installed")
file(GLOB slepc_folders /usr/lib/slepcdir/slepc3*/*-complex)
file(GLOB petsc_folders /usr/lib/petscdir/petsc3*/*-complex)
find_path(SLEPC_INCLUDE_DIR slepceps.h HINTS ${SLEPC_DIR} ${slepc_folders} PATH_SUFFIXES include)
find_library(SLEPC_LIBRARY NAMES slepc_complex slepc HINTS ${SLEPC_DIR} ${slepc_folders} PATH_SUFFIXES lib)
find_path(PETSC_INCLUDE_DIR petscsys.h HINTS ${PETSC_DIR} ${petsc_folders} PATH_SUFFIXES include)
find_library(PETSC_LIBRARY NAMES petsc_complex petsc HINTS ${PETSC_DIR} ${petsc_folders} PATH_SUFFIXES lib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SLEPc
  REQUIRED_VARS SLEPC_LIBRARY SLEPC_INCLUDE_DIR PETSC_LIBRARY PETSC_INCLUDE_DIR)
if(SLEPc_FOUND AND NOT TARGET SLEPc::SLEPc)
  add_library(SLEPc::SLEPc UNKNOWN IMPORTED)
  set_target_properties(SLEPc::SLEPc PROPERTIES
    IMPORTED_LOCATION "${SLEPC_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${SLEPC_INCLUDE_DIR};${PETSC_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS OMPI_SKIP_MPICXX INTERFACE_LINK_LIBRARIES "${PETSC_LIBRARY}")
endif()
