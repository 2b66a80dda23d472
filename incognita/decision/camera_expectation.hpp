// What a camera would see of its map, from anywhere: thesis 6.2.
#pragma once

#include <vector>

#include "incognita/decision/expectation.hpp"
#include "incognita/models/camera.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

class CameraExpectation final : public Expectation {
 public:
  /// `as_mapped`: of landmarks that nobody has seen no more count than would be mapped where they are seen,
  /// those that slam.map.wanted_visible lacks.
  CameraExpectation(Camera camera, const CameraSlamSettings& slam, bool as_mapped = false);

  /// The map as it is now, and landmarks that nobody has seen; both must stay until the next call.
  void prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen, double unseen_var_m2);

  /// Of the map those looks that would be measured, slam.search.max_measurements at most, the most uncertain
  /// first, as the estimator takes them; and of landmarks that nobody has seen those in view that count.
  /// `state`: the first 13 numbers are those of a free camera.
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;

  /// Whether a place would be in the image, and not farther than births reach.
  bool in_view(const CameraState& from, const Eigen::Vector3d& position) const;

 private:
  struct Near {  ///< a landmark and about where it is
    const Landmark* landmark;
    Eigen::Vector3d position;
  };
  struct VisibleLandmark {  ///< one that would be seen
    std::size_t near = 0;
    FeatureMatch measurement;
  };
  struct Certainty {  ///< of a landmark; read from the belief when it is first asked for
    bool known = false;
    Eigen::Matrix<double, 12, Eigen::Dynamic, 0, 12, 6> with_camera;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> own;
  };
  void find_visible(const CameraState& from) const;
  double innovation_trace(const VisibleLandmark& visible) const;
  const Certainty& certainty_of(std::size_t near) const;

  Camera camera_;
  CameraSlamSettings slam_;
  MeasurementMatrix R_;
  bool as_mapped_;
  const Estimate* estimate_ = nullptr;
  const std::vector<ExpectedLandmark>* unseen_ = nullptr;
  double unseen_var_m2_ = 0;
  std::vector<Near> near_;
  FreeCameraMotion::Jacobian P_camera_;
  // What follows is kept for its storage, and for as long as the map stays
  mutable std::vector<Certainty> certainty_;
  mutable std::vector<VisibleLandmark> visible_;
  mutable std::vector<double> traces_, sorted_;
};

}  // namespace incognita
