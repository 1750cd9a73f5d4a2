# Installs into a folder of its own, builds the outside example against that and runs it.
#   cmake -DBUILD=… -DPROJECT=… -DWORK=… -DVERSION=… -DCOMPILER=… -P installed_test.cmake
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed:\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()
function(expect pattern)
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${pattern} is not in:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run("installing" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)

# The public headers and nothing else, and none of them reaches for another.
file(GLOB_RECURSE headers ${WORK}/installed/include/*)
foreach(header IN LISTS headers)
  if(NOT header MATCHES "/include/dynalin/[a-z_]+\\.h(pp)?$")
    message(FATAL_ERROR "${header} is installed")
  endif()
  file(STRINGS ${header} inward REGEX "#include \"")
  foreach(line IN LISTS inward)
    string(REGEX REPLACE "#include \"(.*)\"" "\\1" included "${line}")
    if(NOT EXISTS ${WORK}/installed/include/${included})
      message(FATAL_ERROR "${header} includes ${included}, which is not installed")
    endif()
  endforeach()
endforeach()
# Neither warnings nor folders of this tree are passed on.
file(GLOB_RECURSE targets ${WORK}/installed/*DynalinTargets*.cmake)
get_filename_component(tree ${PROJECT}/../.. ABSOLUTE)
foreach(file IN LISTS targets)
  file(READ ${file} text)
  if(text MATCHES "-W(all|extra|error)" OR text MATCHES "${tree}/")
    message(FATAL_ERROR "${file} passes on what is private:\n${text}")
  endif()
endforeach()

# The build program that is there: a bare machine has no other.
run("configuring" ${CMAKE_COMMAND} -G ${GENERATOR} -S ${PROJECT} -B ${WORK}/build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${WORK}/installed)
run("building" ${CMAKE_COMMAND} --build ${WORK}/build)
run("running" ${WORK}/build/suspension)
# 300 kg on 20 kN/m, and the same with 340 kg on 200 kN/m below.
expect("settles by 0\\.163827 m, the strut carries 2943\\.00 N")
expect("moves PART/3")
expect("moves PART/2")
expect("with Dynalin ${VERSION}\n")

# Programs are compiled as they like: what a matrix of the library is freed by must not depend on it, and nothing that
# both sides instantiate may be taken from the other.
foreach(options IN ITEMS "-march=native -O1" "-fsanitize=address")
  run("configuring with ${options}" ${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/matrices
      -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${WORK}/installed "-DCMAKE_CXX_FLAGS=${options}")
  run("building with ${options}" ${CMAKE_COMMAND} --build ${WORK}/matrices)
  run("running with ${options}" ${WORK}/matrices/matrices)
  expect("all as it should be\n")
endforeach()
run("the names that the library shows" ${NM} -DC --defined-only ${WORK}/installed/lib/libdynalin.so)
string(REGEX MATCHALL "[^\n]* [TWVBDRu] [^\n]*" shown "${output}")
list(FILTER shown EXCLUDE REGEX " [A-Za-z] ((typeinfo|typeinfo name|vtable) for )?dynalin::| T [A-Za-z0-9_]+$")
if(shown)
  list(SUBLIST shown 0 5 shown)
  message(FATAL_ERROR "the library shows what is not its own:\n${shown}")
endif()

run("the program" ${WORK}/installed/bin/dynalin --version)
expect("dynalin ${VERSION}")
file(REMOVE_RECURSE ${WORK})
