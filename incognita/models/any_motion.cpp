#include "incognita/models/any_motion.hpp"

#include <algorithm>

#include "incognita/math/angles.hpp"

namespace incognita {
namespace {

/// Calls with(model, state) with their static types.
template <class With>
auto with_state(const AnyMotion& motion, const SmallVector& state, With with) {
  return std::visit(
      [&](const auto& model) {
        return with(model, typename std::decay_t<decltype(model)>::template State<double>(state));
      },
      motion);
}

}  // namespace

const MotionTraits& traits_of(const AnyMotion& motion) {
  return std::visit(
      [](const auto& model) -> const MotionTraits& { return motion_traits<std::decay_t<decltype(model)>>; },
      motion);
}

const Chart& chart_of(const AnyMotion& motion) {
  return std::visit([](const auto& model) -> const Chart& { return std::decay_t<decltype(model)>::chart; },
                    motion);
}

int inputs_of(const AnyMotion& motion) {
  return std::visit([](const auto& model) { return std::decay_t<decltype(model)>::input_size; }, motion);
}

SmallVector rate_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input) {
  return with_state(motion, state, [&](const auto& model, const auto& x) -> SmallVector {
    return model.rate(x, typename std::decay_t<decltype(model)>::template Input<double>(input));
  });
}

AnyStep step_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input, double dt) {
  return with_state(motion, state, [&](const auto& model, const auto& x) -> AnyStep {
    const auto step =
        model.step(x, typename std::decay_t<decltype(model)>::template Input<double>(input), dt);
    return {step.x, step.F, step.G};
  });
}

RigidPose pose_of(const AnyMotion& motion, const SmallVector& state) {
  return with_state(motion, state,
                    [](const auto& model, const auto& x) -> RigidPose { return model.pose(x).pose; });
}

SmallMatrix pose_jacobian(const AnyMotion& motion, const SmallVector& state) {
  return with_state(motion, state,
                    [](const auto& model, const auto& x) -> SmallMatrix { return model.pose(x).J; });
}

double heading_by(const AnyMotion& motion, const SmallVector& state) {
  return with_state(motion, state,
                    [](const auto& model, const auto& x) -> double { return model.heading(x); });
}

SmallVector at_rest(const AnyMotion& motion, const Eigen::Vector3d& position, double heading_rad) {
  return std::visit(
      [&](const auto& model) -> SmallVector {
        return std::decay_t<decltype(model)>::at_rest(position, heading_rad);
      },
      motion);
}

SmallVector displaced(const AnyMotion& motion, SmallVector state, const Eigen::Vector3d& by_m,
                      double turn_rad) {
  const MotionTraits& traits = traits_of(motion);
  state.head(traits.position_size) += by_m.head(traits.position_size);
  if (traits.in_space())
    state.segment<4>(3) =
        quaternion_product<double>(quaternion_exp<double>({0, 0, turn_rad}), state.segment<4>(3));
  else if (!traits.on_line())
    state[2] = wrap_angle(state[2] + turn_rad);
  return state;
}

AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle) {
  return with_state(motion, vehicle, [&](const auto& model, const auto& x) -> AnyPoint {
    using Model = std::decay_t<decltype(model)>;
    constexpr int size = Model::position_size;
    if constexpr (size == dimensions_of(Model::space)) {
      return {x.template head<size>(), SmallMatrix::Identity(size, Model::error_size)};
    } else {
      const auto body = model.pose(x);  // the height depends on the terrain
      return {body.pose.position, body.J.template topRows<3>()};
    }
  });
}

AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle, int dimensions) {
  const AnyPoint own = position_of(motion, vehicle);
  const Eigen::Index both = std::min<Eigen::Index>(dimensions, own.position.size());
  AnyPoint at{SmallVector::Zero(dimensions), SmallMatrix::Zero(dimensions, own.J.cols())};
  at.position.head(both) = own.position.head(both);
  at.J.topRows(both) = own.J.topRows(both);
  return at;
}

}  // namespace incognita
