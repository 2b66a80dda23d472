#include "incognita/navigator/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace incognita {
namespace {

std::shared_ptr<const Image> copy_of(const ImageView& view) {
  if (!view.pixels || view.width <= 0 || view.height <= 0 || view.stride < view.width)
    throw std::invalid_argument("image view of " + std::to_string(view.width) + "x" +
                                std::to_string(view.height) + " pixels with a stride of " +
                                std::to_string(view.stride) +
                                " bytes: pixels are wanted, and a stride of at least the width");
  auto image = std::make_shared<Image>(view.width, view.height);
  for (int v = 0; v < view.height; ++v) std::copy_n(view.pixels + v * view.stride, view.width, image->row(v));
  return image;
}

}  // namespace

Navigator::Navigator(SlamEstimator estimator) : estimator_(std::move(estimator)) {
  pending_.bodies.resize(estimator_.settings().bodies.size());
}

namespace {

[[noreturn]] void refuse(std::size_t body, const std::string& why) {
  throw std::invalid_argument("body " + std::to_string(body) + ": " + why);
}

/// Readings until the time, which are removed from the list.
template <class Reading>
std::vector<Reading> taken_until(std::vector<Reading>& readings, double t) {
  const auto later = std::ranges::find_if(readings, [&](const Reading& reading) { return reading.t > t; });
  std::vector<Reading> taken(readings.begin(), later);
  readings.erase(readings.begin(), later);
  return taken;
}

template <class Reading>
void add_in_order(std::vector<Reading>& readings, Reading reading, std::size_t body) {
  if (!readings.empty() && reading.t < readings.back().t)
    refuse(body, "a reading at t = " + std::to_string(reading.t) + " s after one at " +
                     std::to_string(readings.back().t) + " s; add readings in time order");
  readings.push_back(std::move(reading));
}

}  // namespace

BodyObservation& Navigator::pending(std::size_t body, double t) {
  if (!std::isfinite(t))
    refuse(body, "a measurement at t = " + std::to_string(t) + ": a time in s is needed");
  if (body >= pending_.bodies.size())
    throw std::invalid_argument("a measurement of body " + std::to_string(body) + ": there are " +
                                std::to_string(pending_.bodies.size()) + ", counted from 0");
  if (tick_ && t < tick_.t)
    throw std::invalid_argument("a measurement at t = " + std::to_string(t) +
                                " s: the estimate is already at " + std::to_string(tick_.t) +
                                " s; add measurements in time order");
  return pending_.bodies[body];
}

void Navigator::add_odometry(const Eigen::Vector2d& input, double t, std::size_t body) {
  BodyObservation& observed = pending(body, t);
  const BodyModel& model = estimator_.settings().bodies[body];
  const bool in_space = traits_of(model.motion).in_space();
  if (in_space ? !model.wheels : model.input == BodyModel::Input::commanded)
    refuse(body, in_space
                     ? "it moves in space and has no wheels (BodyModel::wheels) that odometry could measure"
                     : "it is predicted by its commands (BodyModel::Input::commanded), and not by odometry");
  add_in_order(observed.odometry, {t, input}, body);
}

void Navigator::add_fix(const Eigen::Vector2d& position, double t, std::size_t body) {
  BodyObservation& observed = pending(body, t);
  const BodyModel& model = estimator_.settings().bodies[body];
  if (!(model.sigma_fix_m > 0) && model.start_time != BodyModel::StartTime::first_fix)
    refuse(body, "a position fix needs its sigma, BodyModel::sigma_fix_m");
  add_in_order(observed.fixes, {t, position}, body);
}

const TrackingStatus& Navigator::add_image(const ImageView& image, double t, std::size_t body,
                                           std::size_t camera) {
  BodyObservation& observed = pending(body, t);
  auto copy = copy_of(image);
  const auto cameras = static_cast<std::size_t>(std::ranges::count_if(
      estimator_.cameras(), [&](const FeatureTracker& own) { return own.camera().body == body; }));
  if (camera >= cameras)
    refuse(body, "an image of camera " + std::to_string(camera) + ": there are " + std::to_string(cameras) +
                     ", counted from 0");
  observed.images.resize(cameras);
  observed.images[camera] = std::move(copy);
  return advance(t);
}

const TrackingStatus& Navigator::add_detections(std::vector<PointDetection> landmarks, double t,
                                                std::size_t body, std::vector<PointDetection> bodies) {
  BodyObservation& observed = pending(body, t);
  observed.landmarks = std::move(landmarks);
  observed.vehicles = std::move(bodies);
  return advance(t);
}

const TrackingStatus& Navigator::advance(double t) {
  pending(0, t);
  const Tick tick{tick_.frame + 1, t, tick_ ? t - tick_.t : 0};
  Observation before = pending_, observation;
  for (BodyObservation& later : pending_.bodies) {
    BodyObservation& now = observation.bodies.emplace_back();
    now.odometry = taken_until(later.odometry, t);
    now.fixes = taken_until(later.fixes, t);
    now.images = std::exchange(later.images, {});
    now.landmarks = std::exchange(later.landmarks, {});
    now.vehicles = std::exchange(later.vehicles, {});
  }
  try {
    estimator_.update(estimate_, command_, observation, tick);
  } catch (const std::invalid_argument&) {  // the readings are kept, and what was refused is not
    for (BodyObservation& body : before.bodies)
      body.images.clear(), body.landmarks.clear(), body.vehicles.clear();
    pending_ = std::move(before);
    throw;
  }
  tick_ = tick;
  return estimate_.status;
}

const Body& Navigator::started(std::size_t body) const {
  if (!estimate_.started) throw std::logic_error("no pose yet: " + estimate_.status.reason);
  return estimate_.bodies.at(body);
}

BodyPose Navigator::pose(std::size_t body) const {
  const Body& b = started(body);
  return {b.pose, b.pose_covariance};
}

std::vector<MappedLandmark> Navigator::landmarks() const {
  std::vector<MappedLandmark> out;
  for (const auto& [id, landmark] : estimate_.landmarks) {
    const auto at = position_of(landmark, estimate_);
    if (!at) continue;
    MappedLandmark& mapped = out.emplace_back();
    mapped.id = id;
    mapped.anchor = landmark.fixed;
    const Eigen::Index size = at->position.size();
    mapped.position.head(size) = at->position;
    mapped.covariance.topLeftCorner(size, size) = at->covariance;
  }
  return out;
}

Goal Navigator::choose(Strategy& strategy) const { return strategy.choose(estimate_, pending_, tick_); }

}  // namespace incognita
