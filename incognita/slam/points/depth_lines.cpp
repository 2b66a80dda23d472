#include "incognita/slam/points/depth_lines.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/slam/points/association.hpp"

namespace incognita {
namespace {

/// A line with its hypotheses as predicted in the image.
struct PredictedLine {
  std::int64_t id = 0;
  DepthLine* line = nullptr;
  std::vector<PredictedHypothesis> hypotheses;

  /// To the nearest hypothesis; nothing when the camera has none before it.
  std::optional<double> distance2(const Eigen::Vector2d& pixel) const {
    std::optional<double> least;
    for (const PredictedHypothesis& h : hypotheses)
      if (const double distance2 = h.distance2(pixel); !least || distance2 < *least) least = distance2;
    return least;
  }
  bool gates(const Eigen::Vector2d& pixel, double gate) const {
    const auto distance = distance2(pixel);
    return distance && *distance <= gate;
  }
};

PredictedLine predicted_line(const Estimate& e, std::int64_t id, DepthLine& line,
                             const EstimatorSettings& settings) {
  const Landmark& ray = e.landmarks.at(id);
  const LandmarkParametrization form{LandmarkParametrization::Kind::inverse_depth, ray.form.initial_axes};
  const PointSensor& sensor = sensor_of(settings, line.body, line.sensor);
  const AnyMotion& motion = settings.bodies[static_cast<std::size_t>(line.body)].motion;
  const BlockId viewer = e.bodies[static_cast<std::size_t>(line.body)].block;
  const SmallVector state = e.belief.mean(viewer);
  PredictedLine out{id, &line, {}};
  Eigen::MatrixXd S(2, 2);
  for (std::size_t i = 0; i < line.depths.size(); ++i) {
    const SmallVector y = ray_at(ray, e.belief, line.depths[i].inverse_depth);
    const auto prediction = predict_measurement(sensor.sensor, motion, state, form, y);
    if (!prediction) continue;
    LinearizedMeasurement measurement;
    measurement.add(viewer, prediction->Hv);
    measurement.add(ray.block, SmallMatrix(prediction->Hl.leftCols(5)));
    measurement.residual = SmallVector::Zero(2);
    measurement.R = detection_noise(sensor, prediction->z);
    e.belief.innovation_covariance({&measurement, 1}, S);
    out.hypotheses.push_back({i, prediction->z, S});
  }
  return out;
}

/// Whether a match of this tick is a usable detection by the sensor of a line.
bool may_show(const Match& match, const DepthLine& line, const EstimatorSettings& settings) {
  return match.body == line.body && match.sensor == line.sensor && !match.of_body && !match.image &&
         is_usable(sensor_of(settings, match.body, match.sensor).sensor, match.measured);
}

/// Squared Mahalanobis distance that a match of probability `probability` does not exceed.
double gate_of(double probability) {
  return probability < 1 ? chi_square_quantile(probability, 2) : std::numeric_limits<double>::infinity();
}

/// By line, the index of the detection that shows it.
using Shown = std::vector<std::optional<std::size_t>>;

Shown shown_by_identity(const Estimate& e, const std::vector<PredictedLine>& lines,
                        const EstimatorSettings& settings) {
  const double gate = gate_of(settings.filter.gate_probability);
  Shown shown(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t m = 0; m < e.last.matches.size() && !shown[l]; ++m) {
      const Match& match = e.last.matches[m];
      if (match.id == lines[l].id && may_show(match, *lines[l].line, settings) &&
          lines[l].gates(match.measured, gate))
        shown[l] = m;
    }
  return shown;
}

/// Of the detections that match no landmark the nearest ones.
Shown shown_by_position(const Estimate& e, const std::vector<PredictedLine>& lines,
                        const EstimatorSettings& settings) {
  const double gate = gate_of(settings.association.gate_probability);
  std::vector<Candidate> candidates;
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t m = 0; m < e.last.matches.size(); ++m) {
      const Match& match = e.last.matches[m];
      if (match.id != Detection::unknown || !may_show(match, *lines[l].line, settings)) continue;
      const auto distance2 = lines[l].distance2(match.measured);
      if (distance2 && *distance2 <= gate)
        candidates.push_back({static_cast<int>(m), static_cast<int>(l), *distance2});
    }
  Shown shown(lines.size());
  for (const int c : nearest_first(candidates)) {
    const Candidate& chosen = candidates[static_cast<std::size_t>(c)];
    shown[static_cast<std::size_t>(chosen.landmark)] = static_cast<std::size_t>(chosen.measurement);
  }
  return shown;
}

/// Notes the match of a line as predicted, for display.
void note_line(Estimate& e, const PredictedLine& predicted, Match& match) {
  const PredictedRay ray = predicted_ray(predicted.line->depths, predicted.hypotheses);
  match.id = predicted.id;
  match.ray = true;
  match.predicted = ray.pixel;
  match.innovation_cov = ray.innovation_cov;
  match.first_particle = static_cast<int>(e.last.particles.size());
  match.particle_count = static_cast<int>(predicted.hypotheses.size());
  append_particles(predicted.line->depths, predicted.hypotheses, e.last.particles);
}

/// Re-weights the hypotheses by a match, and converts the line when its depth has converged. False when it is to be dropped.
bool match_line(Estimate& e, const PredictedLine& predicted, Match& match,
                const DepthLineSettings& settings) {
  DepthLine& line = *predicted.line;
  note_line(e, predicted, match);
  match.outcome = MatchOutcome::outlier;
  if (!reweight(line.depths, predicted.hypotheses, match.measured)) return false;
  match.outcome = MatchOutcome::matched;
  line.failures = 0;
  Landmark& landmark = e.landmarks.at(predicted.id);
  ++landmark.detection_count;
  const auto depth = converged_depth(line.depths, settings.depth_ratio);
  if (!depth) return true;
  convert_to_point(e.belief, landmark, *depth, settings.range.spacing_m());
  landmark.first = e.belief.mean(landmark.block);
  return true;
}

/// Those that no hypothesis of a line could have been measured at.
void keep_new(const Estimate& e, const std::vector<PredictedLine>& lines,
              std::vector<std::size_t>& candidates, const EstimatorSettings& settings) {
  if (settings.association.method == DataAssociationSettings::Method::known) return;
  const double gate = gate_of(settings.association.initialization_probability);
  std::erase_if(candidates, [&](std::size_t m) {
    const Match& match = e.last.matches[m];
    return std::ranges::any_of(lines, [&](const PredictedLine& l) {
      return may_show(match, *l.line, settings) && l.gates(match.measured, gate);
    });
  });
}

}  // namespace

