#include "incognita/control/person.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>

namespace incognita {
namespace {

/// The six ways of a person, by one of them: itself, its opposite, and those across it.
std::array<Eigen::Vector3d, 6> ways_beside(const Eigen::Vector3d& way) {
  const bool vertical = std::abs(way.z()) > way.head<2>().norm();
  const Eigen::Vector3d reference = vertical ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d a = way.norm() * way.cross(reference).normalized(),
                        b = way.norm() * way.cross(a).normalized();
  return {way, -way, a, -a, b, -b};
}

}  // namespace

Person::Person(const PersonSettings& settings, std::uint64_t seed, const std::string& name)
    : settings_(settings), random_(seed, name) {
  if (!(settings_.delay_s >= 0 && settings_.wrong >= 0 && settings_.wrong <= 1 &&
        settings_.sigma_way_ratio >= 0))
    throw std::invalid_argument(
        "a person's delay and spread must not be negative, and errs from never, 0, "
        "to always, 1");
}

/// Three numbers are drawn whatever comes of it, so that persons who err more draw the same.
Eigen::Vector3d Person::understood(const Eigen::Vector3d& way) {
  const bool wrong = random_.uniform(0, 1) < settings_.wrong;
  const int other = 1 + random_.below(5);
  const double far = std::max(0.0, 1 + settings_.sigma_way_ratio * random_.normal());
  if (way.isZero()) return way;
  return far * ways_beside(way)[wrong ? static_cast<std::size_t>(other) : 0];
}

void Person::forget() {
  seen_.clear();
  started_ = false;
}

const Way& Person::obey(const Way& shown, bool is_new, const Eigen::Vector3d& at, double t) {
  if (!started_) doing_ = {at, at, t, t};
  started_ = true;
  if (is_new) seen_.push_back(shown);
  constexpr double rounding = 1e-9;
  while (!seen_.empty() && t >= seen_.front().start_t + settings_.delay_s - rounding) {
    const Way& now = seen_.front();
    doing_ = {at, at + understood(now.to - now.from), t, t + now.end_t - now.start_t};
    seen_.pop_front();
  }
  return doing_;
}

}  // namespace incognita
