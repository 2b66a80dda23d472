// (6.10), the motion of the optical center of a camera on a vehicle over uneven ground, and Table 6.1.
//
// Experiment: the exact motion is that of models/motion/terrain_vehicle.hpp, which is derived from the contact with
// the ground; the camera 0.3 m ahead of the axle, facing forward; the thesis' world has y up. Planes: level, and two
// with slopes of 0.36 and 1.5; waves with slopes up to 0.5. Eight headings, inputs of up to 2 m/s and 2 rad/s. Angles
// are those with which the columns of Rz(phi) Ry(-theta) Rx(-psi) are the camera's axes.
#include <set>
#include <utility>

#include "experiments/common.hpp"
#include "incognita/decision/actions.hpp"
#include "incognita/models/motion/mount.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"

namespace incognita {
namespace section_6_4_model {
namespace {

constexpr double lever_m = 0.3;

struct Rates {
  Vector3d velocity;  ///< of the optical center
  Vector3d angles;    ///< of psi, theta, phi
};

enum class Lever { as_printed, rigid };

/// Gamma u.
Rates gamma(const Vector3d& angles, const Vector2d& u, double lever) {
  const double psi = angles[0], theta = angles[1], phi = angles[2];
  const Vector3d ahead(-std::sin(phi) * std::sin(psi) - std::cos(phi) * std::cos(psi) * std::sin(theta),
                       std::cos(phi) * std::sin(psi) - std::sin(phi) * std::cos(psi) * std::sin(theta),
                       std::cos(psi) * std::cos(theta));
  const Vector3d aside(-std::cos(theta) * std::cos(phi), -std::cos(theta) * std::sin(phi), -std::sin(theta));
  return {u[0] * ahead + u[1] * lever * aside,
          u[1] * Vector3d(std::sin(psi) * std::tan(theta), std::cos(psi), std::sin(psi) / std::cos(theta))};
}

Rates gamma(const Vector3d& angles, const Vector2d& u, Lever lever) {
  return gamma(angles, u, lever == Lever::rigid ? lever_m : lever_m * std::cos(angles[0]));
}

/// Of the two sets of angles the one with cos(psi) > 0, which suits (6.10) best.
Vector3d angles_of(const Matrix3d& R) {
  const Vector3d one(-std::atan2(R(2, 1), R(2, 2)), std::asin(R(2, 0)), std::atan2(R(1, 0), R(0, 0)));
  if (std::cos(one[0]) > 0) return one;
  return {wrap_angle(one[0] + pi), wrap_angle(pi - one[1]), wrap_angle(one[2] + pi)};
}

Matrix3d y_up() {  // x to the right, y up, z towards the viewer
  return (Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}

struct Exact {
  Vector3d velocity, angles, angle_rates;
};

/// Of a camera on the vehicle, in the thesis' world, by differences along the exact motion.
Exact by_contact(const TerrainVehicle& vehicle, const Vector3d& x, const Vector2d& u) {
  const Mount mount{.forward_m = lever_m};
  const auto camera = [&](double seconds) {
    return mount.on(vehicle.pose(vehicle.f<double>(x, u, seconds))).camera;
  };
  const auto angles = [&](double seconds) -> Vector3d {
    return angles_of(y_up() * rotation_matrix<double>(camera(seconds).segment<4>(3)));
  };
  constexpr double e = 1e-5;
  const Vector3d turned = angles(e) - angles(-e);
  return {y_up() * (camera(e).head<3>() - camera(-e).head<3>()) / (2 * e), angles(0),
          turned.unaryExpr([](double angle) { return wrap_angle(angle); }) / (2 * e)};
}

std::vector<Vector2d> inputs() { return {{1.5, 0}, {0, 0.7}, {-0.8, 1.1}, {2, -2}}; }

std::vector<TiltedPlane> planes() { return {{}, {.slope_x = 0.3, .slope_y = -0.2}, {.slope_y = 1.5}}; }

Terrain waves() {
  return Waves{.height_m = -1,
               .waves = {{.amplitude_m = 1, .length_m = 20, .direction_rad = 0.3},
                         {.amplitude_m = 0.5, .length_m = 15, .direction_rad = 1.9, .phase_rad = 1}}};
}

Claim rigid_lever() {
  Worst worst;
  double angles = 0;
  int poses = 0;
  for (const TiltedPlane& plane : planes())
    for (int i = 0; i < 8; ++i)
      for (const Vector2d& u : inputs()) {
        const Exact exact = by_contact({plane}, {1, 2, wrap_angle(0.3 + i * pi / 4)}, u);
        const Rates printed = gamma(exact.angles, u, Lever::as_printed),
                    rigid = gamma(exact.angles, u, Lever::rigid);
        worst.take((printed.velocity - exact.velocity).norm(), (rigid.velocity - exact.velocity).norm());
        angles = std::max(angles, (rigid.angles - exact.angle_rates).norm());
        ++poses;
      }
  return assessed(
      "6.10-lever", "(6.10)",
      "On a plane, level or tilted, (6.10) moves the optical center as the vehicle's contact with "
      "the ground does; to 1e-6 m/s",
      {.printed = "second column of Gamma: -l cos(psi) cos(theta) cos(phi), -l cos(psi) cos(theta) "
                  "sin(phi), -l cos(psi) sin(theta)",
       .measured = {"{} poses and inputs on three planes: {}; rates of the angles, in rad/s, {}", poses,
                    worst.text("m/s"), below(angles)},
       .number = exactly("largest difference of the printed velocity", worst.printed, "m/s"),
       .why = "without cos(psi): the lever of a rigid body has the length l on any slope",
       .runs = poses},
      worst.printed <= 1e-6, as_corrected(worst.ours <= 1e-6 && angles <= 1e-6));
}

/// Straight ahead for a second at 1 m/s, (6.10) without lever integrated; how far from the ground.
double off_ground_m(const Terrain& terrain, const Vector3d& start) {
  const TerrainVehicle vehicle{terrain};
  const Mount no_lever;
  const auto camera = no_lever.on(vehicle.pose(start)).camera;
  Vector3d position = y_up() * Vector3d(camera.head<3>()),
           angles = angles_of(y_up() * rotation_matrix<double>(camera.segment<4>(3)));
  constexpr int steps = 1000;
  for (int k = 0; k < steps; ++k) {
    const Rates now = gamma(angles, {1, 0}, 0.0);
    position += now.velocity / steps, angles += now.angles / steps;
  }
  const Vector3d p = y_up().transpose() * position;
  return std::abs(p.z() - terrain.at<double>(p.x(), p.y()).height);
}

Claim stays_on_ground() {
  double on_planes = 0, on_waves = 0, exact = 0;
  for (int i = 0; i < 8; ++i) {
    const Vector3d start(1, 2, wrap_angle(0.3 + i * pi / 4));
    for (const TiltedPlane& plane : planes()) on_planes = std::max(on_planes, off_ground_m(plane, start));
    on_waves = std::max(on_waves, off_ground_m(waves(), start));
    const TerrainVehicle vehicle{waves()};
    const Vector3d after = vehicle.f<double>(start, {1, 0}, 1);
    exact = std::max(exact, std::abs(vehicle.position<double>(after).z() -
                                     vehicle.terrain.at<double>(after.x(), after.y()).height));
  }
  return assessed(
      "6.10-ground", "(6.10), Sections 6.4 and 6.4.1",
      "(6.10) takes into account contact with the ground at all times and its slope: the vehicle that drives "
      "straight for 1 m stays on the ground, to 1 mm",
      {.rule = Rule::example,
       .measured = {"farthest from the ground after 1 m at 8 headings: planes {} m; waves with slopes up to "
                    "0.5 {:.1f} mm, and {} m by a model of the contact",
                    below(on_planes), 1e3 * on_waves, below(exact)},
       .number = exactly("distance from the ground after 1 m on waves", 1e3 * on_waves, "mm"),
       .why = "on planes, tilted ones too. Where the ground is curved a vehicle that drives straight pitches "
              "and rolls, and the first column of Gamma has zeros there"},
      on_planes < 1e-3 && on_waves < 1e-3, on_condition(on_planes < 1e-9 && exact < 1e-9));
}

Claim every_combination() {
  std::set<std::pair<int, int>> found;
  const auto sign = [](double x) { return (x > 0) - (x < 0); };
  for (const SpeedChange& action : table_6_1(0.5, 0.3, 1))
    found.emplace(sign(action.change[0]), sign(action.change[1]));
  return assessed("6.4-table", "Section 6.4.2, Table 6.1",
                  "The mutual information is computed for every combination of linear and angular "
                  "acceleration: negative, none and positive each",
                  {.rule = Rule::example,
                   .measured = {"Table 6.1 has {} of 9 combinations", found.size()},
                   .number = exactly("combinations in Table 6.1, of 9", static_cast<double>(found.size())),
                   .why = "the mixed pairs (-, +) and (+, -) are missing"},
                  found.size() == 9,
                  in_truth(found.size() == 7 && !found.contains({-1, 1}) && !found.contains({1, -1})));
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(section_6_4_equations, settings, {rigid_lever(), stays_on_ground(), every_combination()});
}

}  // namespace
}  // namespace section_6_4_model

const Experiment section_6_4_equations{
    "6.4-equations", "The motion of a camera on a vehicle over uneven ground", {}, section_6_4_model::run};

}  // namespace incognita
