# Build options, warnings, sanitizers and the helpers that define our targets.

option(PENUMBRA_TESTS "Build the tests" ON)
option(PENUMBRA_EXAMPLES "Build the examples" ON)
option(PENUMBRA_EXPERIMENTS "Build the benchmarks and studies" ON)
option(PENUMBRA_PYTHON "Build the Python module, where pybind11 and the headers of Python are" ON)
option(PENUMBRA_MPI "Let the processes that mpirun starts share the work, where MPI is" ON)
option(PENUMBRA_WERROR "Let no warning pass" OFF)
option(PENUMBRA_CHECKS "Keep the internal checks (PENUMBRA_DCHECK) alive" OFF)
set(PENUMBRA_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined or thread")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# What every target of ours is compiled with. No contraction: the same bytes on every run.
add_library(penumbra_options INTERFACE)
target_compile_features(penumbra_options INTERFACE cxx_std_20)
target_include_directories(penumbra_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                           $<INSTALL_INTERFACE:include/penumbra>)
target_compile_options(penumbra_options INTERFACE -ffp-contract=off)
if(PENUMBRA_CHECKS)
  target_compile_definitions(penumbra_options INTERFACE PENUMBRA_CHECKS)
endif()
if(PENUMBRA_SANITIZE)
  target_compile_options(penumbra_options INTERFACE -fsanitize=${PENUMBRA_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(penumbra_options INTERFACE -fsanitize=${PENUMBRA_SANITIZE})
  if(PENUMBRA_SANITIZE MATCHES "address")
    # Marking each temporary of a scope makes twice as much code; Eigen makes many.
    target_compile_options(penumbra_options INTERFACE -fno-sanitize-address-use-after-scope)
    if(PENUMBRA_SANITIZE MATCHES "undefined")
      # The address sanitizer stops at the accesses that three of these checks are for, and processors read what is not
      # aligned. A quarter of the time to compile is theirs.
      target_compile_options(penumbra_options INTERFACE -fno-sanitize=null,object-size,pointer-overflow,alignment)
    endif()
  endif()
  if(PENUMBRA_SANITIZE MATCHES "thread")
    # oneTBB is not instrumented and reports races of its own: a std::thread back end instead.
    target_compile_definitions(penumbra_options INTERFACE PENUMBRA_STD_THREADS)
  endif()
endif()

add_library(penumbra_warnings INTERFACE)
target_compile_options(penumbra_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual -Wold-style-cast $<$<BOOL:${PENUMBRA_WERROR}>:-Werror>)
if(CMAKE_UNITY_BUILD)
  # Files that are compiled as one are headers to the compiler, which warns of classes there whose members have types of
  # an anonymous namespace.
  target_compile_options(penumbra_warnings INTERFACE -Wno-subobject-linkage)
endif()

# penumbra_library(NAME [LIBS...]): the static library penumbra_NAME from the sources of this folder and of its rooms,
# which are those of its folders that have no CMakeLists.txt of their own.
function(penumbra_library name)
  file(GLOB rooms CONFIGURE_DEPENDS LIST_DIRECTORIES true "${CMAKE_CURRENT_SOURCE_DIR}/*")
  list(PREPEND rooms "${CMAKE_CURRENT_SOURCE_DIR}")
  set(sources)
  foreach(room IN LISTS rooms)
    if(IS_DIRECTORY "${room}" AND (room STREQUAL CMAKE_CURRENT_SOURCE_DIR OR NOT EXISTS "${room}/CMakeLists.txt"))
      file(GLOB of_room CONFIGURE_DEPENDS "${room}/*.cpp" "${room}/*.h")
      list(APPEND sources ${of_room})
    endif()
  endforeach()
  if(NOT sources)
    message(FATAL_ERROR "no sources in ${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  add_library(penumbra_${name} STATIC ${sources})
  set_target_properties(penumbra_${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(penumbra_${name} PUBLIC penumbra_options PRIVATE $<BUILD_INTERFACE:penumbra_warnings>)
  target_link_libraries(penumbra_${name} PUBLIC ${ARGN})
endfunction()

# penumbra_embed(TARGET FOLDER ENDINGS HEADER FUNCTION): the files of a folder travel inside the target. ENDINGS are
# separated by commas. The header declares the function that returns the files.
function(penumbra_embed target folder endings header function)
  get_filename_component(name "${header}" NAME_WE)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  string(REPLACE "," ";" list "${endings}")
  list(TRANSFORM list PREPEND "${folder}/*.")
  file(GLOB files CONFIGURE_DEPENDS ${list})
  set(script "${PROJECT_SOURCE_DIR}/cmake/EmbedFiles.cmake")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" -D "FOLDER=${folder}" -D "ENDINGS=${endings}" -D "HEADER=${header}"
            -D "FUNCTION=${function}" -D "OUTPUT=${output}" -P "${script}"
    DEPENDS ${files} "${script}"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
