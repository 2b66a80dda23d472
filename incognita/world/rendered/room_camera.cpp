#include "incognita/world/rendered/room_camera.hpp"

#include <stdexcept>
#include <utility>

#include "incognita/world/rendered/render.hpp"

namespace incognita {
namespace {

constexpr std::uint8_t covered_gray = 8;  // a lens cap transmits a little light

}  // namespace

RoomCamera::RoomCamera(std::shared_ptr<const Room> room, const Camera& camera, const RoomSettings& settings,
                       std::uint64_t seed, const std::string& name)
    : room_(std::move(room)),
      rays_(camera),
      noise_(settings.sigma_image_gray, seed, name),
      cover_lens_from_s_(settings.cover_lens_from_s) {}

std::shared_ptr<const Image> RoomCamera::image_from(const RigidPose& world_from_camera, const Tick& tick) {
  auto image = std::make_shared<Image>();
  if (covered(tick))
    *image = Image(rays_.width, rays_.height, covered_gray);
  else
    render(*room_, rays_, world_from_camera.position, world_from_camera.world_from_body, *image);
  noise_.add_to(*image);
  return image;
}

void RoomCamera::measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
                         BodyObservation& observation) {
  const BodyTruth& body = truth_of(truth, which);
  if (!body.pose) throw std::invalid_argument("the camera of the rendered room needs the true pose");
  observation.images.push_back(image_from(*body.pose, tick));
}

}  // namespace incognita
