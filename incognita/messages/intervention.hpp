// What a person does to a running loop: disturbs it, drives a body by hand, or changes the decision. Every
// intervention is logged with its tick, and the log repeats the run.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace incognita {

/// Covers the lenses of all cameras, or uncovers them.
struct CoverLens {
  bool covered = true;
};
/// Adds white noise to all images, besides that of the sensor; 0: none.
struct AddImageNoise {
  double sigma_gray = 0;
};
/// Multiplies the gray values of all images; 1: as they are.
struct ChangeLight {
  double factor = 1;
};

/// Moves the true body at once; no sensor of motion measures it.
struct DisplaceBody {
  std::size_t body = 0;
  Eigen::Vector3d by_m{0, 0, 0};  ///< world; coordinates in which the body cannot move are ignored
  double turn_rad = 0;            ///< about the world's z axis
};
/// Adds a velocity to the true body for some time; no sensor of motion measures it.
struct PushBody {
  std::size_t body = 0;
  Eigen::Vector3d velocity_m_s{0, 0, 0};  ///< world; coordinates in which the body cannot move are ignored
  double duration_s = 0.5;
};

/// A person drives the body from now on; at first it holds still.
struct TakeOverBody {
  std::size_t body = 0;
};
/// The strategy and the control law have the body again.
struct GiveBackBody {
  std::size_t body = 0;
};
/// How the person drives, until the next: shares of the largest velocity of the body, -1 to 1.
struct DriveBody {
  std::size_t body = 0;
  Eigen::Vector3d direction{0, 0, 0};  ///< forward, left, up, relative to the heading
  double turn = 0;                     ///< positive to the left
};

/// Changes settings of the decision: "decision.strategy=random".
struct ChangeDecision {
  std::vector<std::string> settings;
};

using Intervention = std::variant<CoverLens, AddImageNoise, ChangeLight, DisplaceBody, PushBody, TakeOverBody,
                                  GiveBackBody, DriveBody, ChangeDecision>;

}  // namespace incognita
