#include "incognita/analysis/systems/system_motion.hpp"

#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace incognita {
namespace {

namespace odeint = boost::numeric::odeint;
using Numbers = std::vector<double>;

double drawn(const NamedRange& range, RandomStream& random) { return random.uniform(range.low, range.high); }

/// Applies the kind of motion to the start of a segment.
class Assigner {
 public:
  explicit Assigner(const SystemInstance& instance) : system_(instance.system()) {}

  /// First segment: sets every state and input that the motion assigns.
  void start(SystemPoint& point, RandomStream& random) {
    draw(random);
    for (const auto& a : system_.assignments) assign(a, point);
  }

  /// Later segments: sets disturbed states and inputs, as assigned or drawn anew.
  void next(SystemPoint& point, RandomStream& random) {
    draw(random);
    for (const int disturbed : system_.disturbed) {
      const double fresh = drawn(system_.vehicle.region[static_cast<std::size_t>(disturbed)], random);
      if (!is_assigned(disturbed)) point.x[disturbed] = fresh;
    }
    for (const auto& a : system_.assignments)
      if (a.to_input || is_disturbed(state(a))) assign(a, point);
  }

  void other_inputs(SystemPoint& point, RandomStream& random) {
    draw(random);
    for (const auto& a : system_.assignments)
      if (a.to_input) assign(a, point);
  }

 private:
  using Slots = std::vector<SymbolicSystem::Slot>;
  static int index_in(const Slots& slots, int slot) {
    return static_cast<int>(std::find(slots.begin(), slots.end(), slot) - slots.begin());
  }
  int state(const SymbolicSystem::Assignment& a) const { return index_in(system_.vehicle.states, a.target); }

  bool is_disturbed(int which) const {
    return std::count(system_.disturbed.begin(), system_.disturbed.end(), which) > 0;
  }

  bool is_assigned(int which) const {
    return std::any_of(system_.assignments.begin(), system_.assignments.end(),
                       [&](const auto& a) { return !a.to_input && state(a) == which; });
  }

  void draw(RandomStream& random) {
    system_.graph.prepare(values_, system_.columns());
    for (std::size_t i = 0; i < system_.draws.size(); ++i)
      values_.value[system_.draws[i]] = drawn(system_.draw_ranges[i], random);
  }

  void assign(const SymbolicSystem::Assignment& a, SystemPoint& point) {
    (a.to_input ? point.u[index_in(system_.inputs, a.target)] : point.x[state(a)]) = value(a, point);
  }

  double value(const SymbolicSystem::Assignment& a, const SystemPoint& point) {
    for (const auto& [slot, number] : system_.parameters) values_.value[slot] = number;
    for (std::size_t i = 0; i < system_.inputs.size(); ++i) values_.value[system_.inputs[i]] = point.u[i];
    for (std::size_t i = 0; i < system_.vehicle.states.size(); ++i)
      values_.value[system_.vehicle.states[i]] = point.x[i];
    system_.graph.evaluate(Owner::vehicle, values_, false);
    system_.graph.evaluate(Owner::motion, values_, false);
    return values_.value[a.value];
  }

