// Examples of every registered motion model and sensor, generated from what the models declare: a newly
// registered model is tested without a line in any test.
#pragma once

#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/any_sensor.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "tests/models/grounds.hpp"
#include "tests/small_vectors.hpp"

namespace incognita::registered {

inline constexpr WideAngleCamera wide_lens{.kd1 = 9e-6};  // field of view 100 degrees
inline constexpr PinholeCamera pinhole_lens{.k1 = -0.28, .k2 = 0.07, .p1 = 2e-4, .p2 = 2e-5};
inline constexpr FisheyeCamera fisheye_lens{
    .fu = 140, .fv = 140, .k1 = 0.0035, .k2 = 0.0007, .k3 = -0.0021, .k4 = 0.0002};
inline const Mount some_mount{
    .forward_m = 0.2, .left_m = -0.1, .up_m = 0.6, .pitch_rad = -0.2, .yaw_rad = 0.4};

/// A model with every parameter at another value of its range.
template <class Model>
Model with_other_parameters() {
  Model model;
  double shift = 0.4;
  for (const Parameter<Model>& p : parameters_of<Model>()) {
    double& number = p.in(model);
    for (const double candidate : {number + shift, number - shift, number + shift / 100})
      if (p.range.contains(candidate)) {
        number = candidate;
        break;
      }
    shift *= -0.7;
  }
  return model;
}

/// With default parameters, with others, on each terrain, with every camera.
template <class Model>
std::vector<Model> examples(const std::vector<Terrain>& all_grounds = {grounds::steep_slope(),
                                                                       grounds::gentle_waves(),
                                                                       grounds::small_height_map()}) {
  std::vector<Model> all{Model{}};
  if (parameters_of<Model>().size() > 0) all.push_back(with_other_parameters<Model>());
  const std::vector<Model> plain = all;
  if constexpr (requires(Model m) { m.terrain; })
    for (const Terrain& ground : all_grounds)
      for (Model model : plain) {
        model.terrain = ground;
        all.push_back(model);
      }
  if constexpr (requires(Model m) { m.lens(); }) {
    all.clear();
    for (const Camera& lens : {Camera(wide_lens), Camera(pinhole_lens), Camera(fisheye_lens)})
      for (Model model : plain) {
        model.lens() = lens;
        model.mount = some_mount;
        all.push_back(model);
      }
  }
  return all;
}

template <class Variant>
std::vector<Variant> examples_of_all() {
  std::vector<Variant> all;
  for_each_type<Variant>([&]<class Model>(std::type_identity<Model>) {
    for (const Model& model : examples<Model>({grounds::steep_slope(), grounds::steep_waves()}))
      all.emplace_back(model);
  });
  return all;
}
inline std::vector<AnyMotion> motions() { return examples_of_all<AnyMotion>(); }
inline std::vector<AnySensor> sensors() { return examples_of_all<AnySensor>(); }

/// Random states, and states with the heading at the wrap.
inline std::vector<SmallVector> states(const AnyMotion& motion) {
  constexpr double pi = std::numbers::pi;
  RandomStream random(1, "states");
  const MotionTraits& traits = traits_of(motion);
  std::vector<SmallVector> all;
  for (int i = 0; i < 5; ++i) {
    SmallVector shift(chart_of(motion).tangent());
    for (double& number : shift) number = random.uniform(-3, 3);
    SmallVector x = testing::plus(chart_of(motion), at_rest(motion, Eigen::Vector3d::Zero(), 0), shift);
    if (i < 2 && !traits.on_line() && !traits.in_space()) x[2] = i == 0 ? pi : -pi + 1e-5;
    all.push_back(x);
  }
  return all;
}

}  // namespace incognita::registered
