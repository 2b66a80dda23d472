#include "incognita/decision/point_expectation.hpp"

#include <cmath>
#include <utility>

#include "incognita/decision/plan/expected_surface.hpp"
#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {

PointExpectation::PointExpectation(std::vector<BodyModel> bodies, std::size_t body, std::size_t sensor,
                                   int max_measurements)
    : bodies_(std::move(bodies)), body_(body), sensor_(sensor), max_measurements_(max_measurements) {}

/// Predicted measurement of a point from `state`, whose sensor is at `from`; empty if it is out of range or out of view.
std::optional<AnyPrediction> PointExpectation::predict_from(const SmallVector& state, const SmallVector& from,
                                                            const LandmarkParametrization& form,
                                                            const SmallVector& landmark,
                                                            const SmallVector& position) const {
  const double distance_m = (position - from).norm();
  if (distance_m > sensor().limits.max_range_m) return std::nullopt;
  auto prediction = predict_measurement(sensor().sensor, model().motion, state, form, landmark);
  if (!prediction || !is_in_view(sensor().sensor, sensor().limits, *prediction, distance_m))
    return std::nullopt;
  return prediction;
}

void PointExpectation::prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen,
                               double unseen_var_m2) {
  estimate_ = &estimate;
  unseen_ = &unseen;
  unseen_var_m2_ = unseen_var_m2;
  targets_.clear();
  add_targets();
}

void PointExpectation::add_targets() {
  const Estimate& e = *estimate_;
  const int dimensions = dimensions_of(sensor().sensor);
  for (const auto& [id, landmark] : e.landmarks) {
    if (!is_measurable(landmark, sensor().sensor)) continue;
    if (landmark.fixed) {
      targets_.push_back({{}, landmark.position, {}, 0, landmark.position, true});
      continue;
    }
    const SmallVector mean = e.belief.mean(landmark.block);
    const auto position = position_of(landmark.form, mean);
    const int errors = e.belief.chart(landmark.block).tangent();
    if (position)
      targets_.push_back({landmark.form, mean, SmallMatrix::Identity(errors, errors), landmark.block,
                          position->position, false});
  }
  for (std::size_t j = 0; j < e.bodies.size(); ++j) {
    if (j == body_) continue;
    const AnyPoint at = position_of(bodies_[j].motion, e.belief.mean(e.bodies[j].block), dimensions);
    targets_.push_back({{}, at.position, at.J, e.bodies[j].block, at.position, false});
  }
}

/// Trace of H P H': a ranking heuristic (current vehicle covariance), not the predicted innovation covariance.
double PointExpectation::innovation_trace(const PredictedMeasurement& measurement) const {
  const AnyBelief& belief = estimate_->belief;
  const BlockId viewer = estimate_->bodies[body_].block;
  double trace = (measurement.Hv * belief.covariance(viewer)).cwiseProduct(measurement.Hv).sum();
  if (measurement.of != PredictedMeasurement::Of::mapped) return trace;
  trace += (measurement.Hl * belief.covariance(measurement.block)).cwiseProduct(measurement.Hl).sum();
  return trace + 2 * (measurement.Hv * belief.covariance(viewer, measurement.block))
                         .cwiseProduct(measurement.Hl)
                         .sum();
}

bool PointExpectation::in_view(const BlockVector& state, const Eigen::Vector3d& position) const {
  const int dimensions = dimensions_of(sensor().sensor);
  const SmallVector own = state.head(chart_of(model().motion).ambient()), point = position.head(dimensions);
  return predict_from(own, position_of(model().motion, own, dimensions).position, {}, point, point)
      .has_value();
}

/// Adds the measurements of the map and of the team that are in view.
void PointExpectation::add_visible(const SmallVector& state, const SmallVector& from,
                                   std::vector<PredictedMeasurement>& measurements) const {
  for (const Target& target : targets_) {
    const auto prediction = predict_from(state, from, target.form, target.landmark, target.position);
    if (!prediction) continue;
    PredictedMeasurement& measurement = measurements.emplace_back();
    measurement.of = target.known ? PredictedMeasurement::Of::anchor : PredictedMeasurement::Of::mapped;
    measurement.block = target.block;
    measurement.Hv = prediction->Hv;
    if (target.known)
      measurement.Hl.resize(prediction->Hv.rows(), 0);
    else
      measurement.Hl = prediction->Hl * target.by_block;
    measurement.R = detection_noise(sensor(), prediction->z);
  }
}

/// Of those from `first` on; keeps their order.
void PointExpectation::keep_most_uncertain(std::vector<PredictedMeasurement>& measurements,
                                           std::size_t first) const {
  const auto most = static_cast<std::size_t>(max_measurements_);
  if (measurements.size() - first <= most) return;
  traces_.clear();
  for (std::size_t i = first; i < measurements.size(); ++i)
    traces_.push_back(innovation_trace(measurements[i]));
  const double least = least_of_the_best(traces_, max_measurements_, sorted_);
  std::size_t kept = first;
  for (std::size_t i = first; i < measurements.size() && kept - first < most; ++i) {
    if (traces_[i - first] < least) continue;
    if (kept != i) measurements[kept] = measurements[i];
    ++kept;
  }
  measurements.resize(kept);
}

void PointExpectation::add(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const {
  const int dimensions = dimensions_of(sensor().sensor);
  const SmallVector own = state.head(chart_of(model().motion).ambient());
  const SmallVector from = position_of(model().motion, own, dimensions).position;
  const std::size_t first = measurements.size();
  add_visible(own, from, measurements);
  keep_most_uncertain(measurements, first);
  for (const ExpectedLandmark& unseen : *unseen_) {
    if (dimensions == 3 && !sees_surface(from, unseen.position, unseen.normal)) continue;
    const SmallVector point = unseen.position.head(dimensions);
    const auto prediction = predict_from(own, from, {}, point, point);
    if (!prediction) continue;
    measurements.push_back({PredictedMeasurement::Of::unseen, 0, unseen.index, unseen_var_m2_, prediction->Hv,
                            prediction->Hl, detection_noise(sensor(), prediction->z)});
  }
}

}  // namespace incognita
