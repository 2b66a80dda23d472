// The state of replayed recordings: how far they were read.
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/world/replay/recorded_ranges.hpp"

namespace incognita {

void ReplayClock::state(StateArchive& archive) {
  auto& [times, whole_us, done] = *this;
  archive(done);
  if (done > times.size())
    throw DamagedState("tick " + std::to_string(done) + " of a recording of " + std::to_string(times.size()));
}

void RecordedRanges::state(StateArchive& archive) {
  auto& [recordings, recording, settings, odometry, fixes, scans, fix_given] = *this;
  archive(odometry, fixes, scans, fix_given);
  const bool fits = odometry <= recording->odometry.size() && fixes <= recording->fixes.size() &&
                    scans <= recording->scans.size();
  if (!fits) throw DamagedState("the state of a longer recording");
}

}  // namespace incognita
