#include "incognita/world/rendered/room_camera.hpp"

#include <stdexcept>
#include <utility>

#include "incognita/world/rendered/render.hpp"

namespace incognita {
namespace {

constexpr std::uint8_t covered_gray = 8;  // a lens cap transmits a little light

}  // namespace

RoomCamera::RoomCamera(std::shared_ptr<const Room> room, const Camera& camera, const RoomSettings& settings,
                       std::uint64_t seed)
    : room_(std::move(room)),
      rays_(camera),
      noise_(settings.sigma_image_gray, seed),
      cover_lens_from_s_(settings.cover_lens_from_s) {}

Observation RoomCamera::measure(const std::optional<Truth>& truth, const Tick& tick) {
  if (!truth || truth->bodies.empty() || !truth->bodies[0].pose)
    throw std::invalid_argument("the camera of the rendered room needs the true pose");
  auto image = std::make_shared<Image>();
  if (covered(tick))
    *image = Image(rays_.width, rays_.height, covered_gray);
  else
    render(*room_, rays_, truth->bodies[0].pose->position, truth->bodies[0].pose->world_from_body, *image);
  noise_.add_to(*image);
  Observation observation;
  observation.bodies.emplace_back().images = {std::move(image)};
  return observation;
}

}  // namespace incognita
