// Validation of the settings of a team.
#include <string>
#include <variant>

#include "incognita/slam/mapper/settings.hpp"

namespace incognita {
namespace {

bool is_planar(const BodyModel& b) { return traits_of(b.motion).is_planar_pose(); }

bool measures_points_of_plane(const BodyModel& b) {
  return std::all_of(b.sensors.begin(), b.sensors.end(), [](const PointSensor& s) {
    return dimensions_of(s.sensor) == 2 && measures_distance(s.sensor);
  });
}

bool measures_all_distances(const BodyModel& b) {
  return std::all_of(b.sensors.begin(), b.sensors.end(),
                     [](const PointSensor& s) { return measures_distance(s.sensor); });
}

std::string wrong_size(const SmallVector& v, int size, const char* what) {
  if (v.size() == size && v.allFinite()) return "";
  return std::string(what) + ": " + std::to_string(size) + " finite numbers are wanted, and there are " +
         std::to_string(v.size());
}

std::string validate_sizes(const BodyModel& b) {
  const Chart& chart = chart_of(b.motion);
  for (const std::string& problem :
       {wrong_size(b.start, chart.ambient(), "the start of a vehicle"),
        wrong_size(b.start_sigmas, chart.tangent(), "the sigmas of a vehicle's start"),
        wrong_size(b.input_sigmas, inputs_of(b.motion), "the sigmas of a vehicle's inputs")})
    if (!problem.empty()) return problem;
  return "";
}

std::string validate_sensor(const BodyModel& b, const PointSensor& s) {
  for (const std::string& problem :
       {incompatibility(b.motion, s.sensor),
        wrong_size(s.sigmas, chart_of(s.sensor).tangent(), "the sigmas of a measurement")})
    if (!problem.empty()) return problem;
  if (!(s.sigmas.minCoeff() > 0)) return "the sigmas of a measurement must be more than 0";
  return "";
}

/// Whether the information form can represent the settings: it needs positive sigmas.
std::string validate_information(const EstimatorSettings& s) {
  for (const BodyModel& m : s.bodies) {
    if (!(m.start_sigmas.minCoeff() > 0))
      return "a start that is known exactly has infinite information, which the information form cannot "
             "represent: give all sigmas of a vehicle's start more than 0, or take `covariance`";
    if (!measures_all_distances(m) && !(s.filter.sigma_inverse_depth_per_m > 0))
      return "an inverse depth that is known exactly at initialization has infinite information, which the "
             "information form cannot represent: give it a sigma of more than 0, or take `covariance`";
  }
  return "";
}

/// The iterated update linearizes at a point that depends on the measurement noise. Without anchors each
/// update thereby rotates the whole map slightly and systematically: the displacement of a point under a
/// rotation depends on its position, which the update changes. Inverse depths are less affected, so a
/// landmark must be well converged before its conversion to a point: with stereo and 1 px the NEES over 20 s
/// is 4.6 with conversion at an index of 0.1, and 1.1 at 0.02 or with anchors.
std::string validate_iterated(const BodyModel& m, const EstimatorSettings& s) {
  constexpr double most = 0.03;
  constexpr double most_velocity = 0.02;
  if (!traits_of(m.motion).in_space()) return "";
  // Depths and velocity are observed only as a ratio: the iterated update is overconfident in both
  if (!measures_all_distances(m) && m.start_sigmas.tail<6>().maxCoeff() > most_velocity)
    return "the iterated update of one camera that flies off with a velocity that nobody knows diverges: let "
           "it "
           "start from rest (sigmas of velocity and rate at most 0.02), or take `analytic`";
  if (!s.anchors.empty()) return "";
  if (s.filter.max_linearity_index <= most) return "";
  return "the iterated update of a body that turns freely in space turns a map that no anchor fixes, where "
         "landmarks become points at a linearity index above 0.03: lower it (landmark_initialization.max_linearity), give "
         "anchors, "
         "or take `analytic`";
}

/// A vehicle-frame map requires one vehicle on a plane.
std::string validate_map_frame(const EstimatorSettings& s) {
  const MapperSettings& f = s.filter;
  if (f.map_frame == MapFrame::world) return "";
  if (s.bodies.size() > 1)
    return "estimator.map_frame = `vehicle`: a map in the frame of one of several vehicles is not supported; take `world`";
  if (!is_planar(s.bodies.front()) || !measures_points_of_plane(s.bodies.front()))
    return "estimator.map_frame = `vehicle`: only for a vehicle on a plane that measures ranges and bearings; take `world`";
  if (f.form == BeliefForm::information)
    return "estimator.map_frame = `vehicle`: the information form cannot change the frame of a map; take `world`, or `covariance` for estimator.form";
  return "";
}

/// Decorrelation requires one vehicle in covariance form.
std::string validate_decorrelation(const EstimatorSettings& s) {
  const MapperSettings& f = s.filter;
  if (f.decorrelate == Decorrelation::nothing) return "";
  if (s.bodies.size() > 1) return "estimator.decorrelate: only for one vehicle; take `nothing`";
  if (f.form == BeliefForm::information)
    return "estimator.decorrelate: the information form keeps all correlations; take `nothing`";
  return "";
}

std::string validate_association(const EstimatorSettings& s) {
  const DataAssociationSettings& a = s.association;
  const bool known = a.method == DataAssociationSettings::Method::known;
  if (!known && !(a.gate_probability < 1 && a.initialization_probability < 1 &&
                  a.gate_probability <= a.initialization_probability))
    return "the gate of a new landmark must be the gate of a match or wider, and both less than 1";
  if (known && !s.anchors_have_identity && !s.anchors.empty())
    return "estimator.anchors_m: with association by identity each anchor needs one";
  return "";
}

/// Lines are for landmarks whose detections have no depth.
std::string validate_depth_lines(const PointSensor& sensor, const EstimatorSettings& s) {
  if (!s.depth_lines) return "";
  if (dimensions_of(sensor.sensor) != 3 || measures_distance(sensor.sensor))
    return "landmark_initialization.method = `depth-line` is for monocular cameras, whose detections have no depth";
  const DepthLineSettings& lines = *s.depth_lines;
  if (lines.range.count < 2 || !(0 < lines.range.min_m && lines.range.min_m < lines.range.max_m) ||
      !(lines.depth_ratio > 0) || lines.max_failures < 1)
    return "depth lines need two hypotheses or more at increasing, positive depths, and positive limits";
  return "";
}

std::string validate_anchors(const PointSensor& sensor, const EstimatorSettings& s) {
  for (const auto& [id, anchor] : s.anchors)
    if (anchor.size() != dimensions_of(sensor.sensor))
      return "anchor " + std::to_string(id) + " must have as many numbers as the place has dimensions";
  return "";
}

std::string validate_body(const BodyModel& b, const EstimatorSettings& s) {
  if (const std::string problem = validate_sizes(b); !problem.empty()) return problem;
  for (const PointSensor& sensor : b.sensors)
    for (const std::string& problem :
         {validate_sensor(b, sensor), validate_anchors(sensor, s), validate_depth_lines(sensor, s)})
      if (!problem.empty()) return problem;
  if (s.filter.linearization == Linearization::first_estimate &&
      !(is_planar(b) && measures_points_of_plane(b)))
    return "first-estimate Jacobians are derived for ranges and bearings on a plane only; take `analytic`";
  if (s.filter.linearization == Linearization::invariant &&
      !(s.bodies.size() == 1 && std::holds_alternative<FreeCameraMotion>(b.motion) && b.sensors.empty() &&
        !(b.sigma_fix_m > 0) && s.filter.form == BeliefForm::covariance &&
        s.filter.decorrelate == Decorrelation::nothing))
    return "invariant errors are derived for one camera that moves freely, in covariance form with all correlations; take "
           "`analytic`";
  return s.filter.linearization == Linearization::iterated ? validate_iterated(b, s) : "";
}

std::string validate_health(const HealthSettings& h) {
  const bool counts =
      h.min_matches > 0 && h.max_ticks > 0 && h.min_expected > 0 && h.min_matches_to_relocate > 0;
  const bool sigmas = h.max_sigma_position_m > 0 && h.max_sigma_ratio > 0 && h.max_innovation_sigmas > 1 &&
                      h.sigma_search_position_m > 0 && h.sigma_search_rotation_rad > 0 &&
                      h.sigma_search_velocity_m_s > 0 && h.sigma_search_rate_rad_s > 0;
  return counts && sigmas ? ""
                          : "the limits of the health must be positive, max_innovation_sigmas more than 1";
}

}  // namespace

std::string validate(const EstimatorSettings& s) {
  if (s.bodies.empty()) return "an estimator needs a vehicle";
  for (const std::string& problem :
       {validate_map_frame(s), validate_decorrelation(s), validate_association(s), validate_health(s.health)})
    if (!problem.empty()) return problem;
  if (const auto conflict = find_incompatibility(s.filter))
    return std::string(conflict->key) + ": " + conflict->why;
  for (const BodyModel& b : s.bodies)
    if (const std::string problem = validate_body(b, s); !problem.empty()) return problem;
  return s.filter.form == BeliefForm::information ? validate_information(s) : "";
}

}  // namespace incognita
