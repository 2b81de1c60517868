# Runs the program by one, two and three processes, and compares what they write, byte by byte.
#
#   cmake -D PROGRAM=penumbra -D MPIRUN=mpirun -D SCRATCH=folder -P tests/mpi_test.cmake

cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
file(WRITE "${SCRATCH}/points.csv"
     "x,y,z,nx,ny,nz\n0.1,0.1,0,0,0,1\n0.3,0.2,0,0,0,1\n0.2,0.4,0.1,0,0,1\n0.5,0.5,0.2,0,1,0\n")
# As root in a container, and with more processes than processors.
set(mpirun "${CMAKE_COMMAND}" -E env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "${MPIRUN}"
    --oversubscribe)

# run(N ARGUMENTS...): runs the program by N processes.
function(run count)
  if(count EQUAL 1)
    set(start "${PROGRAM}")
  else()
    set(start ${mpirun} -np ${count} "${PROGRAM}")
  endif()
  execute_process(COMMAND ${start} ${ARGN} WORKING_DIRECTORY "${SCRATCH}" INPUT_FILE points.csv
                  OUTPUT_FILE out-${count} ERROR_FILE err-${count} RESULT_VARIABLE status)
  set(status ${status} PARENT_SCOPE)
endfunction()

# same(NAME FILE ARGUMENTS...): what the processes write to the file, or to standard output if FILE is empty.
function(same name written)
  foreach(count 1 2 3)
    run(${count} ${ARGN})
    if(NOT status EQUAL 0)
      file(READ "${SCRATCH}/err-${count}" error)
      message(FATAL_ERROR "${name} by ${count} processes: ${status}\n${error}")
    endif()
    if(written)
      file(SHA256 "${SCRATCH}/${written}" digest)
    else()
      file(SHA256 "${SCRATCH}/out-${count}" digest)
    endif()
    if(count EQUAL 1)
      set(first "${digest}")
    elseif(NOT digest STREQUAL first)
      message(FATAL_ERROR "${name}: ${count} processes write other bytes than one")
    endif()
  endforeach()
  message(STATUS "${name}: the same bytes by 1, 2 and 3 processes")
endfunction()

same("solve" light.h5 solve cornell --error 0.1 -o light.h5)
same("solve by sampling" sampled.h5 solve cornell --error 0.2 --solver sampled -o sampled.h5)
same("probe" "" probe light.h5 --points -)
same("probe of a scene" "" probe floating-cube --error 0.2 --points points.csv)
same("matrix" factors.csv form-factor floating-cube --all --tolerance 1e-4 -o factors.csv)
same("picture" picture.png render light.h5 --size 64x48 -o picture.png)

# Errors are told once, and end all processes.
run(2 solve no-such-scene)
file(READ "${SCRATCH}/err-2" error)
string(REGEX MATCHALL "no-such-scene" told "${error}")
list(LENGTH told times)
if(status EQUAL 0 OR NOT times EQUAL 1)
  message(FATAL_ERROR "an error was told ${times} times, status ${status}:\n${error}")
endif()
run(2 solve cornell --time-limit 1)
if(status EQUAL 0)
  message(FATAL_ERROR "a limit of time for two processes was not refused")
endif()
