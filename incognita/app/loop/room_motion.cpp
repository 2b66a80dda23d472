#include "incognita/app/loop/room_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "incognita/io/scenario/located.hpp"
#include "incognita/io/scenario/scenario_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/record/files/tum.hpp"
#include "incognita/world/rendered/place_motion.hpp"

namespace incognita {
namespace {

constexpr double shortest_s =
    1e-3;  // between samples: nearer ones are duplicates, and their velocity would be noise
constexpr double longest_gap_s = 0.5;
constexpr double placed_every_s = 0.02, margin_m = 0.01;  // between these times the way is nearly straight

[[noreturn]] void refuse(const LoadedScenario& loaded, const char* key, const std::string& why) {
  throw InputError(located(loaded, UnfitSetting({key}, why)));
}

/// world_from_camera from the axes of the file.
Eigen::Vector4d camera_axes(const Scenario& s, const Eigen::Vector4d& orientation) {
  const auto* body = std::get_if<BodyAxes>(&std::get<TrajectoryMotion>(s.true_motion.type).axes);
  if (!body) return orientation;
  return quaternion_product<double>(orientation, quaternion_exp<double>(body->body_from_camera_rad));
}

/// The poses of the file with times that increase.
std::vector<TimedPose> samples_of(const LoadedScenario& loaded, const std::filesystem::path& file,
                                  RoomMotion& out) {
  const Trajectory trajectory = read_trajectory(file);
  std::vector<TimedPose> samples;
  std::size_t duplicates = 0;
  for (const StampedPose& pose : trajectory) {
    if (!samples.empty() && pose.t < samples.back().t)
      throw InputError(
          fmt::format("{}: the stamps must not decrease: {:.6f} follows {:.6f}; sort the lines by time",
                      file.string(), pose.t, samples.back().t));
    if (!samples.empty() && pose.t - samples.back().t < shortest_s) {
      ++duplicates;
      continue;
    }
    samples.push_back({pose.t, {pose.position, camera_axes(loaded.scenario, pose.orientation)}});
  }
  if (samples.size() < 2)
    throw InputError(fmt::format("{}: a motion needs two poses or more, at different times", file.string()));
  if (!trajectory.front().oriented)
    throw InputError(file.string() + ": the orientation is not known; a camera needs one");
  if (duplicates > 0)
    out.notes.push_back(fmt::format("{}: {} poses less than {} s after another are not used", file.string(),
                                    duplicates, shortest_s));
  return samples;
}

struct Part {
  double first_s = 0, last_s = 0;
};

/// The longest part without a gap.
Part longest_part(const std::vector<TimedPose>& samples) {
  Part best, now{samples.front().t, samples.front().t};
  for (const TimedPose& sample : samples) {
    if (sample.t - now.last_s > longest_gap_s) now.first_s = sample.t;
    now.last_s = sample.t;
    if (now.last_s - now.first_s > best.last_s - best.first_s) best = now;
  }
  return best;
}

void check_gaps(const LoadedScenario& loaded, const std::vector<TimedPose>& samples, const Part& used) {
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double from = samples[k - 1].t, to = samples[k].t;
    if (to <= used.first_s || from >= used.last_s || to - from <= longest_gap_s) continue;
    const double begin = samples.front().t;
    const Part longest = longest_part(samples);
    // Rounded into the part, or the suggestion would be refused in turn
    const double start_s = std::ceil(100 * (longest.first_s - begin)) / 100;
    const double duration_s = std::floor(100 * (longest.last_s - begin - start_s)) / 100;
    refuse(
        loaded, "motion.file",
        fmt::format(
            "has no pose from {:.2f} s to {:.2f} s after its start, and may have gaps of {} s at most; use "
            "another part, e.g. the longest without a gap: motion.start_s = {:.2f}, run.duration_s = {:.2f}",
            from - begin, to - begin, longest_gap_s, start_s, duration_s));
  }
}

/// The part of the trajectory that the run uses.
Part used_part(const LoadedScenario& loaded, const TrajectoryMotion& motion, const MotionSpline& spline) {
  const double first_s = spline.first_s() + motion.start_s;
  if (!(first_s < spline.last_s()))
    refuse(loaded, "motion.start_s",
           fmt::format("must be less than the duration of the trajectory, {:.2f} s",
                       spline.last_s() - spline.first_s()));
  return {first_s, std::min(spline.last_s(), first_s + loaded.scenario.run.duration_s)};
}

std::vector<TimedPose> sampled(const MotionSpline& spline, const Part& part) {
  std::vector<TimedPose> samples;
  const int count = static_cast<int>((part.last_s - part.first_s) / placed_every_s);
  for (int k = 0; k <= count; ++k) {
    const double t = part.first_s + k * placed_every_s;
    samples.push_back({t, spline.at(t).pose});
  }
  samples.push_back({part.last_s, spline.at(part.last_s).pose});
  return samples;
}

std::string in_words(const MotionPlacement& placement, const std::string& file, double duration_s) {
  const std::string size =
      placement.scale == 1 ? "at full size" : fmt::format("scaled by {:.3f} to fit", placement.scale);
  return fmt::format(
      "motion: {:.2f} s of {}, {}, turned by {:.3f} rad about the vertical, from [{:.3f}, {:.3f}, {:.3f}]",
      duration_s, file, size, placement.turn_rad, placement.start.x(), placement.start.y(),
      placement.start.z());
}

}  // namespace

RoomMotion motion_in_room(const LoadedScenario& loaded, const RoomLayout& layout) {
  const Scenario& s = loaded.scenario;
  const auto& motion = std::get<TrajectoryMotion>(s.true_motion.type);
  const std::filesystem::path file = find_named_file(loaded, "motion.file", motion.file);
  RoomMotion out;
  std::vector<TimedPose> samples = samples_of(loaded, file, out);
  const MotionSpline spline(samples);
  const Part part = used_part(loaded, motion, spline);
  check_gaps(loaded, samples, part);
  const MotionPlacement placement = place_motion(sampled(spline, part), layout, s.room.clearance_m + margin_m,
                                                 {s.room.start_position_m, s.room.start_heading_rad});
  for (TimedPose& sample : samples) {
    sample = placement.of(sample);
    sample.t -= part.first_s;
  }
  out.world_from_camera = std::make_shared<const MotionSpline>(std::move(samples));
  out.duration_s = part.last_s - part.first_s;
  out.notes.push_back(in_words(placement, file.filename().string(), out.duration_s));
  return out;
}

RecordedTruth truth_of(const RoomMotion& motion) {
  return [spline = motion.world_from_camera](double t) -> std::optional<BodyTruth> {
    const MovingPose now = spline->at(t);
    BodyTruth body;
    body.pose = now.pose;
    body.state = SmallVector::Zero(FreeCameraMotion::state_size);
    body.state << now.pose.position, now.pose.world_from_body, now.velocity, now.rate;
    body.input = SmallVector::Zero(FreeCameraMotion::input_size);
    return body;
  };
}

}  // namespace incognita
