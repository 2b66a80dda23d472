#include "incognita/slam/points/team_association.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/points/association.hpp"
#include "incognita/slam/points/team_looks.hpp"

namespace incognita {
namespace {

std::vector<std::size_t> in_order(const std::vector<Sighting>& sightings, const TeamSettings& settings) {
  std::vector<std::size_t> order(sightings.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const Sighting &a = sightings[i], &b = sightings[j];
    const bool a_named = settings.anchors.count(a.identity) > 0;
    const bool b_named = settings.anchors.count(b.identity) > 0;
    if (a_named != b_named) return a_named;
    if (a_named) return a.identity < b.identity;
    return std::lexicographical_compare(a.z.begin(), a.z.end(), b.z.begin(), b.z.end());
  });
  return order;
}

/// The sightings without a name, against every landmark.
class NamelessSightings {
 public:
  NamelessSightings(const TeamEstimate& e, int vehicle, const std::vector<Sighting>& sightings,
                    std::vector<std::size_t> nameless, const TeamSettings& settings)
      : e_(e),
        vehicle_(vehicle),
        sightings_(sightings),
        nameless_(std::move(nameless)),
        settings_(settings),
        fresh_(nameless_.size(), true) {
    if (nameless_.empty()) return;
    const auto rows = static_cast<int>(sightings_[nameless_.front()].z.size());
    gate_ = chi_square_quantile(settings.association.gate_probability, rows);
    birth_gate_ = chi_square_quantile(settings.association.birth_probability, rows);
    for (const auto& [number, landmark] : e.landmarks) hold_against(number);
  }

  void tell(ViewAssociation& out) const {
    for (const int c : nearest_first(candidates_)) {
      const Candidate& pair = candidates_[static_cast<std::size_t>(c)];
      out.landmarks[nameless_[static_cast<std::size_t>(pair.measurement)]] =
          numbers_[static_cast<std::size_t>(pair.landmark)];
    }
    for (std::size_t s = 0; s < nameless_.size(); ++s)
      if (fresh_[s]) out.newcomers.push_back(nameless_[s]);
  }

 private:
  /// What is predicted of a landmark is the same for all sightings; only residual and noise are their own.
  void hold_against(std::int64_t number) {
    auto expected =
        linearised_sighting(e_, vehicle_, false, {number, sightings_[nameless_.front()].z}, settings_);
    if (!expected) return;
    const TeamMember& member = settings_.members[static_cast<std::size_t>(vehicle_)];
    e_.belief.innovation_covariance({&expected->look, 1}, S_);
    const SmallMatrix believed = S_ - expected->look.R;
    for (std::size_t s = 0; s < nameless_.size(); ++s) {
      measure(*expected, member, sightings_[nameless_[s]].z);
      const Eigen::LLT<SmallMatrix> llt(SmallMatrix(believed + expected->look.R));
      if (llt.info() != Eigen::Success) continue;
      const double distance = llt.matrixL().solve(SmallVector(expected->look.residual)).squaredNorm();
      if (distance <= birth_gate_) fresh_[s] = false;
      if (distance <= gate_)
        candidates_.push_back({static_cast<int>(s), static_cast<int>(numbers_.size()), distance});
    }
    numbers_.push_back(number);
  }

  const TeamEstimate& e_;
  int vehicle_;
  const std::vector<Sighting>& sightings_;
  std::vector<std::size_t> nameless_;  ///< indices of sightings
  const TeamSettings& settings_;
  std::vector<bool> fresh_;  ///< per nameless sighting: outside every wide gate
  double gate_ = 0, birth_gate_ = 0;
  std::vector<std::int64_t> numbers_;  ///< of the landmarks that candidates speak of
  std::vector<Candidate> candidates_;  ///< inside the gate
  Eigen::MatrixXd S_;
};

}  // namespace

ViewAssociation associate_view(const TeamEstimate& e, int vehicle, const std::vector<Sighting>& sightings,
                               const TeamSettings& settings) {
  ViewAssociation out;
  out.order = in_order(sightings, settings);
  out.landmarks.assign(sightings.size(), Detection::unknown);
  std::vector<std::size_t> nameless;
  for (const std::size_t s : out.order) {
    if (settings.anchors.count(sightings[s].identity) > 0)
      out.landmarks[s] = sightings[s].identity;
    else
      nameless.push_back(s);
  }
  NamelessSightings(e, vehicle, sightings, std::move(nameless), settings).tell(out);
  return out;
}

}  // namespace incognita
