#include "incognita/math/saved_state/state_archive.hpp"

#include "incognita/math/saved_state/saved_part.hpp"

namespace incognita {

void SavedPart::state(StateArchive&) {
  throw CannotBeSaved("its class does not override SavedPart::state()");
}

void StateReader::need(std::uint64_t count, std::size_t bytes_each) const {
  if (count <= left() / bytes_each) return;
  throw DamagedState(std::to_string(count) + (bytes_each > 1 ? " numbers" : " bytes") +
                     " are announced, and " + std::to_string(left()) + " bytes are left");
}

void StateArchive::expect_size(std::size_t size, const char* what) {
  std::uint64_t saved = size;
  (*this)(saved);
  if (saved != size)
    throw DamagedState(std::to_string(saved) + " " + what + " were saved, and this run has " +
                       std::to_string(size));
}

}  // namespace incognita
