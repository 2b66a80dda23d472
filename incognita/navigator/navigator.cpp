#include "incognita/navigator/navigator.hpp"

#include <algorithm>
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

BodyObservation& Navigator::pending(std::size_t body, double t) {
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
  pending(body, t).odometry.push_back({t, input});
}

void Navigator::add_fix(const Eigen::Vector2d& position, double t, std::size_t body) {
  pending(body, t).fixes.push_back({t, position});
}

const TrackingStatus& Navigator::add_image(const ImageView& image, double t, std::size_t body,
                                           std::size_t camera) {
  BodyObservation& observed = pending(body, t);
  if (observed.images.size() <= camera) observed.images.resize(camera + 1);
  observed.images[camera] = copy_of(image);
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
  Observation observation;
  observation.bodies.resize(pending_.bodies.size());
  observation.bodies.swap(pending_.bodies);
  estimator_.update(estimate_, command_, observation, tick);
  tick_ = tick;
  return estimate_.status;
}

BodyPose Navigator::pose(std::size_t body) const {
  if (!estimate_.started) throw std::logic_error("no pose yet: " + estimate_.status.reason);
  const Body& b = estimate_.bodies.at(body);
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
