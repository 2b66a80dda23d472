// Errors of matches that last over many frames, as part of the state.
//
// A patch that is not quite a plane, or that is centered beside its corner, is matched at the wrong place, and at nearly the same
// wrong place in the next frame. A filter that took such errors for white noise would count one error as new information in each
// frame. Here the error of a match, px, is white noise plus a first-order Gauss-Markov process per landmark, which the filter
// estimates with the rest of the state ("shaping filter": Bar-Shalom, Li, Kirubarajan 2001, Section 8.2).
//
// Only landmarks in view need such a state; also those that are not searched for in every frame, since one that lost it would count
// the same error as new information at its next match. A fixed number of blocks, added before the first landmark, is lent to them:
// the belief neither grows nor is reordered when landmarks come and go.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "incognita/slam/features/settings.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class StateArchive;

struct FeatureMatch;

class LastingErrors {
 public:
  /// Adds the blocks, of two errors each, for `most_in_view` landmarks: twice as many, since those in view change. To be called
  /// before the first landmark; without a lasting error in the settings it adds none.
  void start(Estimate& estimate, const FilterSettings& settings, int most_in_view);
  /// Prediction over `dt` s: each error decays, and its variance returns to that of the settings.
  void predict(Estimate& estimate, const FilterSettings& settings, double dt) const;
  /// Lends a block to the landmark of each match that corrects the filter; blocks that were not used for longest are taken from
  /// theirs. A new error is independent of the state. That the plane of a patch is not known makes it larger, and it changes with
  /// what is known. `matches`: with plane_cov, px^2, in pixels of the image.
  void lend(Estimate& estimate, const FilterSettings& settings, std::span<const FeatureMatch> matches);
  /// Takes all blocks back: other views have other errors.
  void take_back();

  /// Of a landmark, the block of its error; nothing while it has none.
  std::optional<BlockId> of(std::int64_t landmark) const;

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  struct Slot {
    BlockId block = 0;
    std::optional<std::int64_t> landmark;
    std::int64_t used = 0;                                ///< the last frame with a match
    Eigen::Matrix2d plane_cov = Eigen::Matrix2d::Zero();  ///< px^2, of that match
    void state(StateArchive& archive);
  };
  std::optional<std::size_t> index_of(std::int64_t landmark) const;
  void use_again(Estimate& estimate, Slot& slot, const Eigen::Matrix2d& plane_cov);
  Slot& longest_unused();

  std::vector<Slot> slots_;
  std::int64_t frame_ = 0;
};

}  // namespace incognita
