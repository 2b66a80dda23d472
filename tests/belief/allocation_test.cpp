// The loop allocates no memory after its largest state and measurement have occurred.
#include "tests/allocations.hpp"

#include "incognita/belief/aligned_buffer.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

TEST_F(Allocation, IsCountedForEveryKindOfNew) {
  EXPECT_GT(allocations_in([] { std::vector<double> v(100), w = v; }), 0);
  EXPECT_GT(allocations_in([] { Eigen::VectorXd v = Eigen::VectorXd::Random(100), w = v; }), 0);
  EXPECT_GT(allocations_in([] { AlignedBuffer v(100); }), 0);
}

TEST_F(Allocation, IsAbsentFromTheLoop) {
  RandomStream random(1, "allocation");
  Map map(random, {12, 3}, std::vector<int>(60, 3));
  std::vector<LinearizedMeasurement> measurements;
  for (int i = 0; i < 40; ++i)  // 80 rows: beyond what Eigen factorizes unblocked
    measurements.push_back(random_measurement(random, map.belief, 2, {map.vehicles[0], map.landmarks[i]}));
  LinearizedMotion camera{map.vehicles[0], map.belief.mean(map.vehicles[0]), BlockMatrix::Identity(12, 12),
                          0.1 * BlockMatrix::Identity(12, 12)};
  LinearizedMotion robot{map.vehicles[1], map.belief.mean(map.vehicles[1]), BlockMatrix::Identity(3, 3),
                         0.1 * BlockMatrix::Identity(3, 3)};
  LinearizedMeasurement bad = measurements[0];
  bad.R.setZero();
  Eigen::MatrixXd S;
  map.belief.update(measurements);
  map.belief.innovation_covariance(measurements, S);
  EXPECT_EQ(allocations_in([&] {
              map.belief.predict(camera);
              map.belief.predict(robot);
              map.belief.innovation_covariance(measurements, S);
            }),
            0);
  for (std::size_t count = measurements.size(); count > 0; --count)
    ASSERT_EQ(allocations_in([&] {
                map.belief.update({measurements.data(), count});
              }),
              0)
        << count << " measurements";
  ASSERT_EQ(allocations_in([&] { map.belief.update(measurements); }), 0) << "all measurements again";
  EXPECT_EQ(allocations_in([&] { map.belief.update({&bad, 1}); }), 0) << "a refusal";
}

TEST_F(Allocation, IsAbsentWhenBlocksAreDroppedAndAddedAgain) {
  RandomStream random(2, "turnover");
  Map map(random, {12}, std::vector<int>(20, 3));
  const LinearizedMeasurement measurement =
      random_measurement(random, map.belief, 2, {map.vehicles[0], map.landmarks[5]});
  map.belief.update({&measurement, 1});
  map.belief.drop(map.landmarks[2]);
  const Eigen::VectorXd mean = Eigen::VectorXd::Zero(3);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(3, 3);
  map.belief.augment(Chart::line(3), mean, {}, noise);
  EXPECT_EQ(allocations_in([&] {
              map.belief.predict({map.vehicles[0], map.belief.mean(map.vehicles[0]),
                                  BlockMatrix::Identity(12, 12), BlockMatrix::Identity(12, 12)});
              map.belief.update({&measurement, 1});
            }),
            0);
}

}  // namespace
}  // namespace incognita::testing
