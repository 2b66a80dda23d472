// A long sequence of random operations: each agrees with the dense formula, and the covariance stays
// positive.
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

constexpr int operations = 100000, most_errors = 45;

class Life {
 public:
  Life() {
    vehicles_ = {belief_.add_vehicle(Chart{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}},
                                     Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()),
                 belief_.add_vehicle(Chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}},
                                     (Eigen::VectorXd(7) << 0, 0, 0, 1, 0, 0, 0).finished(),
                                     Eigen::MatrixXd::Identity(6, 6))};
  }

  const Belief& belief() const { return belief_; }

  /// One random operation; returns the expected covariance after it.
  Eigen::MatrixXd step() {
    const int draw = random_.below(100);
    if (draw < 40) return predict();
    if (draw < 80) return update();
    if (belief_.errors() > most_errors || (draw >= 97 && !landmarks_.empty())) return drop();
    if (draw < 90 || landmarks_.empty()) return augment();
    return replace();
  }

 private:
  BlockId any(const std::vector<BlockId>& ids) { return ids[random_.below(static_cast<int>(ids.size()))]; }
  Eigen::MatrixXd noise(int size) { return 0.05 * random_covariance(random_, size); }

  Eigen::MatrixXd predict() {
    const BlockId id = any(vehicles_);
    const int size = belief_.chart(id).tangent(), first = belief_.offset(id), n = belief_.errors();
    Eigen::MatrixXd A = 0.1 * random_matrix(random_, size, size);
    A.diagonal().array() += 0.9;
    const Eigen::MatrixXd N = noise(size);
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(n, n);
    F.block(first, first, size, size) = A;
    Eigen::MatrixXd expected = F * belief_.dense_covariance() * F.transpose();
    expected.block(first, first, size, size) += N;
    belief_.predict({id, belief_.mean(id), A, N});
    return expected;
  }

  Eigen::MatrixXd update() {
    std::vector<LinearizedMeasurement> measurements;
    for (int i = 1 + random_.below(4); i > 0; --i) {
      std::vector<BlockId> blocks = {any(vehicles_)};
      if (!landmarks_.empty()) blocks.push_back(any(landmarks_));
      measurements.push_back(random_measurement(random_, belief_, 1 + random_.below(3), blocks));
    }
    const Eigen::MatrixXd expected =
        textbook_update(belief_.dense_covariance(), Stacked(belief_, measurements)).P;
    EXPECT_EQ(belief_.update(measurements).outcome, UpdateReport::Outcome::updated);
    return expected;
  }

  Eigen::MatrixXd augment() {
    const BlockId from = any(vehicles_);
    const int size = random_.below(2) == 0 ? 3 : 6, old = belief_.errors();
    const Belief::Parent parent{from, random_matrix(random_, size, belief_.chart(from).tangent())};
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(old + size, old);
    G.topRows(old).setIdentity();
    G.block(old, belief_.offset(from), size, parent.J.cols()) = parent.J;
    const Eigen::MatrixXd N = noise(size);
    Eigen::MatrixXd expected = G * belief_.dense_covariance() * G.transpose();
    expected.bottomRightCorner(size, size) += N;
    landmarks_.push_back(belief_.augment(Chart::line(size), Eigen::VectorXd::Zero(size), {&parent, 1}, N));
    return expected;
  }

  Eigen::MatrixXd replace() {
    const BlockId id = any(landmarks_);
    const int size = belief_.chart(id).tangent(), first = belief_.offset(id), n = belief_.errors();
    const Eigen::MatrixXd J = random_matrix(random_, 3, size) / std::sqrt(size), N = noise(3);
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n - size + 3, n);
    G.topLeftCorner(first, first).setIdentity();
    G.block(first, first, 3, size) = J;
    G.bottomRightCorner(n - first - size, n - first - size).setIdentity();
    Eigen::MatrixXd expected = G * belief_.dense_covariance() * G.transpose();
    expected.block(first, first, 3, 3) += N;
    belief_.replace(id, Chart::line(3), Eigen::Vector3d::Zero(), J, N);
    return expected;
  }

  Eigen::MatrixXd drop() {
    const int which = random_.below(static_cast<int>(landmarks_.size()));
    const BlockId id = landmarks_[which];
    const int size = belief_.chart(id).tangent(), first = belief_.offset(id);
    std::vector<int> kept;
    for (int i = 0; i < belief_.errors(); ++i)
      if (i < first || i >= first + size) kept.push_back(i);
    const Eigen::MatrixXd expected = belief_.dense_covariance()(kept, kept);
    belief_.drop(id);
    landmarks_.erase(landmarks_.begin() + which);
    return expected;
  }

  RandomStream random_{2026, "life"};
  Belief belief_{1};
  std::vector<BlockId> vehicles_, landmarks_;
};

TEST(Endurance, CovarianceStaysValidUnderAnyOrderOfOperations) {
  Life life;
  for (int i = 0; i < operations; ++i) {
    const Eigen::MatrixXd expected = life.step();
    ASSERT_TRUE(close_covariance(life.belief().dense_covariance(), expected, expected, 1e-8))
        << "operation " << i;
    if (i % 50 == 0) {
      ASSERT_TRUE(positive_definite(life.belief().dense_covariance())) << "operation " << i;
    }
  }
}

}  // namespace
}  // namespace incognita::testing
