// Static properties and required interface of a motion model: docs/add-a-motion-model.md.
//
// The pose comes first in every state and error: x on a line; x, y, heading on a plane and on uneven ground;
// position and orientation in space. Further states, such as velocities or the angle of a trailer, follow.
#pragma once

#include <concepts>
#include <span>
#include <string_view>
#include <type_traits>

#include "incognita/math/chart.hpp"
#include "incognita/models/motion/quantity.hpp"
#include "incognita/models/motion/rigid_pose.hpp"

namespace incognita {

/// The space in which a vehicle moves.
enum class Space {
  line,           ///< along x
  plane,          ///< on the floor z = 0
  uneven_ground,  ///< on a terrain, which determines height and tilt
  space,          ///< in three dimensions; the pose is that of a camera, in camera axes
};

/// Coordinates of a point in that space.
constexpr int dimensions_of(Space space) { return space == Space::line ? 1 : space == Space::plane ? 2 : 3; }

/// Static properties of a motion model, for code independent of its type.
struct MotionTraits {
  std::string_view name;     ///< name in a scenario: "differential-drive"
  std::string_view summary;  ///< one sentence
  Space space = Space::plane;
  int position_size = 0;            ///< position coordinates, the first of state and error
  std::span<const Quantity> state;  ///< sizes: those of the state, its error and the input
  std::span<const Quantity> error;
  std::span<const Quantity> input;

  bool on_line() const { return space == Space::line; }
  bool on_plane() const { return space == Space::plane; }
  bool in_space() const { return space == Space::space; }
  /// Whether the state is exactly a planar pose.
  bool is_planar_pose() const { return on_plane() && state.size() == 3; }
  bool has_input(std::string_view wanted) const {
    for (const Quantity& quantity : input)
      if (quantity.name == wanted) return true;
    return false;
  }
};

/// A motion model that a scenario can choose. `M::Integrator` is the model used by filters: the model itself,
/// or one built from it that integrates a held input more accurately.
///
/// Optional members: `static constexpr auto parameters()`, settable by the scenario (quantity.hpp); `Terrain
/// terrain`, set by set_terrain(); `steered_as()`, a simpler model with the same inputs, whose state is the
/// beginning of this one's and whose control laws apply to this one (control/steering.hpp).
template <class M>
concept MotionModel = requires(const M& model, const typename M::template State<double>& x,
                               const typename M::template Input<double>& u, double dt,
                               const Eigen::Vector3d& position) {
  requires std::default_initializable<M>;
  { M::name } -> std::convertible_to<std::string_view>;
  { M::summary } -> std::convertible_to<std::string_view>;
  { M::space } -> std::convertible_to<Space>;
  { M::position_size } -> std::convertible_to<int>;
  requires M::state.size() == M::state_size;
  requires M::error.size() == M::error_size;
  requires M::input.size() == M::input_size;
  requires M::chart.ambient() == M::state_size;
  requires M::chart.tangent() == M::error_size;
  typename M::Integrator;
  { model.template rate<double>(x, u) } -> std::convertible_to<typename M::template State<double>>;
  { model.template f<double>(x, u, dt) } -> std::convertible_to<typename M::template State<double>>;
  { model.step(x, u, dt).x } -> std::convertible_to<typename M::template State<double>>;
  { model.step(x, u, dt).F } -> std::convertible_to<typename M::Jacobian>;
  { model.step(x, u, dt).G } -> std::convertible_to<typename M::InputJacobian>;
  /// Pose of the body in space with d(pose error) / d(state error).
  { model.pose(x) } -> std::same_as<PoseOf<M::error_size>>;
  /// Heading about the world's z axis, from +x, rad.
  { model.heading(x) } -> std::same_as<double>;
  /// State at rest at a position (m, world) with a heading (rad); coordinates the vehicle cannot choose are ignored.
  { M::at_rest(position, dt) } -> std::convertible_to<typename M::template State<double>>;
};

template <MotionModel M>
inline constexpr MotionTraits motion_traits{M::name,  M::summary, M::space, M::position_size,
                                            M::state, M::error,   M::input};

/// The model used by filters. A model that is its own integrator is not copied.
template <class M>
decltype(auto) integrator_of(const M& model) {
  if constexpr (std::is_same_v<typename M::Integrator, M>)
    return (model);
  else
    return typename M::Integrator{model};
}

}  // namespace incognita
