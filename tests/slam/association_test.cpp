// Data association against every set of pairings there is, and where nearest neighbours go wrong.
#include "incognita/slam/points/association.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Eigen::Matrix2d noise = Vector2d(0.1 * 0.1, 0.02 * 0.02).asDiagonal();

/// A vehicle that is not sure where it is, and landmarks it has mapped from there.
struct AssociationScene {
  AnyBelief belief;
  BlockId vehicle;
  std::vector<BlockId> landmarks;

  AssociationScene(const std::vector<Vector2d>& points, double sigma_m, double sigma_rad) {
    const Vector3d variances(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad);
    vehicle =
        belief.add_vehicle(planar::pose_chart, Vector3d::Zero(), variances.asDiagonal().toDenseMatrix());
    for (const Vector2d& point : points)
      landmarks.push_back(
          belief.augment(RangeBearing::landmark_chart, point, {}, 0.01 * Eigen::Matrix2d::Identity()));
  }

  /// Every measurement with every landmark.
  std::vector<Pairing> pairings(const std::vector<Vector2d>& measurements) const {
    std::vector<Pairing> all;
    for (std::size_t m = 0; m < measurements.size(); ++m)
      for (std::size_t l = 0; l < landmarks.size(); ++l) {
        const auto prediction =
            RangeBearing::predict_measurement(belief.mean(vehicle), belief.mean(landmarks[l]));
        Pairing pairing{static_cast<int>(m), static_cast<int>(l), {}};
        pairing.linearized.add(vehicle, prediction->Hv);
        pairing.linearized.add(landmarks[l], prediction->Hl);
        Vector2d residual;
        RangeBearing::chart.minus({measurements[m].data(), 2}, {prediction->z.data(), 2},
                                  {residual.data(), 2});
        pairing.linearized.residual = residual;
        pairing.linearized.R = noise;
        all.push_back(pairing);
      }
    return all;
  }
};

double joint_distance(const AnyBelief& belief, const std::vector<Pairing>& pairings,
                      const std::vector<int>& chosen) {
  if (chosen.empty()) return 0;
  std::vector<LinearizedMeasurement> measurements;
  VectorXd r(2 * chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    measurements.push_back(pairings[chosen[i]].linearized);
    r.segment<2>(2 * i) = pairings[chosen[i]].linearized.residual;
  }
  MatrixXd S;
  belief.innovation_covariance(measurements, S);
  return r.dot(S.llt().solve(r));
}

/// The best set by trying all of them; like the search, a set counts if each of its beginnings passes too.
struct Exhaustive {
  const AnyBelief& belief;
  const std::vector<Pairing>& pairings;
  int measurements;
  double probability;
  std::vector<int> path, best;
  double best_distance = 0;

  void descend(int m) {
    const double distance = joint_distance(belief, pairings, path);
    if (!path.empty() && !(distance <= chi_square_quantile(probability, 2 * path.size()))) return;
    if (path.size() > best.size() || (path.size() == best.size() && distance < best_distance)) {
      best = path;
      best_distance = distance;
    }
    if (m == measurements) return;
    for (std::size_t p = 0; p < pairings.size(); ++p) {
      if (pairings[p].measurement != m) continue;
      if (joint_distance(belief, pairings, {static_cast<int>(p)}) > chi_square_quantile(probability, 2))
        continue;
      if (std::any_of(path.begin(), path.end(),
                      [&](int q) { return pairings[q].landmark == pairings[p].landmark; }))
        continue;
      path.push_back(static_cast<int>(p));
      descend(m + 1);
      path.pop_back();
    }
    descend(m + 1);
  }
};

TEST(JointCompatibility, FindsWhatTryingEverySetFinds) {
  RandomStream random(1, "association");
  int with_choice = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Vector2d> points, measurements;
    for (int i = 0; i < 4; ++i) points.push_back({random.uniform(2, 5), random.uniform(-2, 2)});
    const AssociationScene scene(points, 0.4, 0.1);
    const Vector3d truth(0.4 * random.normal(), 0.4 * random.normal(), 0.1 * random.normal());
    for (int i = 0; i < 4; ++i) {
      const Vector2d point =
          random.uniform(0, 1) < 0.8 ? points[i] : Vector2d(random.uniform(2, 5), random.uniform(-2, 2));
      measurements.push_back(RangeBearing::predict_measurement(truth, point)->z);
    }
    const auto pairings = scene.pairings(measurements);
    Exhaustive exhaustive{scene.belief, pairings, 4, 0.95, {}, {}, 0};
    exhaustive.descend(0);
    const Association found = jointly_compatible(scene.belief, pairings, {});
    EXPECT_EQ(found.chosen.size(), exhaustive.best.size()) << "round " << round;
    EXPECT_NEAR(found.distance2, exhaustive.best_distance, 1e-9) << "round " << round;
    EXPECT_FALSE(found.capped);
    const auto inside = individual_distances(scene.belief, pairings);
    with_choice += std::count_if(inside.begin(), inside.end(), [](double d) { return d < 6; }) > 5;
  }
  EXPECT_GT(with_choice, 20) << "too easy to say anything";
}

