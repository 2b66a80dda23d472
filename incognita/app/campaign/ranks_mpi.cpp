// Implementation with MPI.
#include <mpi.h>

#include "incognita/app/campaign/ranks.hpp"
#include "incognita/app/campaign/started_by_mpirun.hpp"

namespace incognita {

// A single process does not call MPI_Init, which would start a daemon and take half a second.
Ranks::Ranks() {
  if (!started_by_mpirun()) return;
  MPI_Init(nullptr, nullptr);
  joined_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  if (joined_) MPI_Finalize();
}

void Ranks::send(int to, int kind, const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, kind, MPI_COMM_WORLD);
}

std::optional<Ranks::Message> Ranks::receive() {
  if (!joined_) return std::nullopt;
  int there = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (!there) return std::nullopt;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.text.data(), size, MPI_CHAR, message.from, message.kind, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

}  // namespace incognita
