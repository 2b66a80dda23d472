// Implementation without MPI.
#include "incognita/app/campaign/ranks.hpp"
#include "incognita/app/campaign/started_by_mpirun.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

Ranks::Ranks() {
  if (started_by_mpirun())
    throw InputError(
        "campaign: mpirun started several processes, but this program was built without MPI. Install libopenmpi-dev and build again, or start each process with --shard i/N");
}

Ranks::~Ranks() = default;

void Ranks::send(int, int, const std::string&) {}

std::optional<Ranks::Message> Ranks::receive() { return std::nullopt; }

}  // namespace incognita
