#include "incognita/math/gaussian.hpp"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace incognita {

double log_det(const Eigen::Ref<const Eigen::MatrixXd>& spd) {
  if (spd.size() == 0) return 0;
  const Eigen::LLT<Eigen::MatrixXd> llt(spd);
  if (llt.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return 2 * llt.matrixLLT().diagonal().array().log().sum();
}

double gaussian_entropy(double log_det_covariance, int dimensions) {
  return 0.5 * (dimensions * std::log(2 * std::numbers::pi * std::numbers::e) + log_det_covariance);
}

double chi_square_quantile(double probability, int dof) {
  if (dof < 1 || !(probability > 0 && probability < 1))
    throw std::invalid_argument("chi_square_quantile needs dof >= 1 and 0 < probability < 1, got dof " +
                                std::to_string(dof) + ", probability " + std::to_string(probability));
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

}  // namespace incognita
