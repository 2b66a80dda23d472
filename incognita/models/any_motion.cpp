#include "incognita/models/any_motion.hpp"

#include "incognita/models/mount.hpp"

namespace incognita {

const Chart& chart_of(const AnyMotion& motion) {
  return std::visit([](const auto& model) -> const Chart& { return std::decay_t<decltype(model)>::chart; },
                    motion);
}

int inputs_of(const AnyMotion& motion) {
  return std::visit([](const auto& model) { return std::decay_t<decltype(model)>::input_size; }, motion);
}

SmallVector rate_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input) {
  return std::visit(
      [&](const auto& model) -> SmallVector {
        using Model = std::decay_t<decltype(model)>;
        return model.rate(typename Model::template State<double>(state),
                          typename Model::template Input<double>(input));
      },
      motion);
}

AnyStep step_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input, double dt) {
  return std::visit(
      [&](const auto& model) -> AnyStep {
        using Model = std::decay_t<decltype(model)>;
        const auto step = model.step(typename Model::template State<double>(state),
                                     typename Model::template Input<double>(input), dt);
        return {step.x, step.F, step.G};
      },
      motion);
}

RigidPose pose_of(const AnyMotion& motion, const SmallVector& state) {
  return std::visit(
      [&](const auto& model) -> RigidPose {
        using Model = std::decay_t<decltype(model)>;
        const typename Model::template State<double> x = state;
        if constexpr (std::is_same_v<Model, FreeCameraMotion>)
          return {x.template head<3>(), x.template segment<4>(3)};
        else if constexpr (std::is_same_v<Model, MonobotMotion>)
          return {{x[0], 0, 0}, {1, 0, 0, 0}};
        else if constexpr (std::is_same_v<Model, TerrainVehicle>)
          return model.pose(x).pose;
        else
          return on_floor(x).pose;
      },
      motion);
}

SmallMatrix pose_jacobian(const AnyMotion& motion, const SmallVector& state) {
  return std::visit(
      [&](const auto& model) -> SmallMatrix {
        using Model = std::decay_t<decltype(model)>;
        const typename Model::template State<double> x = state;
        if constexpr (std::is_same_v<Model, FreeCameraMotion> || std::is_same_v<Model, MonobotMotion>)
          return SmallMatrix::Identity(6, Model::error_size);  // position first, then rotation
        else if constexpr (std::is_same_v<Model, TerrainVehicle>)
          return model.pose(x).J;
        else
          return on_floor(x).J;
      },
      motion);
}

}  // namespace incognita
