// apps/mpi_processes.h
//
// The processes that `mpirun -np N penumbra ...` has started, as a ProcessGroup, if the program was built
// with MPI.

#pragma once

namespace penumbra {

// Joins the processes that mpirun has started (JoinProcesses), and leaves them at its end. Does nothing if
// the program was not started by mpirun, or was built without MPI. The first process writes all output; the
// standard output and error of the others go nowhere. Must be a local variable of main().
class MpiSession {
 public:
  MpiSession(int* argc, char*** argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  // Says that this process ends with the exit status `status`. If `status` is not 0 and the other processes
  // do not end, too, Finish() ends them, because they wait for this process.
  void Finish(int status);

 private:
  bool joined_ = false;
  bool finished_ = false;
};

}  // namespace penumbra
