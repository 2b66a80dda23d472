#include "incognita/world/integrate.hpp"

#include <boost/numeric/odeint.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace incognita {
namespace {

namespace odeint = boost::numeric::odeint;
using Numbers = std::vector<double>;

// Meters, radians and their rates: far below sensor resolution, and cheap at 30 ticks per second
constexpr double tolerance = 1e-10;
constexpr int most_steps = 100000;  // per tick: about a second of computation

std::span<double> numbers(SmallVector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace

SmallVector integrate(const AnyMotion& motion, const SmallVector& state, const SmallVector& input,
                      double dt_s) {
  const auto n = state.size();
  Numbers x(state.begin(), state.end());
  const auto rate = [&](const Numbers& at, Numbers& dx, double) {
    Eigen::Map<Eigen::VectorXd>(dx.data(), n) =
        rate_of(motion, Eigen::Map<const Eigen::VectorXd>(at.data(), n), input);
  };
  const auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<Numbers>>(tolerance, tolerance);
  odeint::integrate_adaptive(stepper, rate, x, 0.0, dt_s, dt_s, [steps = 0](const Numbers&, double) mutable {
    if (++steps > most_steps)
      throw std::runtime_error("the motion of a tick needs more than " + std::to_string(most_steps) +
                               " steps: the ground is too rough or the vehicle too fast; use shorter ticks");
  });
  SmallVector after = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  SmallVector nothing = SmallVector::Zero(chart_of(motion).tangent());
  chart_of(motion).plus(numbers(after), numbers(nothing));
  return after;
}

}  // namespace incognita
