// Predicted measurements of landmarks and teammates by one vehicle of a team, from an arbitrary state.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/expectation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class TeamExpectation final : public Expectation {
 public:
  /// `max_measurements`: maximum number of mapped targets per set; the most uncertain are kept.
  TeamExpectation(EstimatorSettings team, int max_measurements);

  /// Sets the current team estimate and the expected unmapped landmarks; both must outlive the calls until
  /// the next prepare().
  void prepare(const Estimate& estimate, std::size_t vehicle, const std::vector<ExpectedLandmark>& unseen,
               double unseen_var_m2);

  /// `state`: of the vehicle; numbers beyond those of its motion model are ignored.
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;

  /// Whether a position (world, m) would be measured from that state.
  bool in_view(const BlockVector& state, const Eigen::Vector3d& position) const;

 private:
  const AnyMotion& motion() const { return team_.bodies[vehicle_].motion; }
  /// Information gain is predicted for the first sensor of a body.
  const PointSensor& sensor() const { return team_.bodies[vehicle_].sensors.front(); }
  struct Target {
    LandmarkParametrization form;
    SmallVector landmark;  ///< in its parametrization
    SmallMatrix by_block;  ///< d(landmark) / d(error of the block); empty for an anchor
    BlockId block = 0;
    SmallVector position;
    bool known = false;  ///< whether it is an anchor
  };
  void add_targets();
  std::optional<AnyPrediction> predict_from(const SmallVector& vehicle, const SmallVector& from,
                                            const LandmarkParametrization& form, const SmallVector& landmark,
                                            const SmallVector& position) const;
  void add_visible(const SmallVector& vehicle, const SmallVector& from,
                   std::vector<PredictedMeasurement>& measurements) const;
  void keep_most_uncertain(std::vector<PredictedMeasurement>& measurements) const;
  double innovation_trace(const PredictedMeasurement& measurement) const;

  EstimatorSettings team_;
  int max_measurements_;
  const Estimate* estimate_ = nullptr;
  std::size_t vehicle_ = 0;
  const std::vector<ExpectedLandmark>* unseen_ = nullptr;
  double unseen_var_m2_ = 0;
  std::vector<Target> targets_;
  mutable std::vector<double> traces_, sorted_;  ///< reused storage
};

}  // namespace incognita
