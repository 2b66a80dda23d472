#include "incognita/slam/features/rolling_shutter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

constexpr int least_matches = 10;   // of a frame: six numbers are its pose
constexpr double gate_sigmas = 3;   // of a residual
constexpr double least_sigmas = 6;  // of the readout time
constexpr double least_s = 0.001;   // a shorter one displaces rows by less than matching errors

/// Normal equations of a frame: pose error (6) and readout times of columns and rows (2).
struct FrameEquations {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> by_pose = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 2> cross = Eigen::Matrix<double, 6, 2>::Zero();
  Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
  Eigen::Vector2d by_readout = Eigen::Vector2d::Zero();
  int matches = 0;

  /// `place`: in the image, -1/2 to 1/2. The residual is delayed * readout times.
  void add(const Eigen::Matrix<double, 2, 6>& H, const Eigen::Vector2d& shift_per_s,
           const Eigen::Vector2d& residual, const Eigen::Vector2d& place) {
    const Eigen::Matrix2d delayed = shift_per_s * place.transpose();
    A += H.transpose() * H;
    cross += H.transpose() * delayed;
    by_pose += H.transpose() * residual;
    own += delayed.transpose() * delayed;
    by_readout += delayed.transpose() * residual;
    ++matches;
  }
};

}  // namespace

void RollingShutter::update(const Estimate& estimate, const TrackedCamera& camera, double t) {
  std::swap(before_, now_);
  now_.clear();
  const std::optional<double> t_before = std::exchange(t_before_, t);
  const double var = camera.pixel_var() * camera.lasting_factor,
               gate2 = gate_sigmas * gate_sigmas * camera.pixel_var();
  const Eigen::Vector2d size(camera.camera.width(), camera.camera.height());
  FrameEquations frame;
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched || match.level > 0) continue;
    FeatureMatch corrected = match;
    if (!predict_again(corrected, estimate, camera, camera.view.camera)) continue;
    now_.push_back({match.id, corrected.predicted});
    const auto before = std::ranges::find(before_, match.id, &Seen::id);
    if (before == before_.end() || !t_before || !(t > *t_before)) continue;
    const Eigen::Vector2d residual = *match.measured - corrected.predicted;
    if (residual.squaredNorm() > gate2) continue;
    const Eigen::Vector2d place = ((corrected.predicted.array() + 0.5) / size.array() - 0.5).matrix();
    // Of predictions: the difference of measurements would have their noise, which is in the residual as well
    const Eigen::Vector2d px_per_s = (corrected.predicted - before->predicted) / (t - *t_before);
    frame.add(corrected.Hv.leftCols<6>(), px_per_s, residual, place);
  }
  if (frame.matches < least_matches) return;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> pose(frame.A);
  const Eigen::Matrix<double, 6, 2> explained = pose.solve(frame.cross);
  information_ += (frame.own - frame.cross.transpose() * explained) / var;
  weighted_sum_ += (frame.by_readout - explained.transpose() * frame.by_pose) / var;
}

std::optional<Readout> RollingShutter::readout() const {
  const Eigen::LLT<Eigen::Matrix2d> information(information_);
  if (information.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector2d readout_s = information.solve(weighted_sum_);
  const Eigen::Vector2d sigmas_s = information.solve(Eigen::Matrix2d::Identity()).diagonal().cwiseSqrt();
  Eigen::Index axis = 0;
  const double sigmas = readout_s.cwiseQuotient(sigmas_s).cwiseAbs().maxCoeff(&axis);
  if (!(sigmas > least_sigmas) || std::abs(readout_s[axis]) < least_s) return std::nullopt;
  return Readout{axis == 0, readout_s[axis]};
}

}  // namespace incognita
