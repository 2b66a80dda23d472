// The simulated world: bodies that move by their own continuous motion, each with a plant, obstacles, an operator who
// holds it, or a mount on which it carries the camera that the filter estimates.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/models/motion/mount.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"
#include "incognita/world/obstacles.hpp"
#include "incognita/world/operator_model.hpp"
#include "incognita/world/plant.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

struct SimulatedBody {
  AnyMotion motion;
  PlantSettings plant;
  std::string name;  ///< of its random streams
  /// Of the camera that a TerrainVehicle carries, thesis Section 6.4: the true body is then that camera
  std::optional<Mount> mount = {};
  std::optional<OperatorActuator> actuator = {};    ///< the operator who moves it; of free cameras
  std::shared_ptr<const Obstacles> obstacles = {};  ///< null: none
};

/// Pose, velocity and angular rate of a camera on a moving vehicle: 13 numbers as in FreeCameraMotion.
/// `state_rate`: d(state of the vehicle)/dt.
FreeCameraMotion::State<double> carried_camera(const TerrainVehicle& vehicle, const Mount& mount,
                                               const TerrainVehicle::State<double>& state,
                                               const TerrainVehicle::State<double>& state_rate);

class SimulatedWorld final : public World {
 public:
  /// Throws std::invalid_argument as Plant and Obstacles do, and for a mount or an operator that does not fit the body.
  SimulatedWorld(std::vector<SimulatedBody> bodies, std::uint64_t seed);
  /// With one body.
  SimulatedWorld(SimulatedBody body, std::uint64_t seed);

  /// Bodies without an input get zeros: vehicles stand still, and bodies in space keep their velocity. A tick of zero
  /// duration, such as the first, only returns the state. The input of a carried camera and of one that an operator
  /// holds is 0 in the truth, since neither is measured.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

  /// Obstacles stop a displaced or pushed body. A camera on a mount is disturbed with the vehicle that carries it.
  void displace(const DisplaceBody& displacement) override;
  void push(const PushBody& push) override;
  void state(StateArchive& archive) override;

 private:
  struct Simulated {
    SimulatedBody body;
    Plant plant;
    bool stopped = false;  ///< by an obstacle, in the last tick
    Eigen::Vector3d push_m_s{0, 0, 0};
    double push_left_s = 0;  ///< time for which it is still pushed
    void state(StateArchive& archive);
  };
  Simulated& simulated(std::size_t body);
  static void push_on(Simulated& simulated, double dt_s);
  SmallVector commanded(Simulated& simulated, const BodyCommand& command);
  static BodyTruth truth_of(const Simulated& simulated);

  std::vector<Simulated> bodies_;
  std::optional<double> last_t_;  ///< previous tick, when the command was given
};

}  // namespace incognita
