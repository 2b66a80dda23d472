#include "incognita/app/loop/recovery_turn.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita {
namespace {

constexpr double most_recovery_rad = 2 * 2 * std::numbers::pi;

}  // namespace

RecoveryTurn::RecoveryTurn(const RecoveryTurnSettings& settings) : settings_(settings) {
  const auto is_usable = [](double value) { return value >= 0 && std::isfinite(value); };
  if (!is_usable(settings.rate_rad_s) || !is_usable(settings.after_s))
    throw std::invalid_argument("rate and delay of the recovery turn must be 0 or more, and finite");
}

void RecoveryTurn::drove(double turn_rate_rad_s) {
  if (turn_rate_rad_s != 0) direction_ = turn_rate_rad_s > 0 ? -1 : 1;
  lost_s_ = 0;
}

double RecoveryTurn::rate(double dt_s) {
  lost_s_ += dt_s;
  const double turning_s = lost_s_ - settings_.after_s;
  const bool turns = turning_s > 0 && settings_.rate_rad_s * turning_s <= most_recovery_rad;
  return turns ? direction_ * settings_.rate_rad_s : 0;
}

void RecoveryTurn::state(StateArchive& archive) {
  archive(direction_);
  if (!archive.restores()) return;
  direction_ = direction_ < 0 ? -1 : 1;
  lost_s_ = 0;
}

}  // namespace incognita
