#include "incognita/slam/mapper/entropy.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "incognita/belief/cholesky.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// log|P| without allocation for matrices of a limited size.
template <class Matrix>
double log_det_of(const Matrix& P) {
  const Eigen::LLT<Matrix> llt(P);
  if (llt.info() != Eigen::Success) return unknown;
  return 2 * llt.matrixLLT().diagonal().array().log().sum();
}

template <class Matrix>
double entropy_of(const Matrix& P) {
  return gaussian_entropy(log_det_of(P), static_cast<int>(P.rows()));
}

int vehicle_errors(const Estimate& e) {
  int errors = 0;
  for (const Body& body : e.bodies) errors += e.belief.chart(body.block).tangent();
  return errors;
}

/// The errors that the entropies are of, in the order of the state: first those of the pose or poses, then the map. A
/// vehicle whose map is in its own frame precedes the pose of the world, and has no error of its own. Lasting errors of
/// matches lie between poses and map; the entropies are not of them.
struct ErrorRange {
  int first = 0;  ///< index of the first error
  int poses = 0;  ///< errors of the pose or poses
  int lasting = 0;
  int map = 0;

  int before_map() const { return poses + lasting; }
};
ErrorRange errors_of(const Estimate& e) {
  const int first = e.world ? e.belief.offset(*e.world) : 0;
  const int poses = e.world ? e.belief.chart(*e.world).tangent() : vehicle_errors(e);
  int lasting = 0;
  for (const BlockId block : e.lasting_errors) lasting += e.belief.chart(block).tangent();
  return {first, poses, lasting, e.belief.errors() - first - poses - lasting};
}

/// With a block-diagonal map: sums over its blocks, and the Schur complement of the vehicle for the total.
Entropy entropies_of_arrow(const Estimate& e) {
  const BlockId vehicle = e.body().block;
  double map = 0;
  int errors = 0;
  BlockMatrix left = e.belief.covariance(vehicle);
  for (const auto& [id, landmark] : e.landmarks) {
    if (landmark.fixed) continue;
    const BlockMatrix own = e.belief.covariance(landmark.block);
    const BlockMatrix cross = e.belief.covariance(vehicle, landmark.block);
    map += log_det_of(own);
    left -= cross * own.inverse() * cross.transpose();
    errors += static_cast<int>(own.rows());
  }
  const int own = static_cast<int>(left.rows());
  return {gaussian_entropy(log_det_of(BlockMatrix(e.belief.covariance(vehicle))), own),
          gaussian_entropy(map, errors), gaussian_entropy(map + log_det_of(left), errors + own)};
}

/// From the factor that the information form computes anyway.
Entropy entropies_of(const InformationBelief& belief, int vehicle) {
  const InformationBelief::LogDeterminants of = belief.log_determinants(vehicle);
  const int all = belief.errors();
  return {gaussian_entropy(of.first, vehicle), gaussian_entropy(of.others, all - vehicle),
          gaussian_entropy(of.all, all)};
}

void ensure(AlignedBuffer& buffer, std::size_t size) {
  if (buffer.size() < size) buffer = AlignedBuffer(size);
}

/// One factorization with the map first, the poses next and the lasting errors last: its leading parts are the factors of the
/// map, and of map and poses.
Entropy entropies_of(const Belief& belief, const ErrorRange& errors, AlignedBuffer& ordered,
                     AlignedBuffer& workspace) {
  const int size = errors.before_map() + errors.map, stride = round_up_to_panel(size) + rank_update_panel;
  ensure(ordered, static_cast<std::size_t>(stride) * size);
  ensure(workspace, cholesky_workspace(size));
  belief.copy_covariance(errors.first, errors.before_map(), ordered.data(), stride);
  Entropy entropy;
  if (!cholesky(ordered.data(), stride, size, workspace.data())) return entropy;
  const Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> L(ordered.data(), size, size,
                                                               Eigen::OuterStride<>(stride));
  const auto log_diagonal = L.diagonal().array().log();
  entropy.map = gaussian_entropy(2 * log_diagonal.head(errors.map).sum(), errors.map);
  const int total = errors.map + errors.poses;
  entropy.total = gaussian_entropy(2 * log_diagonal.head(total).sum(), total);
  return entropy;
}

template <class Matrix>
double entropy_of_bodies(const Estimate& e, int errors) {
  Matrix P(errors, errors);
  int row = 0;
  for (const Body& a : e.bodies) {
    int column = 0;
    for (const Body& b : e.bodies) {
      const BlockMatrix block = e.belief.covariance(a.block, b.block);
      P.block(row, column, block.rows(), block.cols()) = block;
      column += static_cast<int>(block.cols());
    }
    row += e.belief.chart(a.block).tangent();
  }
  return entropy_of(P);
}

/// In covariance form and with all correlations: the other forms have their factors at hand.
const Belief* belief_to_factorize(const Estimate& e) {
  return e.belief.drops_correlations() ? nullptr : std::get_if<Belief>(&e.belief.form());
}

Entropy entropies(const Estimate& e, AlignedBuffer& ordered, AlignedBuffer& workspace) {
  if (e.belief.drops_correlations()) return entropies_of_arrow(e);
  if (const auto* information = std::get_if<InformationBelief>(&e.belief.form()))
    return entropies_of(*information, vehicle_errors(e));
  Entropy entropy = entropies_of(*belief_to_factorize(e), errors_of(e), ordered, workspace);
  entropy.vehicle = vehicle_entropy(e);
  return entropy;
}

}  // namespace

double vehicle_entropy(const Estimate& e) {
  if (e.world) return entropy_of(BlockMatrix(e.belief.covariance(*e.world)));
  const int errors = vehicle_errors(e);
  return errors <= max_small ? entropy_of_bodies<SmallMatrix>(e, errors)  // no allocation in the loop
                             : entropy_of_bodies<Eigen::MatrixXd>(e, errors);
}

Entropy entropies(const Estimate& e) {
  AlignedBuffer ordered, workspace;
  return entropies(e, ordered, workspace);
}

long RunningEntropy::steps_per_tick(int errors) {
  constexpr long least = 8;
  const long tiles = (errors + TiledCholesky::tile - 1) / TiledCholesky::tile;
  return std::max(least, tiles * tiles / (2 * TiledCholesky::tile));
}

void RunningEntropy::update(Estimate& e, double t) {
  constexpr double period_s = 1;
  const bool due = !copy_t_ && (!last_start_t_ || has_come(*last_start_t_ + period_s, t));
  const bool at_once = e.belief.errors() <= max_errors_at_once || belief_to_factorize(e) == nullptr;
  if (due) last_start_t_ = t;
  if (due && at_once) {
    e.entropy = entropies(e, ordered_, workspace_);
    e.entropy_t = t;
    return;
  }
  e.entropy.vehicle = vehicle_entropy(e);
  if (due) start(e, t);
  if (copy_t_) advance(e);
}

void RunningEntropy::start(const Estimate& e, double t) {
  const ErrorRange errors = errors_of(e);
  belief_to_factorize(e)->copy_covariance(errors.first, errors.before_map(), cholesky_);
  map_errors_ = errors.map;
  total_errors_ = errors.map + errors.poses;
  copy_t_ = t;
}

void RunningEntropy::advance(Estimate& e) {
  if (!cholesky_.advance(steps_per_tick(cholesky_.size()))) return;
  e.entropy.map = gaussian_entropy(cholesky_.log_det(map_errors_), map_errors_);
  e.entropy.total = gaussian_entropy(cholesky_.log_det(total_errors_), total_errors_);
  e.entropy_t = std::exchange(copy_t_, std::nullopt);
}

}  // namespace incognita
