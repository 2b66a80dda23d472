#include "incognita/world/rendered/room_camera.hpp"

#include <stdexcept>
#include <utility>

#include "incognita/models/motion/free_camera.hpp"
#include "incognita/world/image_gain.hpp"
#include "incognita/world/motion_spline.hpp"

namespace incognita {
namespace {

constexpr std::uint8_t covered_gray = 8;  // a lens cap transmits a little light

/// Of a free or carried camera; a body whose state has no velocity counts as at rest.
MovingPose motion_of(const BodyTruth& body) {
  MovingPose motion{*body.pose};
  if (body.state.size() != FreeCameraMotion::state_size) return motion;
  motion.velocity = body.state.segment<3>(7);
  motion.rate = body.state.segment<3>(10);
  return motion;
}

}  // namespace

PoseInTime motion_about(const Tick& tick, const BodyTruth& body, const PoseAtTime& pose_at) {
  return [t = tick.t, &body, &pose_at](double dt_s) {
    return pose_at ? pose_at(t + dt_s) : extrapolated(motion_of(body), dt_s);
  };
}

RoomCamera::RoomCamera(std::shared_ptr<const Room> room, const Camera& camera, const RoomSettings& settings,
                       std::uint64_t seed, const std::string& name, const ExposureSettings& exposure)
    : room_(std::move(room)),
      camera_(*room_, camera, exposure.duration_s, exposure.readout_s),
      gain_(exposure, seed, name + ".exposure"),
      noise_(settings.sigma_image_gray, seed, name),
      cover_lens_from_s_(settings.cover_lens_from_s) {}

std::shared_ptr<const Image> RoomCamera::image_from(const RigidPose& world_from_camera, const Tick& tick) {
  return image_along([&](double) { return world_from_camera; }, tick);
}

std::shared_ptr<const Image> RoomCamera::image_along(const PoseInTime& world_from_camera, const Tick& tick) {
  auto image = std::make_shared<Image>();
  if (covered(tick))
    *image = Image(camera_.rays().width, camera_.rays().height, covered_gray);
  else
    camera_.expose(world_from_camera, *image);
  if (const double gain = gain_.at(tick.t); gain != 1) apply_gain(*image, gain);
  noise_.add_to(*image);
  return image;
}

void RoomCamera::measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
                         BodyObservation& observation) {
  const BodyTruth& body = truth_of(truth, which);
  if (!body.pose) throw std::invalid_argument("the camera of the rendered room needs the true pose");
  observation.images.push_back(image_along(motion_about(tick, body, pose_at_), tick));
}

}  // namespace incognita