  const SymbolicSystem& system_;
  ExpressionGraph::Evaluation values_;
};

SystemPoint drawn_start(const SystemInstance& instance, RandomStream& random) {
  const SymbolicSystem& s = instance.system();
  SystemPoint point{Eigen::VectorXd(instance.states()), {}, {}};
  int state = 0;
  for (const NamedRange& range : s.vehicle.region) point.x[state++] = drawn(range, random);
  for (int i = 0; i < instance.landmarks(); ++i)
    for (const NamedRange& range : s.landmark.region) point.x[state++] = drawn(range, random);
  const auto constants = s.anchor.region.size();
  point.anchors.resize(static_cast<Eigen::Index>(constants) * instance.anchors());
  for (Eigen::Index i = 0; i < point.anchors.size(); ++i)
    point.anchors[i] = drawn(s.anchor.region[static_cast<std::size_t>(i) % constants], random);
  return point;
}

void draw_inputs(SystemPoint& point, const SystemInstance& instance, RandomStream& random) {
  const auto& ranges = instance.system().input_ranges;
  point.u.resize(static_cast<Eigen::Index>(ranges.size()));
  for (std::size_t i = 0; i < ranges.size(); ++i)
    point.u[static_cast<Eigen::Index>(i)] = drawn(ranges[i], random);
}

std::string written_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

[[noreturn]] void refuse_blow_up(const SystemInstance& instance, double duration) {
  const SymbolicSystem& s = instance.system();
  const auto& rates = s.vehicle.rates.empty() ? s.landmark.rates : s.vehicle.rates;
  throw SystemError(rates.empty() ? SourceLocation{} : s.graph[rates[0]].location,
                    "the motion cannot be integrated over " + written_number(duration) +
                        " s: it diverges, or is too fast; choose another region or a shorter "
                        "segment_duration_s");
}

/// Integrates from t = 0 to `duration` with held inputs. `transition`: n x any, in the units of the states
/// (du = D^-1 dx, D those units), propagated by dY = D^-1 F D Y dt; may have no columns.
void integrate(const SystemInstance& instance, SystemPoint& at, Eigen::MatrixXd& transition,
               double duration) {
  const Eigen::Index n = instance.states(), columns = transition.cols();
  const Eigen::VectorXd& units = instance.units();
  const Eigen::VectorXd start = at.x.cwiseQuotient(units);
  Numbers y(start.begin(), start.end());
  y.insert(y.end(), transition.data(), transition.data() + transition.size());
  SystemPoint now = at;
  const auto rates = [&](const Numbers& from, Numbers& rate, double) {
    now.x = units.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(from.data(), n));
    if (!now.x.allFinite()) refuse_blow_up(instance, duration);
    Eigen::Map<Eigen::VectorXd>(rate.data(), n) = instance.rate(now).cwiseQuotient(units);
    if (columns == 0) return;
    const Eigen::MatrixXd F =
        units.cwiseInverse().asDiagonal() * instance.rate_derivative(now) * units.asDiagonal();
    Eigen::Map<Eigen::MatrixXd>(rate.data() + n, n, columns) =
        F * Eigen::Map<const Eigen::MatrixXd>(from.data() + n, n, columns);
  };
  const auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<Numbers>>(1e-12, 1e-12);
  int steps = 0;
  try {
    odeint::integrate_adaptive(stepper, rates, y, 0.0, duration, duration / 10, [&](const Numbers&, double) {
      constexpr int most_steps = 20'000;  // per call
      if (++steps > most_steps) refuse_blow_up(instance, duration);
    });
  } catch (const odeint::odeint_error&) {
    refuse_blow_up(instance, duration);
  }
  at.x = units.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(y.data(), n));
  transition = Eigen::Map<const Eigen::MatrixXd>(y.data() + n, n, columns);
}

}  // namespace

SystemMotion draw_motion(const SystemInstance& instance, int segments, RandomStream& random) {
  if (segments < 1) throw std::invalid_argument("the number of segments must be at least 1");
  const double duration = instance.system().text.segment_duration_s;
  Assigner assigner(instance);
  SystemPoint point = drawn_start(instance, random);
  draw_inputs(point, instance, random);
  assigner.start(point, random);
  SystemMotion motion;
  const auto others = 2 * point.u.size() + static_cast<Eigen::Index>(instance.system().draws.size());
  for (Eigen::Index i = 0; i < others; ++i) {
    SystemPoint other = point;
    draw_inputs(other, instance, random);
    assigner.other_inputs(other, random);
    motion.other_inputs.push_back(other.u);
  }
  for (int segment = 0; segment < segments; ++segment) {
    motion.segments.push_back({point, duration});
    Eigen::MatrixXd no_transition(instance.states(), 0);
    integrate(instance, point, no_transition, duration);
    draw_inputs(point, instance, random);
    assigner.next(point, random);
  }
  // Inputs that enter nonlinearly may distinguish as many rates as there are states
  while (point.u.size() > 0 && static_cast<int>(motion.other_inputs.size()) < instance.states()) {
    SystemPoint other = motion.segments.front().start;
    draw_inputs(other, instance, random);
    assigner.other_inputs(other, random);
    motion.other_inputs.push_back(other.u);
  }
  return motion;
}

