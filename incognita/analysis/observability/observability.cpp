#include "incognita/analysis/observability/observability.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "incognita/analysis/observability/explain_observability.hpp"
#include "incognita/analysis/observability/lie_derivatives.hpp"
#include "incognita/analysis/observability/observability_matrices.hpp"
#include "incognita/analysis/systems/system_motion.hpp"

namespace incognita {
namespace {

std::vector<SegmentAnalysis> analyze_segments(const SystemInstance& instance, const SystemMotion& motion,
                                              const std::vector<LinearizedSystem>& forms,
                                              const NullSpaceSettings& rank) {
  std::vector<double> durations;
  for (const MotionSegment& s : motion.segments) durations.push_back(s.duration_s);
  const auto named = instance.directions(motion.segments.front().start, true);
  const auto Q = segment_observability(forms);
  const auto stripped = stripped_observability(Q), total = total_observability(Q, forms, durations);
  std::vector<SegmentAnalysis> segments;
  bool holds = true;
  for (std::size_t k = 0; k < forms.size(); ++k) {
    holds = holds && null_space_stays(forms[k], null_space(Q[k], rank));
    segments.push_back({observable_space(stripped[k], named, instance.error_names(), rank),
                        observable_space(total[k], named, instance.error_names(), rank), holds});
  }
  return segments;
}

/// Records all that was drawn or chosen, so that the results are reproducible.
void report_motion(ObservabilityAnalysis& analysis, const SystemInstance& instance,
                   const SystemMotion& motion, const std::vector<MotionSample>& samples) {
  const SymbolicSystem& system = instance.system();
  for (const NamedRange& input : system.input_ranges) analysis.inputs.push_back(input.name);
  for (const NamedRange& constant : system.anchor.region) analysis.constants.push_back(constant.name);
  for (const MotionSegment& segment : motion.segments) {
    analysis.points.push_back(segment.start);
    analysis.durations_s.push_back(segment.duration_s);
  }
  analysis.measurements_per_segment = static_cast<int>((samples.size() - 1) / motion.segments.size());
  for (const MotionSample& sample : samples) analysis.measurement_times_s.push_back(sample.t);
}

/// Number of samples that yields enough rows for the rank.
int samples_per_segment(const SystemInstance& instance, int segments) {
  const int wanted = 3 * instance.states() / std::max(1, instance.measurements() * segments) + 1;
  return std::max(wanted, 8);
}

/// Width of each state's region.
std::vector<double> region_widths(const SystemInstance& instance) {
  std::vector<double> widths;
  const auto add = [&](const SymbolicSystem::Block& block) {
    for (const NamedRange& range : block.region) widths.push_back(range.high - range.low);
  };
  add(instance.system().vehicle);
  for (int i = 0; i < instance.landmarks(); ++i) add(instance.system().landmark);
  return widths;
}

/// Cramer-Rao bound of each initial state from the measurements alone: the pseudo-inverse of the information,
/// for states outside of the null space.
std::vector<StateInformation> information_of(const NoisyRows& whitened, const ObservableSpace& seen,
                                             const SystemInstance& instance) {
  const NullSpace& space = seen.space;
  const Eigen::MatrixXd scaled = whitened.rows * space.column_scale.asDiagonal();
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const std::vector<bool> unobservable = touched(space.scaled_null);
  const std::vector<double> widths = region_widths(instance);
  std::vector<StateInformation> information;
  for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
    double variance = 0;
    for (Eigen::Index k = 0; k < std::min<Eigen::Index>(space.rank, svd.singularValues().size()); ++k)
      variance += std::pow(svd.matrixV()(i, k) * space.column_scale[i] / svd.singularValues()[k], 2);
    const auto at = static_cast<std::size_t>(i);
    StateInformation of{instance.names()[at], std::nullopt, widths[at], false};
    if (!unobservable[at]) of.sigma = std::sqrt(variance);
    constexpr double much = 10;
    of.weakly_observable = of.sigma && of.region_width > 0 && *of.sigma > much * of.region_width;
    information.push_back(of);
  }
  return information;
}

}  // namespace

ObservabilityAnalysis analyze_observability(const SystemText& text, const ObservabilitySettings& settings) {
  const SymbolicSystem system = make_symbolic(text, settings.motion);
  const SystemInstance instance(system, settings.landmarks, settings.anchors);
  RandomStream random(settings.seed, "operating points");
  const SystemMotion motion = draw_motion(instance, settings.segments, random);

  ObservabilityAnalysis analysis;
  analysis.system = text.name;
  analysis.representation = text.representation;
  analysis.motion = settings.motion;
  analysis.landmarks = settings.landmarks;
  analysis.anchors = settings.anchors;
  analysis.states = instance.names();
  analysis.error_states = instance.error_names();
  for (const MotionSegment& segment : motion.segments)
    analysis.error_forms.push_back(instance.error_form(segment.start));
  analysis.segments = analyze_segments(instance, motion, analysis.error_forms, settings.rank);

  const auto samples = follow(instance, motion, samples_per_segment(instance, settings.segments));
  report_motion(analysis, instance, motion, samples);
  for (const MotionSample& sample : samples)
    analysis.growth = std::max(analysis.growth, sample.Phi.cwiseAbs().maxCoeff());
  const auto named = instance.directions(motion.segments.front().start, false);
  analysis.local =
      observable_space(local_observability(instance, samples, false), named, instance.names(), settings.rank);
  const NoisyRows whitened = local_observability(instance, samples, true);
  analysis.fisher = observable_space(whitened, named, instance.names(), settings.rank);
  analysis.information = information_of(whitened, analysis.fisher, instance);
  analysis.sigmas_trusted = analysis.growth <= most_growth && !analysis.fisher.space.ambiguous;
  if (settings.lie) {
    analysis.lie = analyze_lie(instance, motion, random, settings.lie_settings, settings.rank);
    analysis.lie_directions = named_directions(analysis.lie->space, named, instance.names());
  }
  analysis.disagreements = disagreements_in(analysis, instance, motion, samples, settings.rank);
  analysis.doubts = doubts_in(analysis);
  analysis.notes = notes_on(analysis, system);
  return analysis;
}

}  // namespace incognita
