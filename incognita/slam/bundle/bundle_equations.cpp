#include "incognita/slam/bundle/bundle_equations.hpp"

#include <Eigen/LU>
#include <cmath>

namespace incognita {
namespace {

constexpr double behind_camera_sigmas = 100;

/// The landmark in the state of its parametrization in the belief.
InverseDepthLandmark::State inverse_depth_state(const Bundle& bundle, const BundlePoint& point) {
  InverseDepthLandmark::State y;
  y << bundle.views[static_cast<std::size_t>(point.host)].position, point.value;
  return y;
}

CameraState camera_state(const BundleView& view) {
  CameraState x = CameraState::Zero();
  x.head<3>() = view.position;
  x.segment<4>(3) = view.world_from_camera;
  return x;
}

struct Linearized {
  Eigen::Vector2d residual;        ///< measured - predicted, px
  Eigen::Matrix<double, 2, 6> Hv;  ///< by the error of the view
  Eigen::Matrix<double, 2, 3> Hh;  ///< by the position of the host
  Eigen::Matrix<double, 2, 3> Hp;  ///< by the error of the point
};

std::optional<Linearized> linearize_one(const Bundle& bundle, const BundleObservation& observation,
                                        const Camera& camera) {
  const BundlePoint& point = bundle.points[static_cast<std::size_t>(observation.point)];
  const CameraState x = camera_state(bundle.views[static_cast<std::size_t>(observation.view)]);
  Linearized out;
  if (point.kind == BundlePoint::Kind::inverse_depth) {
    const auto predicted = InverseDepthLandmark{point.initial_axes}.predict_measurement(
        camera, x, inverse_depth_state(bundle, point));
    if (!predicted) return std::nullopt;
    out = {observation.pixel - predicted->pixel, predicted->Hv.leftCols<6>(), predicted->Hl.leftCols<3>(),
           predicted->Hl.rightCols<3>()};
  } else {
    const auto predicted = PointLandmark::predict_measurement(camera, x, point.value);
    if (!predicted) return std::nullopt;
    out = {observation.pixel - predicted->pixel, predicted->Hv.leftCols<6>(),
           Eigen::Matrix<double, 2, 3>::Zero(), predicted->Hl};
  }
  return out;
}

double squared_sigmas(const Eigen::Vector2d& residual, const Eigen::Matrix2d& cov) {
  return residual.dot(cov.inverse() * residual);
}

/// The error of the first view from its prior.
Eigen::Matrix<double, 6, 1> prior_error(const Bundle& bundle) {
  const BundleView& now = bundle.views.front();
  Eigen::Matrix<double, 6, 1> error;
  error << now.position - bundle.first_view.position,
      quaternion_log(quaternion_product(quaternion_conjugate(bundle.first_view.world_from_camera),
                                        now.world_from_camera));
  return error;
}

bool has_depth_prior(const BundlePoint& point) {
  return point.kind == BundlePoint::Kind::inverse_depth && std::isfinite(point.sigma_prior_inverse_depth);
}

double depth_error_sigmas(const BundlePoint& point) {
  return (point.value[2] - point.prior_inverse_depth) / point.sigma_prior_inverse_depth;
}

}  // namespace

double RobustCost::cost(double squared_sigmas) const {
  const double sigmas = std::sqrt(squared_sigmas);
  return sigmas <= limit_sigmas ? 0.5 * squared_sigmas : limit_sigmas * (sigmas - 0.5 * limit_sigmas);
}

double RobustCost::weight(double squared_sigmas) const {
  const double sigmas = std::sqrt(squared_sigmas);
  return sigmas <= limit_sigmas ? 1 : limit_sigmas / sigmas;
}

std::optional<Eigen::Vector2d> predicted_pixel(const Bundle& bundle, const BundleObservation& observation,
                                               const Camera& camera) {
  const BundlePoint& point = bundle.points[static_cast<std::size_t>(observation.point)];
  const CameraState x = camera_state(bundle.views[static_cast<std::size_t>(observation.view)]);
  const Eigen::Vector3d along =
      point.kind == BundlePoint::Kind::inverse_depth
          ? InverseDepthLandmark{point.initial_axes}.in_camera<double>(x, inverse_depth_state(bundle, point))
          : PointLandmark::in_camera<double>(x, point.value);
  const auto predicted = camera.project(along);
  return predicted ? std::optional(predicted->pixel) : std::nullopt;
}

double cost_of(const Bundle& bundle, const Camera& camera, const RobustCost& robust) {
  double sum = 0;
  for (const BundleObservation& observation : bundle.observations) {
    const auto predicted = predicted_pixel(bundle, observation, camera);
    sum += robust.cost(predicted ? squared_sigmas(observation.pixel - *predicted, observation.cov)
                                 : behind_camera_sigmas * behind_camera_sigmas);
  }
  for (const BundlePoint& point : bundle.points)
    if (has_depth_prior(point)) sum += 0.5 * std::pow(depth_error_sigmas(point), 2);
  if (bundle.views.front().fixed) return sum;
  const Eigen::Matrix<double, 6, 1> error = prior_error(bundle);
  return sum + 0.5 * error.dot(bundle.first_view_cov.llt().solve(error));
}

BundleEquations::Coupling& BundleEquations::coupling(PointTerms& terms, int view) {
  for (int i = terms.first; i < terms.first + terms.count; ++i)
    if (couplings_[static_cast<std::size_t>(i)].view == view) return couplings_[static_cast<std::size_t>(i)];
  ++terms.count;
  return couplings_.emplace_back(Coupling{view, rows_[static_cast<std::size_t>(view)], Block6x3::Zero()});
}

void BundleEquations::add_measurement(const Bundle& bundle, const BundleObservation& observation,
                                      const Camera& camera, const RobustCost& robust) {
  const auto linearized = linearize_one(bundle, observation, camera);
  if (!linearized) return;
  const auto& [residual, Hv, Hh, Hp] = *linearized;
  const Eigen::Matrix2d information =
      robust.weight(squared_sigmas(residual, observation.cov)) * Eigen::Matrix2d(observation.cov.inverse());
  const int v = rows_[static_cast<std::size_t>(observation.view)];
  if (v >= 0) {
    H_views_.block<6, 6>(v, v).noalias() += Hv.transpose() * information * Hv;
    gradient_views_.segment<6>(v).noalias() += Hv.transpose() * information * residual;
  }
  const BundlePoint& point = bundle.points[static_cast<std::size_t>(observation.point)];
  if (point.kind == BundlePoint::Kind::fixed) return;
  PointTerms& terms = points_[static_cast<std::size_t>(observation.point)];
  terms.H.noalias() += Hp.transpose() * information * Hp;
  terms.gradient.noalias() += Hp.transpose() * information * residual;
  if (v >= 0) coupling(terms, observation.view).H.noalias() += Hv.transpose() * information * Hp;
  if (point.kind != BundlePoint::Kind::inverse_depth) return;
  // The host's position is part of the prediction, too
  const int h = rows_[static_cast<std::size_t>(point.host)];
  if (h < 0) return;
  coupling(terms, point.host).H.topRows<3>().noalias() += Hh.transpose() * information * Hp;
  gradient_views_.segment<3>(h).noalias() += Hh.transpose() * information * residual;
  H_views_.block<3, 3>(h, h).noalias() += Hh.transpose() * information * Hh;
  if (v < 0) return;
  const Eigen::Matrix<double, 6, 3> cross = Hv.transpose() * information * Hh;
  if (h == v) {
    H_views_.block<6, 3>(v, v) += cross;
    H_views_.block<3, 6>(v, v) += cross.transpose();
  } else if (v > h) {
    H_views_.block<6, 3>(v, h) += cross;
  } else {
    H_views_.block<3, 6>(h, v) += cross.transpose();
  }
}

void BundleEquations::add_priors(const Bundle& bundle) {
  if (!bundle.views.front().fixed) {
    const Eigen::Matrix<double, 6, 6> information =
        bundle.first_view_cov.llt().solve(Eigen::Matrix<double, 6, 6>::Identity());
    H_views_.topLeftCorner<6, 6>() += information;
    gradient_views_.head<6>() -= information * prior_error(bundle);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const BundlePoint& point = bundle.points[i];
    if (!has_depth_prior(point)) continue;
    points_[i].H(2, 2) += std::pow(point.sigma_prior_inverse_depth, -2);
    points_[i].gradient[2] -= depth_error_sigmas(point) / point.sigma_prior_inverse_depth;
  }
}

void BundleEquations::linearize(const Bundle& bundle, const Camera& camera, const RobustCost& robust) {
  rows_.clear();
  int size = 0;
  for (const BundleView& view : bundle.views) {
    rows_.push_back(view.fixed ? -1 : size);
    if (!view.fixed) size += 6;
  }
  H_views_.setZero(size, size);
  gradient_views_.setZero(size);
  points_.assign(bundle.points.size(), {});
  couplings_.clear();
  int last = -1;
  for (const BundleObservation& observation : bundle.observations) {
    PointTerms& terms = points_[static_cast<std::size_t>(observation.point)];
    if (observation.point != last) terms.first = static_cast<int>(couplings_.size());
    last = observation.point;
    terms.estimated =
        bundle.points[static_cast<std::size_t>(observation.point)].kind != BundlePoint::Kind::fixed;
    add_measurement(bundle, observation, camera, robust);
  }
  add_priors(bundle);
}

bool BundleEquations::factorize(double damping) {
  Eigen::MatrixXd reduced = H_views_;
  reduced.diagonal() *= 1 + damping;
  inverse_points_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointTerms& terms = points_[i];
    if (!terms.estimated) continue;
    Eigen::Matrix3d H = terms.H;
    H.diagonal() *= 1 + damping;
    inverse_points_[i] = H.inverse();
    if (!inverse_points_[i].allFinite()) return false;
    for (int a = terms.first; a < terms.first + terms.count; ++a) {
      const Coupling& of_a = couplings_[static_cast<std::size_t>(a)];
      const Block6x3 weighted = of_a.H * inverse_points_[i];
      for (int b = terms.first; b < terms.first + terms.count; ++b) {
        const Coupling& of_b = couplings_[static_cast<std::size_t>(b)];
        if (of_b.row <= of_a.row)
          reduced.block<6, 6>(of_a.row, of_b.row).noalias() -= weighted * of_b.H.transpose();
      }
    }
  }
  reduced_.compute(reduced);
  return reduced_.info() == Eigen::Success;
}

