// Properties of every registered motion model and of its integrator.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "incognita/math/random.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/registered.hpp"

namespace incognita {
namespace {

template <class M>
struct Plain {
  using Model = M;
  static std::vector<M> examples() { return registered::examples<M>(); }
};
template <class M>
struct Integrated {
  using Model = typename M::Integrator;
  static std::vector<Model> examples() {
    std::vector<Model> all;
    for (const M& model : registered::examples<M>()) all.push_back(integrator_of(model));
    return all;
  }
};

template <class M>
using PlainAndIntegrated = std::conditional_t<std::is_same_v<M, typename M::Integrator>, std::tuple<Plain<M>>,
                                              std::tuple<Plain<M>, Integrated<M>>>;
template <class Tuple>
struct AsTypes;
template <class... T>
struct AsTypes<std::tuple<T...>> {
  using type = ::testing::Types<T...>;
};
template <class Variant>
struct AllOf;
template <class... M>
struct AllOf<std::variant<M...>> {
  using type = typename AsTypes<decltype(std::tuple_cat(std::declval<PlainAndIntegrated<M>>()...))>::type;
};
using Motions = AllOf<AnyMotion>::type;

template <class Tag>
class MotionLaws : public ::testing::Test {
 protected:
  using M = typename Tag::Model;
  using State = typename M::template State<double>;
  using Input = typename M::template Input<double>;
  using Error = Eigen::Matrix<double, M::error_size, 1>;
  using Plus = Eigen::Matrix<double, M::state_size, M::error_size>;
  using Minus = Eigen::Matrix<double, M::error_size, M::state_size>;

  struct Case {
    State x;
    Input u;
    double dt;
  };

  static State plus(State x, const Error& e) {
    M::chart.plus(std::span<double>(x.data(), x.size()), std::span<const double>(e.data(), e.size()));
    return x;
  }
  static Error minus(const State& y, const State& x) {
    Error e;
    M::chart.minus(std::span<const double>(y.data(), y.size()), std::span<const double>(x.data(), x.size()),
                   std::span<double>(e.data(), e.size()));
    return e;
  }

  /// A random state: the chart reaches all states from any valid one.
  static State state(RandomStream& random, double scale) {
    Error e;
    for (double& number : e) number = scale * random.normal();
    return plus(origin(), e);
  }

  /// First indices of the quaternions in the state: adding an error to four zeros leaves zeros, and changes
  /// all other parts.
  static std::vector<int> quaternions() {
    std::vector<int> found;
    const State moved = plus(State::Zero(), Error::Constant(0.1));
    for (int i = 0; i < M::state_size; ++i) {
      if (moved[i] != 0) continue;
      found.push_back(i);
      i += 3;
    }
    return found;
  }

  static State origin() {
    State x = State::Zero();
    for (const int i : quaternions()) x[i] = 1;
    return x;
  }

  /// Calls with(state index, error index, count of states) for each quaternion and each other component.
  template <class F>
  static void for_each_part(F with) {
    const std::vector<int> begins = quaternions();
    for (int i = 0, k = 0; i < M::state_size;) {
      const int size = std::find(begins.begin(), begins.end(), i) == begins.end() ? 1 : 4;
      with(i, k, size);
      i += size;
      k += size == 4 ? 3 : 1;
    }
  }

  /// At rest, slow, ordinary, fast; zero time, one frame, long; zero input, some, much.
  static std::vector<Case> cases() {
    RandomStream random(1, "motion");
    std::vector<Case> all;
    for (const double scale : {0.0, 1e-9, 1e-5, 1.0, 30.0})
      for (const double dt : {0.0, 1e-6, 1.0 / 30, 0.5})
        for (const double push : {0.0, 1.0, 50.0}) {
          Case one{state(random, scale), Input::Zero(), dt};
          for (double& number : one.u) number = push * random.normal();
          all.push_back(one);
        }
    return all;
  }

