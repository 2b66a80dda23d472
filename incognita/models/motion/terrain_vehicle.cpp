#include "incognita/models/motion/terrain_vehicle.hpp"

namespace incognita {
namespace {

using Vehicle = TerrainVehicle;
using Row = Eigen::RowVector3d;  // derivatives by x, y, heading

/// d(state)/dt with its Jacobians.
struct Rate {
  Vehicle::State<double> value;
  Eigen::Matrix3d by_state;
  Eigen::Matrix<double, 3, 2> by_input;
};

/// Derivatives of the members of Vehicle::Contact by the state.
struct ContactJacobian {
  Row m, k, b, L, N;
};

ContactJacobian differentiate(const Vehicle::Contact<double>& on) {
  const auto& g = on.ground;
  const double c = on.c, s = on.s;
  const double across = c * s * (g.yy - g.xx) + (c * c - s * s) * g.xy;  // h_ij along_i left_j
  ContactJacobian d;
  d.m << c * g.xx + s * g.xy, c * g.xy + s * g.yy, on.k;
  d.k << c * g.xy - s * g.xx, c * g.yy - s * g.xy, -on.m;
  d.b << c * c * g.xxx + 2 * c * s * g.xxy + s * s * g.xyy, c * c * g.xxy + 2 * c * s * g.xyy + s * s * g.yyy,
      2 * across;
  d.L = on.m / on.L * d.m;
  d.N << (g.x * g.xx + g.y * g.xy) / on.N, (g.x * g.xy + g.y * g.yy) / on.N, 0;
  return d;
}

Rate rate_with_jacobians(const Vehicle& vehicle, const Vehicle::State<double>& x,
                         const Vehicle::Input<double>& u) {
  const auto on = vehicle.contact<double>(x);
  const ContactJacobian d = differentiate(on);
  const double along = u[0] / on.L, by_turn = on.L * on.L / on.N;
  const double by_speed = -on.b * on.k / (on.N * on.N * on.L);  // d(heading') / dv
  const Row d_turn = on.L / on.N * (2 * d.L - on.L / on.N * d.N);
  const Row d_speed = -(on.k * d.b + on.b * d.k) / (on.N * on.N * on.L) -  //
                      by_speed * (2 / on.N * d.N + d.L / on.L);
  Rate rate{vehicle.rate<double>(x, u), {}, {}};
  rate.by_state.row(0) = -along * on.c / on.L * d.L - along * on.s * Row::UnitZ();
  rate.by_state.row(1) = -along * on.s / on.L * d.L + along * on.c * Row::UnitZ();
  rate.by_state.row(2) = u[1] * d_turn + u[0] * d_speed;
  rate.by_input << on.c / on.L, 0, on.s / on.L, 0, by_speed, by_turn;
  return rate;
}

/// TerrainVehicle::runge_kutta differentiated by the chain rule, stage by stage.
Vehicle::Step piece(const Vehicle& vehicle, const Vehicle::State<double>& x, const Vehicle::Input<double>& u,
                    double dt) {
  Vehicle::Step step{vehicle.runge_kutta<double>(x, u, dt), Vehicle::Jacobian::Identity(),
                     Vehicle::InputJacobian::Zero()};
  // Rate of a stage, with its Jacobians by state and input at the start of the piece
  Rate stage{Vehicle::State<double>::Zero(), Vehicle::Jacobian::Zero(), Vehicle::InputJacobian::Zero()};
  constexpr double reach[] = {0, 0.5, 0.5, 1}, weight[] = {1, 2, 2, 1};
  for (int i = 0; i < 4; ++i) {
    const double h = reach[i] * dt;
    const Rate here = rate_with_jacobians(vehicle, x + h * stage.value, u);
    stage.value = here.value;
    stage.by_state = (here.by_state * (Vehicle::Jacobian::Identity() + h * stage.by_state)).eval();
    stage.by_input = (h * here.by_state * stage.by_input + here.by_input).eval();
    step.F += weight[i] * dt / 6 * stage.by_state;
    step.G += weight[i] * dt / 6 * stage.by_input;
  }
  return step;
}

}  // namespace

Vehicle::Step Vehicle::step(const State<double>& x, const Input<double>& u, double dt) const {
  const int n = pieces<double>(u, dt);
  Step step{x, Jacobian::Identity(), InputJacobian::Zero()};
  for (int i = 0; i < n; ++i) {
    const Step next = piece(*this, step.x, u, dt / n);
    step.x = next.x;
    step.F = (next.F * step.F).eval();
    step.G = (next.F * step.G + next.G).eval();
  }
  return step;
}

/// The right rotation error e of the axes t, l, n: e1 = dl . n = -l . dn, e2 = -dt . n, e3 = dt . l.
PoseOf<Vehicle::error_size> Vehicle::pose(const State<double>& x) const {
  const auto on = contact<double>(x);
  const auto& g = on.ground;
  const ContactJacobian d = differentiate(on);
  const Eigen::Matrix3d R = axes<double>(x);
  PoseOf<error_size> out{{position<double>(x), quaternion_from_matrix(R)}, {}};
  out.J.topRows<3>() << 1, 0, 0, 0, 1, 0, g.x, g.y, 0;
  const Eigen::Matrix2d curvature = (Eigen::Matrix2d() << g.xx, g.xy, g.xy, g.yy).finished();
  const Eigen::RowVector2d roll = R.col(1).head<2>().transpose() * curvature / on.N;
  out.J.bottomRows<3>() << roll, 0,       //
      -d.m.head<2>() / (on.N * on.L), 0,  //
      d.m.head<2>() * on.k / (on.N * on.L * on.L), on.N / (on.L * on.L);
  return out;
}

}  // namespace incognita
