// Predicted measurements of a camera from an arbitrary pose: thesis 6.2.
#pragma once

#include <optional>
#include <vector>

#include "incognita/decision/expectation.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/slam/features/feature.hpp"

namespace incognita {

/// Where a camera is in the estimator.
struct CameraOfBody {
  int index = 0;                          ///< among all cameras; Landmark::camera
  std::size_t body = 0;                   ///< that carries it
  AnyMotion motion = FreeCameraMotion{};  ///< of the body
  std::optional<Mount> mount = {};        ///< on the body; none: the body is the camera itself
};

class ImageExpectation final : public SensorExpectation {
 public:
  /// `as_mapped`: caps the unmapped landmarks that count at the number that would be initialized there, i.e.
  /// by how many slam.map.wanted_visible exceeds the visible landmarks.
  ImageExpectation(Camera camera, const CameraSlamSettings& slam, bool as_mapped = false,
                   CameraOfBody carried = {});

  void prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen,
               double unseen_var_m2) override;

  /// Predicts the measurements of the map, limited to the slam.search.max_measurements most uncertain as in
  /// the estimator, and of the expected unmapped landmarks in view.
  void add(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override;

  /// Whether a position (world, m) is in the image and within the maximum depth of landmark initialization.
  bool in_view(const BlockVector& state, const Eigen::Vector3d& position) const override;

 private:
  struct Near {  ///< a landmark and its approximate position
    const Landmark* landmark;
    Eigen::Vector3d position;
  };
  struct VisibleLandmark {  ///< a landmark in view
    std::size_t near = 0;
    MeasurementJacobian Hv, Hl;
  };
  struct Certainty {  ///< covariances of a landmark, read from the belief on first use
    bool known = false;
    BlockMatrix with_body, own;
  };
  Viewpoint from(const BlockVector& state) const;
  void find_visible(const Viewpoint& from) const;
  void add_unseen(const BlockVector& state, const Viewpoint& from,
                  std::vector<PredictedMeasurement>& measurements) const;
  double innovation_trace(const VisibleLandmark& visible) const;
  const Certainty& certainty_of(std::size_t near) const;

  Camera camera_;
  CameraSlamSettings slam_;
  MeasurementMatrix R_;
  bool as_mapped_;
  CameraOfBody carried_;
  const Estimate* estimate_ = nullptr;
  const std::vector<ExpectedLandmark>* unseen_ = nullptr;
  double unseen_var_m2_ = 0;
  std::vector<Near> near_;
  BlockId body_ = 0;
  BlockMatrix P_body_;
  // Storage that is reused, and covariances that are valid until the next prepare()
  mutable std::vector<Certainty> certainty_;
  mutable std::vector<VisibleLandmark> visible_;
  mutable std::vector<Eigen::Vector3d> in_camera_;  ///< the positions of these
  mutable std::vector<double> traces_, sorted_;
};

}  // namespace incognita
