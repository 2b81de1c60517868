#include "apps/mpi_processes.h"

#ifdef PENUMBRA_MPI

#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "solver/base/processes.h"

namespace penumbra {
namespace {

// Counts of MPI are ints.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;

class MpiGroup final : public ProcessGroup {
 public:
  MpiGroup() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  int Rank() const override { return rank_; }
  int Size() const override { return size_; }

  std::vector<std::string> Exchange(const std::string& own) const override {
    std::vector<std::uint64_t> length(static_cast<std::size_t>(size_));
    const std::uint64_t own_length = own.size();
    MPI_Allgather(&own_length, 1, MPI_UINT64_T, length.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    std::vector<std::string> sent(length.size());
    for (int from = 0; from < size_; ++from) {
      std::string& bytes = sent[static_cast<std::size_t>(from)];
      bytes = from == rank_ ? own : std::string(length[static_cast<std::size_t>(from)], '\0');
      for (std::size_t begin = 0; begin < bytes.size(); begin += kMostAtOnce)
        MPI_Bcast(bytes.data() + begin, static_cast<int>(std::min(kMostAtOnce, bytes.size() - begin)),
                  MPI_BYTE, from, MPI_COMM_WORLD);
    }
    return sent;
  }

 private:
  int rank_ = 0, size_ = 1;
};

// True if a launcher of Open MPI, MPICH or Slurm has started several processes. Beginning MPI takes a quarter
// of a second, which a single process should not pay.
bool IsOneOfMany() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_NTASKS"}) {
    const char* const size = std::getenv(name);
    if (size && std::atoi(size) > 1) return true;
  }
  return false;
}

void Silence(int stream) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, stream);
  close(nowhere);
}

}  // namespace

MpiSession::MpiSession(int* argc, char*** argv) {
  if (!IsOneOfMany()) return;
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &provided);
  joined_ = true;
  const auto group = std::make_shared<const MpiGroup>();
  if (group->Rank() > 0) {
    Silence(STDOUT_FILENO);
    Silence(STDERR_FILENO);
  }
  if (group->Size() > 1) JoinProcesses(group);
}

MpiSession::~MpiSession() {
  if (!joined_) return;
  if (!finished_) MPI_Abort(MPI_COMM_WORLD, 1);
  JoinProcesses(nullptr);
  MPI_Finalize();
}

void MpiSession::Finish(int status) {
  finished_ = true;
  if (!joined_) return;
  constexpr std::chrono::seconds kPatience{10};
  constexpr std::chrono::milliseconds kPause{1};
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  const auto begun = std::chrono::steady_clock::now();
  for (int all_here = 0;;) {
    MPI_Test(&request, &all_here, MPI_STATUS_IGNORE);
    if (all_here != 0) return;
    if (status != 0 && std::chrono::steady_clock::now() - begun > kPatience)
      MPI_Abort(MPI_COMM_WORLD, status);
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace penumbra

#else

namespace penumbra {

MpiSession::MpiSession(int*, char***) {}
MpiSession::~MpiSession() = default;
void MpiSession::Finish(int) { finished_ = true; }

}  // namespace penumbra

#endif
