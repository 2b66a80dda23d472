// The loop allocates nothing once it has seen its largest state and measurement.
#include "tests/allocations.hpp"

#include "incognita/belief/aligned_buffer.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

TEST_F(Allocation, IsCountedWhicheverWayItGoes) {
  EXPECT_GT(allocations_in([] { std::vector<double> v(100), w = v; }), 0);
  EXPECT_GT(allocations_in([] { Eigen::VectorXd v = Eigen::VectorXd::Random(100), w = v; }), 0);
  EXPECT_GT(allocations_in([] { AlignedBuffer v(100); }), 0);
}

TEST_F(Allocation, NeverHappensInTheLoop) {
  RandomStream random(1, "allocation");
  Map map(random, {12, 3}, std::vector<int>(60, 3));
  std::vector<AffineLook> looks;
  for (int i = 0; i < 40; ++i)  // 80 rows: beyond what Eigen factorises without blocking
    looks.push_back(random_look(random, map.belief, 2, {map.vehicles[0], map.landmarks[i]}));
  AffineMotion camera{map.vehicles[0], map.belief.mean(map.vehicles[0]), BlockMatrix::Identity(12, 12),
                      0.1 * BlockMatrix::Identity(12, 12)};
  AffineMotion robot{map.vehicles[1], map.belief.mean(map.vehicles[1]), BlockMatrix::Identity(3, 3),
                     0.1 * BlockMatrix::Identity(3, 3)};
  AffineLook bad = looks[0];
  bad.R.setZero();
  Eigen::MatrixXd S;
  map.belief.update(looks);
  map.belief.innovation_covariance(looks, S);
  EXPECT_EQ(allocations_in([&] {
              map.belief.predict(camera);
              map.belief.predict(robot);
              map.belief.innovation_covariance(looks, S);
            }),
            0);
  for (std::size_t count = looks.size(); count > 0; --count)
    ASSERT_EQ(allocations_in([&] { map.belief.update({looks.data(), count}); }), 0) << count << " looks";
  ASSERT_EQ(allocations_in([&] { map.belief.update(looks); }), 0) << "all looks again";
  EXPECT_EQ(allocations_in([&] { map.belief.update({&bad, 1}); }), 0) << "a refusal";
}

TEST_F(Allocation, NeverHappensWhenBlocksGoAndComeBack) {
  RandomStream random(2, "turnover");
  Map map(random, {12}, std::vector<int>(20, 3));
  const AffineLook look = random_look(random, map.belief, 2, {map.vehicles[0], map.landmarks[5]});
  map.belief.update({&look, 1});
  map.belief.drop(map.landmarks[2]);
  const Eigen::VectorXd mean = Eigen::VectorXd::Zero(3);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(3, 3);
  map.belief.augment(Chart::line(3), mean, {}, noise);
  EXPECT_EQ(allocations_in([&] {
              map.belief.predict({map.vehicles[0], map.belief.mean(map.vehicles[0]),
                                  BlockMatrix::Identity(12, 12), BlockMatrix::Identity(12, 12)});
              map.belief.update({&look, 1});
            }),
            0);
}

}  // namespace
}  // namespace incognita::testing
