# The program, the library and what find_package(Dynalin) needs.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Dynalin)

add_library(Dynalin::dynalin ALIAS dynalin)
install(TARGETS dynalin_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS dynalin EXPORT DynalinTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/dynalin ${CMAKE_CURRENT_BINARY_DIR}/include/dynalin
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(EXPORT DynalinTargets NAMESPACE Dynalin:: DESTINATION ${package})
configure_package_config_file(cmake/DynalinConfig.cmake.in DynalinConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(DynalinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/DynalinConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/DynalinConfigVersion.cmake
  cmake/FindKLU.cmake cmake/FindMUMPS.cmake cmake/FindMETIS.cmake cmake/FindMATIO.cmake cmake/FindSLEPc.cmake
  DESTINATION ${package})
