// A restored observability monitor goes on with the same bits as the one that was saved.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "incognita/analysis/observability/observability_monitor.hpp"
#include "incognita/belief/belief.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {
namespace {

std::string saved(ObservabilityMonitor& monitor) {
  StateWriter writer;
  StateArchive{writer}(monitor);
  return writer.take();
}

void restore(const std::string& bytes, ObservabilityMonitor& monitor) {
  StateReader reader(bytes);
  StateArchive{reader}(monitor);
  EXPECT_EQ(reader.left(), 0u);
}

/// A vehicle that drives, measures landmarks, and forgets some of them.
struct SavedDrive {
  Belief belief;
  BlockId vehicle = 0;
  std::vector<BlockId> landmarks;
  std::mt19937_64 random{11};

  SavedDrive() {
    vehicle = belief.add_vehicle(Chart::line(3), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
    belief.keep_trace(true);
  }
  double draw() { return 2 * static_cast<double>(random() >> 11) * 0x1.0p-53 - 1; }
  Eigen::MatrixXd matrix(int rows, int columns) {
    Eigen::MatrixXd m(rows, columns);
    for (double& v : m.reshaped()) v = draw();
    return m;
  }
  void step() {
    belief.clear_trace();
    const BlockMatrix A = Eigen::MatrixXd(Eigen::Matrix3d::Identity() + 0.1 * matrix(3, 3));
    belief.predict({vehicle, belief.mean(vehicle), A, 0.01 * BlockMatrix::Identity(3, 3)});
    if (landmarks.size() < 12) {
      const BlockParent parent{vehicle, matrix(2, 3)};
      landmarks.push_back(belief.augment(Chart::line(2), Eigen::Vector2d::Zero(), {&parent, 1},
                                         0.3 * Eigen::Matrix2d::Identity()));
    }
    LinearizedMeasurement m;
    m.add(vehicle, matrix(2, 3));
    m.add(landmarks[random() % landmarks.size()], matrix(2, 2));
    m.residual = 0.1 * matrix(2, 1);
    m.R = 0.1 * Eigen::Matrix2d::Identity();
    belief.update({&m, 1});
    if (landmarks.size() > 9 && random() % 3 == 0) {
      belief.drop(landmarks[2]);
      landmarks.erase(landmarks.begin() + 2);
    }
  }
};

TEST(SavedMonitor, GoesOnWithTheSameBits) {
  for (const auto motions :
       {ObservabilityMonitor::Motions::followed, ObservabilityMonitor::Motions::uninformative})
    for (const int steps : {0, 1, 40}) {
      SavedDrive drive;
      ObservabilityMonitor whole(drive.vehicle, 3, motions), again({});
      whole.treat_as_noise(1000, BlockMatrix::Identity(2, 2));
      for (int k = 0; k < steps; ++k) drive.step(), whole.follow(drive.belief.trace());
      restore(saved(whole), again);
      EXPECT_EQ(saved(whole), saved(again));
      for (int k = 0; k < 30; ++k) {
        drive.step();
        whole.follow(drive.belief.trace());
        again.follow(drive.belief.trace());
      }
      EXPECT_EQ(saved(whole), saved(again)) << steps;
      EXPECT_EQ(whole.information(), again.information()) << steps;
      EXPECT_EQ(whole.gathered(), again.gathered()) << steps;
      EXPECT_GT(whole.errors(), 10);
    }
}

TEST(SavedMonitor, EveryTruncationIsRefused) {
  SavedDrive drive;
  ObservabilityMonitor monitor(drive.vehicle, 3), again({});
  for (int k = 0; k < 10; ++k) drive.step(), monitor.follow(drive.belief.trace());
  const std::string bytes = saved(monitor);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(restore(bytes.substr(0, size), again), DamagedState) << size;
}

}  // namespace
}  // namespace incognita
