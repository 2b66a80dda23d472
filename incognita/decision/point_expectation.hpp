// Predicted measurements of landmarks and other bodies by the point sensor of a body, from an arbitrary state.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/expectation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class PointExpectation final : public MapExpectation {
 public:
  /// `max_measurements`: maximum number of mapped targets per set; the most uncertain are kept.
  PointExpectation(std::vector<BodyModel> bodies, int max_measurements);

  void prepare(const Estimate& estimate, std::size_t body, const std::vector<ExpectedLandmark>& unseen,
               double unseen_var_m2) override;

  /// `state`: of the vehicle; numbers beyond those of its motion model are ignored.
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;

  bool in_view(std::size_t body, const BlockVector& state, const Eigen::Vector3d& position) const override;

 private:
  /// Information gain is predicted for the first sensor of a body.
  const PointSensor& sensor() const { return bodies_[body_].sensors.front(); }
  struct Target {
    LandmarkParametrization form;
    SmallVector landmark;  ///< in its parametrization
    SmallMatrix by_block;  ///< d(landmark) / d(error of the block); empty for an anchor
    BlockId block = 0;
    SmallVector position;
    bool known = false;  ///< whether it is an anchor
  };
  void add_targets();
  void add_visible(const SmallVector& state, const SmallVector& from,
                   std::vector<PredictedMeasurement>& measurements) const;
  void keep_most_uncertain(std::vector<PredictedMeasurement>& measurements) const;
  double innovation_trace(const PredictedMeasurement& measurement) const;

  std::vector<BodyModel> bodies_;
  int max_measurements_;
  const Estimate* estimate_ = nullptr;
  std::size_t body_ = 0;
  const std::vector<ExpectedLandmark>* unseen_ = nullptr;
  double unseen_var_m2_ = 0;
  std::vector<Target> targets_;
  mutable std::vector<double> traces_, sorted_;  ///< reused storage
};

}  // namespace incognita
