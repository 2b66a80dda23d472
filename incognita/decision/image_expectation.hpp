// Predicted measurements of a camera from an arbitrary pose: thesis 6.2.
#pragma once

#include <vector>

#include "incognita/decision/expectation.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/slam/features/feature.hpp"

namespace incognita {

class ImageExpectation final : public MapExpectation {
 public:
  /// `as_mapped`: caps the unmapped landmarks that count at the number that would be initialized there, i.e.
  /// by how many slam.map.wanted_visible exceeds the visible landmarks.
  ImageExpectation(Camera camera, const CameraSlamSettings& slam, bool as_mapped = false);

  /// Requires `body` 0: the camera is that of the first body.
  void prepare(const Estimate& estimate, std::size_t body, const std::vector<ExpectedLandmark>& unseen,
               double unseen_var_m2) override;

  /// Predicts the measurements of the map, limited to the slam.search.max_measurements most uncertain as in
  /// the estimator, and of the expected unmapped landmarks in view. `state`: its first 13 numbers are those
  /// of a free camera.
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;

  /// Whether a position (world, m) is in the image and within the maximum depth of landmark initialization.
  bool in_view(std::size_t body, const BlockVector& state, const Eigen::Vector3d& position) const override;

 private:
  struct Near {  ///< a landmark and its approximate position
    const Landmark* landmark;
    Eigen::Vector3d position;
  };
  struct VisibleLandmark {  ///< a landmark in view
    std::size_t near = 0;
    FeatureMatch measurement;
  };
  struct Certainty {  ///< covariances of a landmark, read from the belief on first use
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
  // Storage that is reused, and covariances that are valid until the next prepare()
  mutable std::vector<Certainty> certainty_;
  mutable std::vector<VisibleLandmark> visible_;
  mutable std::vector<double> traces_, sorted_;
};

}  // namespace incognita
