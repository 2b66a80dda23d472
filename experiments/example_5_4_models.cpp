// Example 5.4, (5.24)-(5.27): the equations of the free camera against the motion they sample and against
// each other.
#include "experiments/common.hpp"
#include "experiments/example_5_4.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/plant.hpp"

namespace incognita::swinging_camera {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;
using State = FreeCameraMotion::State<double>;
using Input = FreeCameraMotion::Input<double>;

constexpr int places = 100;
constexpr double dt = 0.05;  // s

Vector3d drawn(RandomStream& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

State random_state(RandomStream& random) {
  State x;
  x << drawn(random, 2), quaternion_exp<double>(drawn(random, 1.5)), drawn(random, 1), drawn(random, 1);
  return x;
}

Input random_input(RandomStream& random) {
  Input u;
  u << drawn(random, 3), drawn(random, 3);
  return u;
}

/// Where the accelerations lead when they are held for dt: integrated.
State moved(const State& x, const Input& u) {
  const SmallVector none = SmallVector::Zero(6), most = SmallVector::Constant(6, 1e9);
  Plant plant(FreeCameraMotion{}, {x, SmallVector::Zero(12), none, -most, most}, 1, "free");
  return plant.move(u, dt);
}

/// The matrix of q -> q (0, w).
Matrix4d product_by(const Vector3d& w) {
  Matrix4d M;
  for (int i = 0; i < 4; ++i)
    M.col(i) = quaternion_product<double>(Vector4d::Unit(i), Vector4d(0, w.x(), w.y(), w.z()));
  return M;
}

Claim quaternion_step() {
  RandomStream random(1, "rates");
  Worst worst;
  double longer = 0;
  for (int i = 0; i < places; ++i) {
    const State x = random_state(random);
    const Vector4d truth = moved(x, Input::Zero()).segment<4>(3);
    const Vector3d w = x.tail<3>();
    const double half = w.norm() * dt / 2;
    const auto turned = [&](double factor) -> Vector4d {
      const Matrix4d P =
          std::cos(half) * Matrix4d::Identity() + factor / w.norm() * std::sin(half) * product_by(w);
      return P * x.segment<4>(3);
    };
    const auto off = [&](const Vector4d& q) { return angle_between_rad(truth, q.normalized()); };
    worst.take(off(turned(2)), off(turned(1)));
    longer = std::max(longer, turned(2).norm() - 1);
  }
  return assessed(
      "5.4-quaternion", "(5.25)", "P q is the orientation after dt at the rate w, to 1e-9 rad",
      {.printed = "cos(dt |W|/2) I + 2/|W| sin(dt |W|/2) W_x",
       .measured = {"against the motion integrated over 50 ms at {} rates up to 1 rad/s an axis: printed off "
                    "by up to {:.2g} rad, and its quaternion longer than 1 by {:.2g}; with 1/|W| {}",
                    places, worst.printed, longer, below(worst.ours)},
       .number = exactly("largest error of the printed orientation", 1e3 * worst.printed, "mrad"),
       .why = "1/|W|, W_x being the matrix of the product with (0, w): with the 2 the rotation is about "
              "twice as large",
       .runs = places},
      worst, 1e-9);
}

Claim sampled_motion() {
  RandomStream random(2, "states");
  Worst worst;  // ours: for an impulse
  double held = 0, old_rate = 0, new_rate = 0;
  for (int i = 0; i < places; ++i) {
    const State x = random_state(random);
    const Input u = random_input(random);
    const State truth = moved(x, u);
    const Vector3d f = u.head<3>(), step = truth.head<3>() - x.head<3>(), v = x.segment<3>(7);
    State struck = x;
    struck.segment<3>(7) += f * dt, struck.tail<3>() += u.tail<3>() * dt;
    const Vector3d by_impulse = moved(struck, Input::Zero()).head<3>() - x.head<3>();
    worst.take((step - (v + f * dt) * dt).norm(), (by_impulse - (v + f * dt) * dt).norm());
    held = std::max(held, (step - (v * dt + f * dt * dt / 2)).norm());
    const auto off = [&](const Vector3d& rate) {
      const Vector4d q = quaternion_product<double>(x.segment<4>(3), quaternion_exp<double>(rate * dt));
      return angle_between_rad(truth.segment<4>(3), q);
    };
    old_rate = std::max(old_rate, off(x.tail<3>()));
    new_rate = std::max(new_rate, off(x.tail<3>() + u.tail<3>() * dt));
  }
  return assessed(
      "5.4-sampled", "(5.24)", "Where the camera is after accelerations were held for dt, to 1e-9 m",
      {.printed = "p + (v + f dt) dt",
       .measured = {"against the motion integrated over 50 ms with up to 3 m/s^2 and 3 rad/s^2 an axis: "
                    "printed off by up to {:.1f} mm, p + v dt + f dt^2/2 {}; the orientation by {:.1f} mrad "
                    "with the old rate, as printed, and by {:.1f} with the new one. Of impulses f dt at the "
                    "start of the tick the printed position is off {}",
                    1e3 * worst.printed, below(held), 1e3 * old_rate, 1e3 * new_rate, below(worst.ours)},
       .number = exactly("largest error of the printed position after 50 ms", 1e3 * worst.printed, "mm"),
       .why = "if the input is an impulse at the start of the tick. Accelerations that are held move the "
              "camera by half of f dt^2",
       .runs = places},
      worst.printed <= 1e-9, on_condition(worst.ours <= 1e-9 && held <= 1e-9));
}

Claim linear_input() {
  RandomStream random(3, "inputs");
  Worst worst;
  double turned = 0;
  const FreeCameraMotion motion;
  for (int i = 0; i < places; ++i) {
    const State x = random_state(random);
    const Input a = random_input(random), b = random_input(random);
    const auto after = [&](const Input& u) { return motion.f<double>(x, u, dt); };
    const Vector3d by_input = (after(a) - after(Input::Zero())).head<3>();
    worst.take((by_input - a.head<3>()).norm(), (by_input - dt * dt * a.head<3>()).norm());
    const State bent = after(a + b) - after(a) - after(b) + after(Input::Zero());
    turned = std::max(turned, bent.segment<4>(3).norm());
  }
  return assessed(
      "5.4-linear", "below (5.28)",
      "(5.24) is linear in the input: what f adds to the camera's position in a tick, to 1e-12 m",
      {.printed = "Q_r = I, so that u is the new input itself",
       .measured = {"{} states and inputs, 50 ms: with I off by {:.1f} m, with dt^2 I {}. The orientation is "
                    "not linear: superposition fails by up to {:.1g} in q",
                    places, worst.printed, below(worst.ours), turned},
       .number = exactly("largest difference of the printed form", worst.printed, "m"),
       .why =
           "Q_r = dt^2 I; f reaches the position through the velocity, which is why (5.29) needs two gains",
       .runs = places},
      worst, 1e-12);
}

/// (5.26) and (5.27) as printed.
Vector2d printed_pixel(const WideAngleCamera& c, const Vector3d& at, double K_d) {
  const double uc = c.fu * at.x() / at.z(), vc = c.fv * at.y() / at.z();
  const double d = 1 + K_d * (uc * uc + vc * vc);
  return {c.u0 - uc / std::sqrt(d), c.v0 - vc / std::sqrt(d)};
}

Claim lens_signs() {
  RandomStream random(4, "points");
  WideAngleCamera davison;
  davison.u0 = 162, davison.v0 = 125, davison.kd1 = 9e-6;
  Worst worst;
  double half = 0;
  for (int i = 0; i < places;) {
    const Vector3d at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(0.5, 5));
    const Vector2d z = davison.h<double>(at);
    if (!lens().contains(z)) continue;
    ++i;
    const Vector3d left_up(-at.x(), -at.y(), at.z());
    worst.take((printed_pixel(davison, at, 2 * davison.kd1) - z).norm(),
               (printed_pixel(davison, left_up, 2 * davison.kd1) - z).norm());
    half = std::max(half, (printed_pixel(davison, left_up, davison.kd1) - z).norm());
  }
  return assessed(
      "5.4-lens", "(5.26), (5.27)",
      "Pixel of a point in camera axes (z ahead, x to the right, y down), to 1e-9 pixels",
      {.printed = "u = u0 - u_c/sqrt(d), d = 1 + K_d (u_c^2 + v_c^2)",
       .measured = {"{} points in view of Davison's lens: printed off by up to {:.0f} pixels, {} with x to "
                    "the left and y up. With the published kd1 taken for K_d, by {:.1f} pixels",
                    places, worst.printed, below(worst.ours), half},
       .number = exactly("largest error with x to the right and y down", worst.printed, "pixels"),
       .why = "if x is to the left and y up, as in SceneLib, and K_d is 2 kd1 of its calibrations",
       .runs = places},
      worst.printed <= 1e-9, on_condition(worst.ours <= 1e-9));
}

Claim unit_norm() {
  const Course course = run({}, 1);
  double off = 0;
  for (const Instant& i : course.instants) off = std::max(off, std::abs(i.mean.segment<4>(3).norm() - 1));
  return assessed(
      "5.4-norm", "below (5.25)",
      "Normalizing at each update removes the redundancy of the quaternion: its length is 1 to 1e-12, and "
      "three numbers parametrize the error of the orientation",
      {.measured = {"after {} updates {}", course.instants.size(), below(off)}}, off <= 1e-12);
}

}  // namespace

std::vector<Claim> model_claims() {
  return {sampled_motion(), quaternion_step(), unit_norm(), lens_signs(), linear_input()};
}

}  // namespace incognita::swinging_camera
