#include "incognita/io/recordings/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "incognita/io/formats/image_file.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr double furthest_s = 0.02;

Truth as_truth(const std::vector<RecordedPose>& poses, std::size_t i) {
  const RecordedPose& here = poses[i];
  Truth truth;
  BodyTruth& body = truth.bodies.emplace_back();
  body.pose = RigidPose{here.position, here.world_from_camera};
  body.state = SmallVector::Zero(FreeCameraMotion::state_size);
  body.state.head<7>() << here.position, here.world_from_camera;
  const RecordedPose& before = poses[i > 0 ? i - 1 : i];
  const RecordedPose& after = poses[i + 1 < poses.size() ? i + 1 : i];
  const double dt = after.t - before.t;
  if (!(dt > 0)) return truth;
  const Eigen::Vector4d turned = quaternion_product<double>(
      quaternion_conjugate<double>(before.world_from_camera), after.world_from_camera);
  body.state.segment<3>(7) = (after.position - before.position) / dt;
  body.state.segment<3>(10) = quaternion_log<double>(turned) / dt;
  return truth;
}

}  // namespace

RecordedClock::RecordedClock(SharedRecording recording, double duration_s)
    : recording_(std::move(recording)) {
  const double until = recording_->frames.front().t + duration_s;
  for (const Recording::RecordedFrame& frame : recording_->frames) {
    if (frame.t < until) ++frames_;  // as with FixedRateClock: rate x duration frames
  }
}

Tick RecordedClock::next() {
  if (done_ >= frames_) return {};
  const auto k = static_cast<std::size_t>(done_);
  const double t = recording_->frames[k].t;
  const double dt = k == 0 ? 0 : t - recording_->frames[k - 1].t;
  return {done_++, t, dt};
}

RecordedSensor::RecordedSensor(SharedRecording recording, int width_px, int height_px)
    : recording_(std::move(recording)), width_px_(width_px), height_px_(height_px) {
  try {
    first_ = read(0);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());  // before the start, this is an invalid input
  }
}

Observation RecordedSensor::measure(const std::optional<Truth>&, const Tick& tick) {
  Observation observation;
  observation.bodies.emplace_back().images = {tick.frame == 0 ? first_ : read(tick.frame)};
  return observation;
}

std::shared_ptr<const Image> RecordedSensor::read(std::int64_t frame) const {
  const auto count = static_cast<std::int64_t>(recording_->frames.size());
  if (frame < 0 || frame >= count) {
    throw RecordError(fmt::format("{}: frame {} requested, the recording has {}", recording_->folder.string(),
                                  frame, count));
  }
  const std::filesystem::path& file = recording_->frames[static_cast<std::size_t>(frame)].image;
  std::shared_ptr<const Image> image;
  try {
    image = std::make_shared<const Image>(read_image(file));
  } catch (const std::runtime_error& error) {
    throw RecordError(fmt::format(
        "frame {} of {} cannot be read; replace the file or end before it with run.duration_s: {}", frame,
        count, error.what()));
  }
  if (image->width() != width_px_ || image->height() != height_px_) {
    throw RecordError(
        fmt::format("{}: frame {} is {}x{} px, camera.width_px and camera.height_px expect {}x{}",
                    file.string(), frame, image->width(), image->height(), width_px_, height_px_));
  }
  return image;
}

std::optional<Truth> RecordedWorld::move(const Command&, const Tick& tick) {
  const std::vector<RecordedPose>& poses = recording_->truth;
  if (poses.empty()) return std::nullopt;
  const auto after = std::lower_bound(poses.begin(), poses.end(), tick.t,
                                      [](const RecordedPose& pose, double t) { return pose.t < t; });
  auto nearest = after == poses.end() ? after - 1 : after;
  if (after != poses.begin() && after != poses.end() && tick.t - (after - 1)->t < after->t - tick.t)
    nearest = after - 1;
  if (std::abs(nearest->t - tick.t) > furthest_s) return std::nullopt;
  return as_truth(poses, static_cast<std::size_t>(nearest - poses.begin()));
}

}  // namespace incognita
