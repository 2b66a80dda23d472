#include "incognita/decision/route.hpp"

#include <algorithm>
#include <utility>

#include "incognita/decision/approach.hpp"

namespace incognita {
namespace {

constexpr int patience_in_space = 12, patience_driving = 25;  // a vehicle may have to turn round first

}  // namespace

Route::Route(const Mobility& mobility)
    : reach_m_(reach_m(mobility)),
      ahead_m_(aim_ahead_m(mobility)),
      patience_(mobility.drives ? patience_driving : patience_in_space) {}

void Route::start(std::vector<Eigen::Vector3d> points, std::size_t first, const Eigen::Vector3d& from) {
  points_ = std::move(points);
  to_ = first;
  from_ = from;
  most_m_ = 0;
  stalled_ = 0;
}

double Route::length_m() const { return (points_[to_] - from_).norm(); }

double Route::progress_m(const Eigen::Vector3d& position) const {
  const double length = length_m();
  return length > 0 ? (position - from_).dot(points_[to_] - from_) / length : 0;
}

void Route::begin_leg(const Eigen::Vector3d& from) {
  to_ = (to_ + 1) % points_.size();
  from_ = from;
  most_m_ = 0;
  stalled_ = 0;
}

Eigen::Vector3d Route::next(const Eigen::Vector3d& position) {
  for (std::size_t i = 0; i < points_.size() && progress_m(position) >= length_m() - reach_m_; ++i)
    begin_leg(Eigen::Vector3d(points_[to_]));
  constexpr double counts_m = 0.01;
  if (progress_m(position) > most_m_ + counts_m)
    most_m_ = progress_m(position), stalled_ = 0;
  else if (++stalled_ > patience_)
    begin_leg(position);
  const double length = length_m();
  if (!(length > 0)) return points_[to_];
  const double aimed = std::clamp(progress_m(position) + ahead_m_, 0.0, length);
  return from_ + aimed / length * (points_[to_] - from_);
}

}  // namespace incognita
