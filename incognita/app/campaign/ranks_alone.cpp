// Implementation without MPI.
#include "incognita/app/campaign/ranks.hpp"
#include "incognita/app/campaign/started_by_mpirun.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

Ranks::Ranks() {
  if (started_by_mpirun())
    throw InputError(
        "campaign: mpirun started several of this program, which was built without MPI. Install "
        "libopenmpi-dev and "
        "build again, or give each its share with --shard i/N");
}

Ranks::~Ranks() = default;

void Ranks::send(int, int, const std::string&) {}

std::optional<Ranks::Message> Ranks::receive() { return std::nullopt; }

}  // namespace incognita
