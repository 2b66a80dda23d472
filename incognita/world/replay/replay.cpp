#include "incognita/world/replay/replay.hpp"

namespace incognita {

Tick ReplayClock::next() {
  if (done_ >= times_.size()) return {};
  const std::size_t k = done_++;
  const double dt = k == 0 ? 0 : duration_s(times_[k - 1], times_[k], whole_us_);
  return {static_cast<std::int64_t>(k), times_[k], dt, whole_us_};
}

std::optional<Truth> ReplayWorld::move(const Command&, const Tick& tick) {
  Truth truth;
  bool any_known = false;
  for (const RecordedTruth& body : truth_) {
    const std::optional<BodyTruth> known = body(tick.t);
    any_known |= known.has_value();
    truth.bodies.push_back(known.value_or(BodyTruth{}));
  }
  return any_known ? std::optional(std::move(truth)) : std::nullopt;
}

}  // namespace incognita
