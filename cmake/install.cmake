# The program, the library and what find_package(Dynalin) needs.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Dynalin)

# Programs compile Eigen and the standard library with options of their own, under the names that these have here. So that
# neither side gets the functions of the other, this is a shared library that shows what is in namespace dynalin and what
# compiled routines call, nothing else, and takes its own functions itself.
add_library(dynalin_shared SHARED $<TARGET_OBJECTS:dynalin> $<$<TARGET_EXISTS:dynalin_team>:$<TARGET_OBJECTS:dynalin_team>>)
add_library(Dynalin::dynalin ALIAS dynalin_shared)
set_target_properties(dynalin_shared PROPERTIES OUTPUT_NAME dynalin EXPORT_NAME dynalin LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_compile_features(dynalin_shared PUBLIC cxx_std_20)
target_include_directories(dynalin_shared PUBLIC
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include>)
target_link_libraries(dynalin_shared PUBLIC Eigen3::Eigen PRIVATE $<TARGET_PROPERTY:dynalin,LINK_LIBRARIES>)
list(JOIN exported_utilities ";\n    " names)
file(CONFIGURE OUTPUT shown_symbols.map @ONLY CONTENT [[
{
  global:
    extern "C++" {
      dynalin::*;
      typeinfo?for?dynalin::*;
      typeinfo?name?for?dynalin::*;
      vtable?for?dynalin::*;
    };
    @names@;
  local: *;
};
]])
target_link_options(dynalin_shared PRIVATE
  LINKER:--version-script=${CMAKE_CURRENT_BINARY_DIR}/shown_symbols.map LINKER:-Bsymbolic-functions)

install(TARGETS dynalin_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS dynalin_shared EXPORT DynalinTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/dynalin ${CMAKE_CURRENT_BINARY_DIR}/include/dynalin
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(EXPORT DynalinTargets NAMESPACE Dynalin:: DESTINATION ${package})
configure_package_config_file(cmake/DynalinConfig.cmake.in DynalinConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(DynalinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/DynalinConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/DynalinConfigVersion.cmake
  DESTINATION ${package})