void BundleEquations::solve() {
  view_steps_ = gradient_views_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointTerms& terms = points_[i];
    if (!terms.estimated) continue;
    const Eigen::Vector3d weighted = inverse_points_[i] * terms.gradient;
    for (int a = terms.first; a < terms.first + terms.count; ++a) {
      const Coupling& of_a = couplings_[static_cast<std::size_t>(a)];
      view_steps_.segment<6>(of_a.row) -= of_a.H * weighted;
    }
  }
  reduced_.solveInPlace(view_steps_);
  point_steps_.assign(points_.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointTerms& terms = points_[i];
    if (!terms.estimated) continue;
    Eigen::Vector3d right = terms.gradient;
    for (int a = terms.first; a < terms.first + terms.count; ++a) {
      const Coupling& of_a = couplings_[static_cast<std::size_t>(a)];
      right -= of_a.H.transpose() * view_steps_.segment<6>(of_a.row);
    }
    point_steps_[i] = inverse_points_[i] * right;
  }
}

Eigen::Matrix<double, 6, 1> BundleEquations::view_step(int view) const {
  const int row = rows_[static_cast<std::size_t>(view)];
  if (row < 0) return Eigen::Matrix<double, 6, 1>::Zero();
  return view_steps_.segment<6>(row);
}

}  // namespace incognita
