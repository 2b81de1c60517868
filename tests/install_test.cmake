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

# What the program makes of its own options, and what desktops and shells look for.
foreach(installed share/man/man1/penumbra.1 share/man/man1/penumbra-solve.1 share/bash-completion/completions/penumbra
                  share/zsh/vendor-completions/_penumbra share/applications/penumbra.desktop
                  share/icons/hicolor/scalable/apps/penumbra.svg share/doc/penumbra/report.schema.json)
  if(NOT EXISTS "${SCRATCH}/installed/${installed}")
    message(FATAL_ERROR "${installed} is not installed")
  endif()
endforeach()

# Without CMake, by pkg-config.
find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  file(GLOB_RECURSE package "${SCRATCH}/installed/penumbra.pc")
  cmake_path(GET package PARENT_PATH folder)
  set(ENV{PKG_CONFIG_PATH} "${folder}")
  execute_process(COMMAND "${PKG_CONFIG}" --cflags --libs penumbra OUTPUT_VARIABLE flags
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run("${COMPILER}" "${SCRATCH}/project/4_own_method.cpp" -o "${SCRATCH}/by_pkg_config" ${flags})
  run("${SCRATCH}/by_pkg_config")
endif()
file(REMOVE_RECURSE "${SCRATCH}")  # some hundred megabytes
