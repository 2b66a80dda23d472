#include "incognita/decision/information.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "incognita/math/gaussian.hpp"

namespace incognita {
namespace {

const LookJacobian* vehicle_part(const AffineLook& look, BlockId vehicle) {
  for (int i = 0; i < look.part_count; ++i)
    if (look.parts[i].block == vehicle) return &look.parts[i].H;
  return nullptr;
}

}  // namespace

double MutualInformation::operator()(const Belief& belief, const ImaginedMotion& motion,
                                     std::span<const AffineLook> looks) {
  if (looks.empty()) return 0;
  // H (F P F' + N) H' = (H F) P (H F)' + H N H': the covariance stays as it is, the Jacobians move
  moved_.assign(looks.begin(), looks.end());
  double log_det_R = 0;
  for (AffineLook& look : moved_) {
    for (int i = 0; i < look.part_count; ++i)
      if (look.parts[i].block == motion.vehicle) look.parts[i].H = (look.parts[i].H * motion.A).eval();
    log_det_R += log_det(look.R);
  }
  belief.innovation_covariance(moved_, S_);
  int row = 0;
  for (const AffineLook& a : looks) {
    int column = 0;
    for (const AffineLook& b : looks) {
      const LookJacobian *Ha = vehicle_part(a, motion.vehicle), *Hb = vehicle_part(b, motion.vehicle);
      if (Ha && Hb) S_.block(row, column, a.rows(), b.rows()) += *Ha * motion.N * Hb->transpose();
      column += b.rows();
    }
    row += a.rows();
  }
  return 0.5 * (log_det(S_) - log_det_R);
}

}  // namespace incognita
