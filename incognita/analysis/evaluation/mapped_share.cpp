#include "incognita/analysis/evaluation/mapped_share.hpp"

#include <numeric>
#include <utility>

namespace incognita {

MappedShare::MappedShare(std::vector<double> weights)
    : weights_(std::move(weights)),
      total_(std::accumulate(weights_.begin(), weights_.end(), 0.0)),
      mapped_in_(weights_.size(), -1) {}

void MappedShare::restart() {
  ++map_;
  mapped_ = 0;
}

void MappedShare::add(std::optional<std::size_t> part, const Eigen::Vector3d& truth,
                      const Eigen::Vector3d& estimate) {
  if (!part || mapped_in_.at(*part) == map_ || !((estimate - truth).norm() <= mapped_within_m)) return;
  mapped_in_[*part] = map_;
  mapped_ += weights_[*part];
}

std::optional<double> MappedShare::share() const {
  if (!(total_ > 0)) return std::nullopt;
  return mapped_ / total_;
}

}  // namespace incognita
