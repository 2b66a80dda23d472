#include "incognita/slam/mapper/saved_estimate.hpp"

#include <string>

#include "incognita/slam/mapper/depth_hypotheses.hpp"
#include "incognita/slam/mapper/entropy.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, Readout& readout) {
  auto& [of_columns, s] = readout;
  archive(of_columns, s);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, TrackingStatus& status) {
  auto& [state, reason] = status;
  archive(state, reason);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, BodyHealth& health) {
  auto& [frames_with_few, unmatched_ticks, readout] = health;
  archive(frames_with_few, unmatched_ticks, readout);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, MatchCounts& counts) {
  auto& [searched, image_matches, matched] = counts;
  archive(searched, image_matches, matched);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, MatchedTarget& target) {
  auto& [of_body, id, distance_m] = target;
  archive(of_body, id, distance_m);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, MeasuredTwist& measured) {
  auto& [twist, cov, period_s] = measured;
  archive(twist, cov, period_s);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Body& body) {
  auto& [block, prediction, t, first_fix_t, input, twist, input_t, input_period, wheels, state,
         state_covariance, pose, pose_covariance, waits, counts, status, health, matched_last,
         start_sigma_m] = body;
  archive(block, prediction, t, first_fix_t, input, twist, input_t, input_period, wheels, state,
          state_covariance, pose, pose_covariance, waits, counts, status, health, matched_last,
          start_sigma_m);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, LandmarkParametrization& form) {
  auto& [kind, initial_axes] = form;
  archive(kind, initial_axes);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Landmark& landmark) {
  auto& [id, fixed, form, block, position, first, by_turn, detection_count, expected_scans, detected_scans,
         camera, first_view] = landmark;
  archive(id, fixed, form, block, position, first, by_turn, detection_count, expected_scans, detected_scans,
          camera, first_view);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, UpdateHealth& health) {
  auto& [doubted_ticks, recent_nis, recent_rows] = health;
  archive(doubted_ticks, recent_nis, recent_rows);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Entropy& entropy) {
  auto& [vehicle, map, total] = entropy;
  archive(vehicle, map, total);
}

namespace {

void expect_block(const Estimate& e, BlockId block, const std::string& of) {
  if (!e.belief.has(block)) throw DamagedState("the block of " + of + " is not in the belief");
}

void check_blocks(const Estimate& e) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i)
    expect_block(e, e.bodies[i].block, "body " + std::to_string(i + 1));
  if (e.world) expect_block(e, *e.world, "the world");
  for (const BlockId block : e.lasting_errors) expect_block(e, block, "a lasting error");
  for (const auto& [id, landmark] : e.landmarks) {
    if (landmark.id != id) throw DamagedState("landmark " + std::to_string(id) + " has another id");
    if (!landmark.fixed) expect_block(e, landmark.block, "landmark " + std::to_string(id));
  }
}

}  // namespace

void estimate_state(StateArchive& archive, Estimate& estimate) {
  auto& [belief, started, first_t, bodies, world, lasting_errors, landmarks, next_id, status, health, entropy,
         entropy_t, last, timing_ms] = estimate;
  archive(belief, started, first_t, bodies, world, lasting_errors, landmarks, next_id, status, health,
          entropy, entropy_t);
  if (!archive.restores()) return;
  last = {};
  timing_ms.clear();
  if (started) check_blocks(estimate);
}

void DepthHypothesis::state(StateArchive& archive) {
  auto& [inverse_depth_, weight_] = *this;
  archive(inverse_depth_, weight_);
}

void RunningEntropy::state(StateArchive& archive) {
  auto& [ordered, workspace, cholesky, map_errors, total_errors, copy_t, last_start_t] = *this;
  archive(map_errors, total_errors, copy_t, last_start_t);
  if (copy_t) archive(cholesky);
  const bool fits =
      !copy_t || (0 <= map_errors && map_errors <= total_errors && total_errors <= cholesky.size());
  if (!fits) throw DamagedState("entropies of " + std::to_string(total_errors) + " errors");
}

}  // namespace incognita