void DepthLines::follow(Estimate& e, std::vector<std::size_t>& candidates,
                        const EstimatorSettings& settings) {
  if (!settings.depth_lines) return;
  std::vector<PredictedLine> lines;
  for (auto& [id, line] : lines_) lines.push_back(predicted_line(e, id, line, settings));
  keep_new(e, lines, candidates, settings);
  const bool by_identity = settings.association.method == DataAssociationSettings::Method::known;
  const Shown shown =
      by_identity ? shown_by_identity(e, lines, settings) : shown_by_position(e, lines, settings);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::int64_t id = lines[l].id;
    const bool stays = shown[l] ? match_line(e, lines[l], e.last.matches[*shown[l]], *settings.depth_lines)
                                : ++lines[l].line->failures < settings.depth_lines->max_failures;
    if (!stays) remove_landmark(e, id);
    if (!stays || e.landmarks.at(id).form.kind != LandmarkParametrization::Kind::ray) lines_.erase(id);
  }
}

void DepthLines::take_up(const Estimate& e, const EstimatorSettings& settings) {
  if (!settings.depth_lines) return;
  for (const Match& match : e.last.matches) {
    if (match.outcome != MatchOutcome::initialized) continue;
    const SmallVector ray = e.belief.mean(e.landmarks.at(match.id).block);
    const double ray_length = Eigen::Vector3d(ray[3], ray[4], 1).norm();
    lines_[match.id] = {match.body, match.sensor, uniform_depths(settings.depth_lines->range, ray_length), 0};
  }
}

}  // namespace incognita
