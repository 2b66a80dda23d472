// Predicted measurements of landmarks and other bodies by the point sensor of a body, from an arbitrary state.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/expectation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class PointExpectation final : public SensorExpectation {
 public:
  /// Of the sensor `sensor` of body `body`, both counted from 0. `max_measurements`: maximum number of mapped targets;
  /// the most uncertain are kept.
  PointExpectation(std::vector<BodyModel> bodies, std::size_t body, std::size_t sensor, int max_measurements);

  void prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen,
               double unseen_var_m2) override;

  /// `state`: of the vehicle; numbers beyond those of its motion model are ignored.
  void add(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;

  bool in_view(const BlockVector& state, const Eigen::Vector3d& position) const override;

 private:
  const BodyModel& model() const { return bodies_[body_]; }
  const PointSensor& sensor() const { return model().sensors[sensor_]; }
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
  std::optional<AnyPrediction> predict_from(const SmallVector& state, const SmallVector& from,
                                            const LandmarkParametrization& form, const SmallVector& landmark,
                                            const SmallVector& position) const;
  void keep_most_uncertain(std::vector<PredictedMeasurement>& measurements, std::size_t first) const;
  double innovation_trace(const PredictedMeasurement& measurement) const;

  std::vector<BodyModel> bodies_;
  std::size_t body_, sensor_;
  int max_measurements_;
  const Estimate* estimate_ = nullptr;
  const std::vector<ExpectedLandmark>* unseen_ = nullptr;
  double unseen_var_m2_ = 0;
  std::vector<Target> targets_;
  mutable std::vector<double> traces_, sorted_;  ///< reused storage
};

}  // namespace incognita