namespace {

/// Time of a measurement within its segment, as a fraction: 0 at the start, 1 at the end, and jittered between by the
/// golden ratio, differently in every segment, so that no oscillation is sampled at a constant phase.
double moment(std::size_t segment, int measurement, int measurements) {
  if (measurement == 0 || measurement == measurements) return measurement == 0 ? 0 : 1;
  const double golden = 0.6180339887498949,
               turns = golden * (static_cast<double>(segment) * measurements + measurement);
  return (measurement + 0.6 * (turns - std::floor(turns) - 0.5)) / measurements;
}

/// Transition of initial differences and later jumps, both in the units of the states.
class Transition {
 public:
  Transition(const SystemInstance& instance, std::size_t segments) : instance_(instance) {
    const auto& disturbed = instance.system().disturbed;
    const Eigen::Index n = instance.states();
    jump_units_.resize(static_cast<Eigen::Index>(disturbed.size() * (segments - 1)));
    for (Eigen::Index i = 0; i < jump_units_.size(); ++i)
      jump_units_[i] = instance.units()[disturbed[static_cast<std::size_t>(i) % disturbed.size()]];
    matrix_ = Eigen::MatrixXd::Zero(n, n + jump_units_.size());
    matrix_.leftCols(n).setIdentity();
  }

  /// Start of segment `segment` >= 1: its disturbed states may jump.
  void jump(std::size_t segment) {
    const auto& disturbed = instance_.system().disturbed;
    const auto first = static_cast<Eigen::Index>((segment - 1) * disturbed.size()) + instance_.states();
    for (std::size_t i = 0; i < disturbed.size(); ++i)
      matrix_(disturbed[i], first + static_cast<Eigen::Index>(i)) += 1;
  }

  MotionSample sample(double t, const SystemPoint& at) const {
    const Eigen::VectorXd& units = instance_.units();
    const auto n = instance_.states();
    return {
        t, at, units.asDiagonal() * matrix_.leftCols(n) * units.cwiseInverse().asDiagonal(),
        units.asDiagonal() * matrix_.rightCols(jump_units_.size()) * jump_units_.cwiseInverse().asDiagonal()};
  }

  Eigen::MatrixXd& matrix() { return matrix_; }

 private:
  const SystemInstance& instance_;
  Eigen::VectorXd jump_units_;
  Eigen::MatrixXd matrix_;
};

}  // namespace

std::vector<MotionSample> follow(const SystemInstance& instance, const SystemMotion& motion,
                                 int per_segment) {
  Transition transition(instance, motion.segments.size());
  std::vector<MotionSample> samples;
  double t = 0;
  for (std::size_t k = 0; k < motion.segments.size(); ++k) {
    const MotionSegment& segment = motion.segments[k];
    SystemPoint at = segment.start;
    if (k > 0) transition.jump(k);
    for (int i = 0; i < per_segment; ++i) {
      samples.push_back(transition.sample(t, at));
      const double until = moment(k, i + 1, per_segment) * segment.duration_s;
      const double stretch = until - moment(k, i, per_segment) * segment.duration_s;
      integrate(instance, at, transition.matrix(), stretch);
      t += stretch;
    }
    if (k + 1 == motion.segments.size()) samples.push_back(transition.sample(t, at));
  }
  return samples;
}

}  // namespace incognita
