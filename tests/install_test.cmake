# Installs what was built, and builds and runs an example against it, as a project that knows nothing of the checkout.
#
#   cmake -D BUILD=build/dev -D EXAMPLES=examples -D SCRATCH=folder -D COMPILER=c++ -D LAUNCHER=ccache
#         -P tests/install_test.cmake

cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/installed")
file(COPY "${EXAMPLES}/" DESTINATION "${SCRATCH}/project")
run("${CMAKE_COMMAND}" -S "${SCRATCH}/project" -B "${SCRATCH}/build" -G Ninja -D CMAKE_BUILD_TYPE=Release
    -D "CMAKE_PREFIX_PATH=${SCRATCH}/installed" -D "CMAKE_CXX_COMPILER=${COMPILER}"
    -D "CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
run("${CMAKE_COMMAND}" --build "${SCRATCH}/build" --target example_4_own_method)
run("${SCRATCH}/build/example_4_own_method")
run("${SCRATCH}/installed/bin/penumbra" scenes)
file(REMOVE_RECURSE "${SCRATCH}")  # some hundred megabytes