/// The pairings inside their gates, nearest first.
std::vector<int> nearest_neighbors(const AnyBelief& belief, const std::vector<Pairing>& pairings) {
  const std::vector<double> distances = individual_distances(belief, pairings);
  std::vector<Candidate> candidates;
  std::vector<int> inside, chosen;
  for (std::size_t p = 0; p < pairings.size(); ++p) {
    if (!(distances[p] <= chi_square_quantile(0.95, 2))) continue;
    candidates.push_back({pairings[p].measurement, pairings[p].landmark, distances[p]});
    inside.push_back(static_cast<int>(p));
  }
  for (const int c : nearest_first(candidates)) chosen.push_back(inside[static_cast<std::size_t>(c)]);
  return chosen;
}

/// Two rows of posts half a metre apart, seen by a vehicle that is 0.4 m beside where it believes to be: each
/// post looks nearest to its neighbor's.
TEST(JointCompatibility, HoldsWhereNearestNeighborsTakeTheWrongPost) {
  const std::vector<Vector2d> posts = {{4, -1}, {4, -0.4}, {4, 0.2}, {4, 0.8}, {4.9, 0.5}};
  const AssociationScene scene(posts, 0.3, 0.01);
  std::vector<Vector2d> measurements;
  for (const Vector2d& post : posts)
    measurements.push_back(RangeBearing::predict_measurement({0, 0.4, 0}, post)->z);
  const auto pairings = scene.pairings(measurements);
  const auto right = [&](const std::vector<int>& chosen) {
    return std::count_if(chosen.begin(), chosen.end(),
                         [&](int p) { return pairings[p].measurement == pairings[p].landmark; });
  };
  EXPECT_EQ(right(jointly_compatible(scene.belief, pairings, {}).chosen), 5);
  EXPECT_LT(right(nearest_neighbors(scene.belief, pairings)), 4);
}

TEST(JointCompatibility, ACappedSearchSaysSoAndIsStillOneToOne) {
  std::vector<Vector2d> posts, measurements;
  for (int i = 0; i < 12; ++i) posts.push_back({4 + 0.05 * i, 0.05 * i});
  for (const Vector2d& post : posts)
    measurements.push_back(RangeBearing::predict_measurement({0, 0.1, 0}, post)->z);
  const AssociationScene scene(posts, 0.5, 0.1);
  const auto pairings = scene.pairings(measurements);
  const Association found = jointly_compatible(scene.belief, pairings, {.max_nodes = 50});
  EXPECT_TRUE(found.capped);
  EXPECT_GE(found.chosen.size(), 3u);
  std::set<int> measured, seen;
  for (const int p : found.chosen) {
    EXPECT_TRUE(measured.insert(pairings[p].measurement).second);
    EXPECT_TRUE(seen.insert(pairings[p].landmark).second);
  }
}

TEST(Association, NothingIsNotAMatch) {
  const AssociationScene scene({{4, 0}}, 0.1, 0.01);
  EXPECT_TRUE(jointly_compatible(scene.belief, {}, {}).chosen.empty());
  EXPECT_TRUE(nearest_neighbors(scene.belief, {}).empty());
  const auto far = scene.pairings({{9, 1}, {NAN, 0}, {4, NAN}});
  EXPECT_TRUE(jointly_compatible(scene.belief, far, {}).chosen.empty());
  EXPECT_TRUE(nearest_neighbors(scene.belief, far).empty());
}

TEST(Association, NearestNeighborsAreOneToOne) {
  const AssociationScene scene({{4, 0}, {4, 0.3}}, 0.1, 0.01);
  const auto pairings = scene.pairings({{4, 0.001}, {4, 0.02}});
  const std::vector<int> found = nearest_neighbors(scene.belief, pairings);
  ASSERT_EQ(found.size(), 2u);
  for (const int p : found) EXPECT_EQ(pairings[p].measurement, pairings[p].landmark);
}

}  // namespace
}  // namespace incognita
