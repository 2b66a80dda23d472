#include "incognita/world/disturbed_images.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/world/image_gain.hpp"

namespace incognita {
namespace {

constexpr std::uint8_t covered_gray = 8;  // a lens cap transmits a little light

}  // namespace

DisturbedImages::DisturbedImages(std::unique_ptr<Sensor> sensors, std::uint64_t seed)
    : sensors_(std::move(sensors)), seed_(seed) {}

void DisturbedImages::add_noise(const AddImageNoise& noise) {
  if (!(noise.sigma_gray >= 0 && noise.sigma_gray <= 100))
    throw std::invalid_argument("image noise: sigma_gray must be 0 to 100, got " +
                                std::to_string(noise.sigma_gray));
  noise_.reset();
  sigma_gray_ = noise.sigma_gray;
  if (noise.sigma_gray > 0) noise_.emplace(noise.sigma_gray, seed_, "disturbance.image");
}

void DisturbedImages::change_light(const ChangeLight& light) {
  if (!(light.factor >= 0 && light.factor <= 10))
    throw std::invalid_argument("light: factor must be 0 to 10, got " + std::to_string(light.factor));
  light_ = light.factor;
}

std::shared_ptr<const Image> DisturbedImages::disturbed(const Image& image) {
  auto out = std::make_shared<Image>(covered_ ? Image(image.width(), image.height(), covered_gray) : image);
  if (light_ != 1 && !covered_) apply_gain(*out, light_);
  if (noise_) noise_->add_to(*out);
  return out;
}

Observation DisturbedImages::measure(const std::optional<Truth>& truth, const Tick& tick) {
  Observation observation = sensors_->measure(truth, tick);
  if (!covered_ && light_ == 1 && !noise_) return observation;
  for (BodyObservation& body : observation.bodies)
    for (auto& image : body.images)
      if (image && !image->empty()) image = disturbed(*image);
  return observation;
}

}  // namespace incognita