  /// The exact motion over `dt`, by many small fourth-order steps.
  static State integrated(const M& model, State x, const Input& u, double dt) {
    constexpr int steps = 16;
    const double h = dt / steps;
    const auto rate = [&](const State& at) -> State { return model.template rate<double>(at, u); };
    for (int i = 0; i < steps; ++i) {
      const State a = rate(x), b = rate(x + h / 2 * a), c = rate(x + h / 2 * b), d = rate(x + h * c);
      x += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return x;
  }

  /// d(x (+) e)/de at e = 0: q exp(e/2) is q (1, e/2) to first order.
  static Plus d_plus(const State& x) {
    Plus J = Plus::Zero();
    for_each_part([&](int i, int k, int size) {
      if (size == 1) {
        J(i, k) = 1;
        return;
      }
      for (int axis = 0; axis < 3; ++axis) {
        Vector4<double> half = Vector4<double>::Zero();
        half[1 + axis] = 0.5;
        J.template block<4, 1>(i, k + axis) = quaternion_product<double>(x.template segment<4>(i), half);
      }
    });
    return J;
  }

  /// d(y (-) x)/dy at y = x: log of (1, v) is 2 v to first order.
  static Minus d_minus(const State& x) {
    Minus J = Minus::Zero();
    for_each_part([&](int i, int k, int size) {
      if (size == 1) {
        J(k, i) = 1;
        return;
      }
      for (int column = 0; column < 4; ++column) {
        const Vector4<double> difference = quaternion_product<double>(
            quaternion_conjugate<double>(x.template segment<4>(i)), Vector4<double>::Unit(column));
        J.template block<3, 1>(k, i + column) = 2 * difference.tail<3>();
      }
    });
    return J;
  }
};

TYPED_TEST_SUITE(MotionLaws, Motions);

TYPED_TEST(MotionLaws, JacobiansAreExact) {
  using Model = typename TypeParam::Model;
  constexpr int states = Model::state_size, inputs = Model::input_size, all = states + inputs;
  for (const Model& model : TypeParam::examples())
    for (const auto& [x, u, dt] : this->cases()) {
      const auto y = model.template f<Dual<all>>(variables<all>(x), variables<all>(u, states), dt);
      const Eigen::Matrix<double, states, all> J = derivatives<all, states>(y);
      const auto step = model.step(x, u, dt);
      const typename Model::Jacobian F =
          this->d_minus(step.x) * J.template leftCols<states>() * this->d_plus(x);
      const typename Model::InputJacobian G = this->d_minus(step.x) * J.template rightCols<inputs>();
      EXPECT_LE((step.F - F).norm(), 1e-13 * F.norm())
          << "x " << x.transpose() << " u " << u.transpose() << " dt " << dt << "\ncoded\n"
          << step.F << "\nexact\n"
          << F;
      EXPECT_LE((step.G - G).norm(), 1e-13 * G.norm())
          << "x " << x.transpose() << " u " << u.transpose() << " dt " << dt << "\ncoded\n"
          << step.G << "\nexact\n"
          << G;
    }
}

TYPED_TEST(MotionLaws, StepIsF) {
  using Model = typename TypeParam::Model;
  for (const Model& model : TypeParam::examples())
    for (const auto& [x, u, dt] : this->cases())
      EXPECT_EQ(model.step(x, u, dt).x, model.template f<double>(x, u, dt));
}

TYPED_TEST(MotionLaws, ZeroTimeChangesNothing) {
  using Model = typename TypeParam::Model;
  for (const Model& model : TypeParam::examples())
    for (const auto& [x, u, dt] : this->cases()) {
      const auto step = model.step(x, u, 0);
      EXPECT_LE((step.x - x).norm(), 4e-16 * std::max(1.0, x.norm()));
      EXPECT_EQ(step.F, typename Model::Jacobian(Model::Jacobian::Identity()));
      EXPECT_EQ(step.G.norm(), 0);
    }
}

/// A step agrees with rate() to first order at least: halving dt divides the error by four, where a wrong
/// rate would halve it. Errors far below the second order of a step pass: a third derivative may jump, e.g.
/// between cells of a height map.
TYPED_TEST(MotionLaws, AShortStepFollowsTheRate) {
  using Model = typename TypeParam::Model;
  for (const Model& model : TypeParam::examples())
    for (const auto& [x, u, unused] : this->cases()) {
      const auto missed = [&, &x = x, &u = u](double dt) {
        return this->minus(model.template f<double>(x, u, dt), this->integrated(model, x, u, dt)).norm();
      };
      const double speed = model.template rate<double>(x, u).norm() + u.norm();
      for (const double dt : {1e-2 / (1 + speed), 1e-4 / (1 + speed)}) {
        const double let_pass = 1e-3 * std::pow(dt * speed, 2) + 1e-13 * (1 + x.norm());
        EXPECT_LE(missed(dt / 2), 0.27 * missed(dt) + let_pass)
            << "x " << x.transpose() << " u " << u.transpose() << " dt " << dt;
        EXPECT_LE(missed(dt), 0.1 * dt * speed + let_pass)
            << "x " << x.transpose() << " u " << u.transpose() << " dt " << dt;
      }
    }
}

TYPED_TEST(MotionLaws, InputNoiseOnlyAddsUncertainty) {
  using Model = typename TypeParam::Model;
  RandomStream random(1, "noise");
  for (const Model& model : TypeParam::examples())
    for (const auto& [x, u, dt] : this->cases()) {
      Eigen::Matrix<double, Model::input_size, 1> variances;
      for (double& variance : variances) variance = std::pow(10.0, random.uniform(-4, 2));
      const auto G = model.step(x, u, dt).G;
      const Eigen::MatrixXd noise = G * variances.asDiagonal() * G.transpose();
      ASSERT_TRUE(noise.allFinite());
      EXPECT_LE((noise - noise.transpose()).norm(), 1e-15 * noise.norm());
      const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(noise).eigenvalues();
      EXPECT_GE(eigenvalues.minCoeff(), -1e-13 * noise.norm()) << "dt " << dt;
      if (dt > 1e-3 && u.norm() > 0) {  // steering does not move a car at rest
        // Of G with columns of length 1: those of a wild state differ by orders of magnitude
        const Eigen::MatrixXd directions = G.colwise().normalized();
        EXPECT_EQ(directions.fullPivLu().rank(), Model::input_size) << "every input reaches the state";
      }
    }
}

TYPED_TEST(MotionLaws, FirstOrderPredictsSmallErrors) {
  using Model = typename TypeParam::Model;
  RandomStream random(1, "small errors");
  for (const Model& model : TypeParam::examples())
    for (const auto& [x, u, dt] : this->cases()) {
      typename TestFixture::Error e;
      for (double& number : e) number = 1e-4 * random.normal();
      const auto step = model.step(x, u, dt);
      const auto moved = this->minus(model.template f<double>(this->plus(x, e), u, dt), step.x);
      EXPECT_LE((moved - step.F * e).norm(), 10 * step.F.norm() * e.squaredNorm() + 1e-13 * x.norm())
          << "dt " << dt;
    }
}

}  // namespace
}  // namespace incognita
