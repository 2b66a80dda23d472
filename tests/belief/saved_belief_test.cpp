// A restored belief goes on with the same bits as the one that was saved.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/belief/tiled_cholesky.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {
namespace {

std::string saved(AnyBelief& belief) {
  StateWriter writer;
  StateArchive{writer}(belief);
  return writer.take();
}

void restore(const std::string& bytes, AnyBelief& belief) {
  StateReader reader(bytes);
  StateArchive{reader}(belief);
  EXPECT_EQ(reader.left(), 0u);
}

/// Random predictions, updates, new, converted and dropped landmarks.
class Changes {
 public:
  explicit Changes(std::uint64_t seed) : random_(seed) {}

  void apply(AnyBelief& belief, BlockId vehicle, std::vector<BlockId>& landmarks) {
    const BlockMatrix I = BlockMatrix::Identity(3, 3);
    belief.predict({vehicle, belief.mean(vehicle) + 0.1 * numbers(3), I, 0.01 * I});
    if (landmarks.size() < 60 || draw() < 0.3) {
      const BlockParent parent{vehicle, I};
      landmarks.push_back(belief.augment(Chart::line(3), numbers(3), {&parent, 1}, 0.5 * I));
    }
    std::vector<LinearizedMeasurement> measurements;
    for (int k = 0; k < 5; ++k) {
      LinearizedMeasurement& m = measurements.emplace_back();
      m.add(vehicle, Eigen::MatrixXd(numbers(6).reshaped(2, 3)));
      m.add(landmarks[random_() % landmarks.size()], Eigen::MatrixXd(numbers(6).reshaped(2, 3)));
      m.residual = 0.1 * numbers(2);
      m.R = 0.1 * Eigen::Matrix2d::Identity();
    }
    belief.update(measurements);
    if (landmarks.size() > 10 && draw() < 0.2) {
      const std::size_t which = random_() % landmarks.size();
      belief.drop(landmarks[which]);
      landmarks.erase(landmarks.begin() + static_cast<std::ptrdiff_t>(which));
    }
  }

 private:
  double draw() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }
  Eigen::VectorXd numbers(int count) {
    Eigen::VectorXd x(count);
    for (double& v : x) v = 2 * draw() - 1;
    return x;
  }
  std::mt19937_64 random_;
};

void expect_same_bits(AnyBelief belief) {
  const BlockId vehicle = belief.add_vehicle(Chart{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}},
                                             Eigen::Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity());
  std::vector<BlockId> landmarks;
  Changes changes(3);
  for (int k = 0; k < 120; ++k) changes.apply(belief, vehicle, landmarks);
  AnyBelief again;
  restore(saved(belief), again);
  EXPECT_EQ(saved(belief), saved(again));
  std::vector<BlockId> landmarks_again = landmarks;
  Changes changes_again = changes;
  for (int k = 0; k < 80; ++k) {
    changes.apply(belief, vehicle, landmarks);
    changes_again.apply(again, vehicle, landmarks_again);
  }
  EXPECT_EQ(landmarks, landmarks_again);
  EXPECT_EQ(saved(belief), saved(again));
  EXPECT_EQ(belief.dense_covariance(), again.dense_covariance());
}

TEST(SavedBelief, GoesOnWithTheSameBits) { expect_same_bits(AnyBelief(Belief())); }
TEST(SavedBelief, InInformationFormToo) { expect_same_bits(AnyBelief(InformationBelief())); }
TEST(SavedBelief, WithABlockDiagonalMapToo) {
  expect_same_bits(AnyBelief(Belief(64, MapCorrelations::block_diagonal)));
}

TEST(SavedBelief, DamageIsRefused) {
  AnyBelief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(3), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  std::vector<BlockId> landmarks;
  Changes changes(5);
  for (int k = 0; k < 5; ++k) changes.apply(belief, vehicle, landmarks);
  const std::string bytes = saved(belief);
  for (std::size_t size = 0; size < bytes.size(); size += 3) {
    AnyBelief again;
    EXPECT_THROW(restore(bytes.substr(0, size), again), DamagedState) << size;
  }
  // Sizes, ids and charts come first: whatever they are changed to must not be used unchecked
  for (std::size_t at = 0; at < 60; ++at)
    for (const int by : {1, 128, 255}) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ by);
      AnyBelief again;
      try {
        StateReader reader(other);
        StateArchive{reader}(again);
        if (again.block_count() > 0) (void)again.dense_covariance();
      } catch (const DamagedState&) {
      }
    }
}

TEST(SavedBelief, AFactorizationGoesOnWhereItWas) {
  const int size = 200;
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(size, size);
  const Eigen::MatrixXd P = A * A.transpose() + Eigen::MatrixXd::Identity(size, size);
  for (const long steps : {0L, 1L, 7L, 1000L}) {
    TiledCholesky one, two;
    one.start(size);
    for (int j = 0; j < size; ++j) one.set_column(j, j, P.data() + static_cast<long>(j) * size + j, size - j);
    one.advance(steps);
    StateWriter writer;
    StateArchive{writer}(one);
    StateReader reader(writer.bytes());
    StateArchive{reader}(two);
    EXPECT_EQ(reader.left(), 0u);
    one.advance(1000), two.advance(1000);
    EXPECT_EQ(one.log_det(size), two.log_det(size)) << steps;
    EXPECT_TRUE(two.is_done());
  }
}

}  // namespace
}  // namespace incognita
