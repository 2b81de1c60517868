# The direction of dependency (thesis_notes/design.md): a library includes the libraries above it, never one below,
# what is heavy to compile stays in .cpp files, and GLM in the display. Greps the includes of the checkout, then plants violations of
# every kind in a scratch folder and demands that each is found.
#
#   cmake -D ROOT=checkout -D SCRATCH=folder -P tests/layering_test.cmake

cmake_minimum_required(VERSION 3.25)

set(LAYERS solver/base solver/geometry solver/scene
  solver/visibility/point solver/visibility/exact solver/visibility/pair solver/visibility/area
  solver/transport/links solver/transport/form_factors solver/transport/sources solver/transport/points solver/transport/solvers
  mesh/discontinuities mesh/triangulation mesh/interpolants mesh/refinement mesh/pipeline
  display apps)
set(OUTSIDE tests experiments examples python)  # may include every layer; no layer may include them
set(HEAVY "^(CGAL|assimp|embree[0-9]*|tbb|oneapi|EGL|GL|GLFW|OpenEXR|stb)/|^Imf|^imgui|^stb_|^hdf5|^H5")

set(DISPLAY_ONLY "^glm/")  # solver and mesh have Eigen's vectors

# The place of the library that `path` belongs to; -1 for none.
function(layer_of path result)
  set(index -1)
  foreach(layer IN LISTS LAYERS)
    math(EXPR index "${index} + 1")
    string(FIND "${path}" "${layer}/" at)
    if(at EQUAL 0)
      set(${result} ${index} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${result} -1 PARENT_SCOPE)
endfunction()

# A file of a folder of rooms that lies in none of them.
function(judge_place file result)
  set(${result} "" PARENT_SCOPE)
  if(file MATCHES "^(mesh|solver/transport|solver/visibility)/[^/]*$")
    set(${result} "${file} lies in no room" PARENT_SCOPE)
  endif()
endfunction()

# Everything wrong with one include: `kind` is the character that opens the name, " or <.
function(judge file kind name result)
  set(faults)
  layer_of("${file}" from)
  layer_of("${name}" to)
  if(file MATCHES "\\.h$" AND name MATCHES "${HEAVY}")
    list(APPEND faults "${file} includes ${name}: only .cpp files may")
  endif()
  if(file MATCHES "^(solver|mesh)/" AND name MATCHES "${DISPLAY_ONLY}")
    list(APPEND faults "${file} includes ${name}: only the display may")
  endif()
  if(NOT from EQUAL -1 AND kind STREQUAL "\"")
    if(to EQUAL -1)
      list(APPEND faults "${file} includes ${name}: not the path of a library's header, from the root")
    elseif(to GREATER from)
      list(APPEND faults "${file} includes ${name}: a library below it")
    endif()
  endif()
  set(${result} "${faults}" PARENT_SCOPE)
endfunction()

# The faults of all includes below `root`, and how many includes there are.
function(judge_tree root faults_result count_result)
  set(all)
  set(count 0)
  foreach(folder solver mesh display apps ${OUTSIDE})
    file(GLOB_RECURSE files RELATIVE "${root}" "${root}/${folder}/*.h" "${root}/${folder}/*.cpp")
    foreach(file IN LISTS files)
      judge_place("${file}" faults)
      list(APPEND all ${faults})
      file(STRINGS "${root}/${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
      foreach(line IN LISTS lines)
        if(NOT line MATCHES "include[ \t]*([<\"])([^>\"]+)[>\"]")
          continue()
        endif()
        math(EXPR count "${count} + 1")
        judge("${file}" "${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}" faults)
        list(APPEND all ${faults})
      endforeach()
    endforeach()
  endforeach()
  set(${faults_result} "${all}" PARENT_SCOPE)
  set(${count_result} ${count} PARENT_SCOPE)
endfunction()

# Plants one file with one include and demands that many faults.
function(expect_faults expected file include)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(WRITE "${SCRATCH}/${file}" "#pragma once\n#include ${include}\n")
  judge_tree("${SCRATCH}" faults count)
  list(LENGTH faults found)
  if(NOT found EQUAL expected)
    message(SEND_ERROR "planted ${include} in ${file}: ${found} faults found, not ${expected}")
  endif()
endfunction()

judge_tree("${ROOT}" faults count)
foreach(fault IN LISTS faults)
  message(SEND_ERROR "${fault}")
endforeach()
if(count EQUAL 0)
  message(SEND_ERROR "no includes found below ${ROOT}")
endif()

expect_faults(1 solver/base/planted.cpp "\"solver/geometry/vec.h\"")
expect_faults(1 solver/visibility/pair/planted.h "\"solver/transport/links/link.h\"")
expect_faults(1 solver/visibility/point/planted.h "\"solver/visibility/pair/tube.h\"")
expect_faults(1 solver/transport/links/planted.cpp "\"mesh/interpolants/irradiance_mesh.h\"")
expect_faults(1 mesh/discontinuities/planted.cpp "\"mesh/refinement/shown_mesh.h\"")
expect_faults(1 mesh/pipeline/planted.cpp "\"display/image.h\"")
expect_faults(1 mesh/planted.cpp "<vector>")
expect_faults(1 solver/transport/planted.h "<vector>")
expect_faults(1 display/viewer/planted.cpp "\"apps/options.h\"")
expect_faults(1 mesh/pipeline/planted.cpp "\"tests/fixture.h\"")
expect_faults(1 mesh/pipeline/planted.cpp "\"irradiance_mesh.h\"")
expect_faults(1 mesh/pipeline/planted.h "<CGAL/Constrained_Delaunay_triangulation_2.h>")
expect_faults(1 solver/visibility/point/planted.h "<embree3/rtcore.h>")
expect_faults(1 solver/base/planted.h "<tbb/parallel_for.h>")
expect_faults(1 display/planted.h "<OpenEXR/ImfRgbaFile.h>")
expect_faults(1 mesh/pipeline/planted.h "<hdf5.h>")
expect_faults(1 display/planted.h "<stb_image_write.h>")
expect_faults(1 display/viewer/planted.h "<GLFW/glfw3.h>")
expect_faults(1 tests/display/planted.h "<imgui.h>")
expect_faults(1 solver/geometry/planted.h "<glm/vec3.hpp>")
expect_faults(1 mesh/interpolants/planted.cpp "<glm/glm.hpp>")
expect_faults(0 display/planted.h "<glm/vec3.hpp>")
expect_faults(0 mesh/pipeline/planted.cpp "<CGAL/Constrained_Delaunay_triangulation_2.h>")
expect_faults(0 display/planted.h "\"mesh/interpolants/irradiance_mesh.h\"")
expect_faults(0 mesh/pipeline/planted.h "\"mesh/discontinuities/dset.h\"")
expect_faults(0 tests/mesh/planted.cpp "\"display/image.h\"")
file(REMOVE_RECURSE "${SCRATCH}")
message(STATUS "${count} includes looked at")
