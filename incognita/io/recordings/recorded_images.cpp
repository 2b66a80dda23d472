#include "incognita/io/recordings/recorded_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr double furthest_s = 0.02;

BodyTruth as_truth(const std::vector<RecordedPose>& poses, std::size_t i) {
  const RecordedPose& here = poses[i];
  BodyTruth body;
  body.pose = RigidPose{here.position, here.world_from_camera};
  body.state = SmallVector::Zero(FreeCameraMotion::state_size);
  body.state.head<7>() << here.position, here.world_from_camera;
  const RecordedPose& before = poses[i > 0 ? i - 1 : i];
  const RecordedPose& after = poses[i + 1 < poses.size() ? i + 1 : i];
  const double dt = after.t - before.t;
  if (!(dt > 0)) return body;
  const Eigen::Vector4d turned = quaternion_product<double>(
      quaternion_conjugate<double>(before.world_from_camera), after.world_from_camera);
  body.state.segment<3>(7) = (after.position - before.position) / dt;
  body.state.segment<3>(10) = quaternion_log<double>(turned) / dt;
  return body;
}

}  // namespace

std::vector<double> frame_times(const Recording& recording, double duration_s) {
  const double start = recording.frames.front().t;
  std::vector<double> times;
  for (const Recording::RecordedFrame& frame : recording.frames)
    if (incognita::duration_s(start, frame.t, recording.whole_us) < duration_s)
      times.push_back(frame.t);  // as with FixedRateClock: rate x duration frames
  return times;
}

RecordedImages::RecordedImages(SharedRecording recording, int width_px, int height_px)
    : recording_(std::move(recording)), width_px_(width_px), height_px_(height_px) {
  try {
    first_ = read(0);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());  // before the start, this is an invalid input
  }
}

void RecordedImages::measure(const std::optional<Truth>&, std::size_t, const Tick& tick,
                             BodyObservation& observation) {
  observation.images.push_back(tick.frame == 0 ? first_ : read(tick.frame));
}

std::shared_ptr<const Image> RecordedImages::read(std::int64_t frame) const {
  const auto count = static_cast<std::int64_t>(recording_->frames.size());
  if (frame < 0 || frame >= count) {
    throw RecordError(fmt::format("{}: frame {} requested, the recording has {}", recording_->folder.string(),
                                  frame, count));
  }
  const auto which = static_cast<std::size_t>(frame);
  std::shared_ptr<const Image> image;
  try {
    image = recording_->images->read(which);
  } catch (const std::runtime_error& error) {
    throw RecordError(fmt::format(
        "frame {} of {} cannot be read; replace the file or end before it with run.duration_s: {}", frame,
        count, error.what()));
  }
  if (image->width() != width_px_ || image->height() != height_px_) {
    const std::filesystem::path& of_its_own = recording_->frames[which].image;
    const std::filesystem::path& file = of_its_own.empty() ? recording_->folder : of_its_own;
    throw RecordError(
        fmt::format("{}: frame {} is {}x{} px, camera.width_px and camera.height_px expect {}x{}",
                    file.string(), frame, image->width(), image->height(), width_px_, height_px_));
  }
  return image;
}

RecordedTruth recorded_truth(SharedRecording recording) {
  return [recording = std::move(recording)](double t) -> std::optional<BodyTruth> {
    const std::vector<RecordedPose>& poses = recording->truth;
    if (poses.empty()) return std::nullopt;
    const auto after = std::lower_bound(poses.begin(), poses.end(), t,
                                        [](const RecordedPose& pose, double at) { return pose.t < at; });
    auto nearest = after == poses.end() ? after - 1 : after;
    if (after != poses.begin() && after != poses.end() && t - (after - 1)->t < after->t - t)
      nearest = after - 1;
    if (std::abs(nearest->t - t) > furthest_s) return std::nullopt;
    return as_truth(poses, static_cast<std::size_t>(nearest - poses.begin()));
  };
}

}  // namespace incognita
