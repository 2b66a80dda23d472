// Examples 3.2 and 3.5: the car park without anchors, and with two. See car_park.hpp for the drive, its
// noises and its start.
//
// Measured and held:
// - 3.2: the map against the survey before and after a rigid fit; the relative map within 0.25 m rms, the map
//   before the fit at least twice as far off. How shift and turn depend on the start; which beacons are
//   mapped. The plain EKF beside one with an unscented vehicle, from headings known to 5, 15 and 30 degrees.
// - 3.5: errors and variances less than half of those without anchors; final sigmas from other starts within 10 %
//   of each other; landmarks within 0.25 m rms of the survey and vehicle within 0.20 m rms of GPS, not fitted.
#include <Eigen/Eigenvalues>

#include "experiments/car_park.hpp"
#include "experiments/common.hpp"

namespace incognita {
namespace {

using namespace car_park;

const Variant plain_ekf{}, first_estimate{.linearization = Linearization::first_estimate},
    anchored_ekf{.anchored = true},
    anchored_first_estimate{.anchored = true, .linearization = Linearization::first_estimate};

constexpr double good_map_m = 0.25;

std::string numbers(const Drive& d) {
  return fmt::format(
      "map {:.3f} m rms, turned by {:.1f}° and shifted by {:.2f} m; {:.3f} m after the fit; vehicle {:.2f} m "
      "rms from GPS, {:.2f} m after a fit of its own",
      d.map_rms_m, degrees(-d.fitted.fit.turn_rad), d.fitted.fit.shift.norm(), d.fitted.error.rms_m,
      d.path_rms_m, d.fitted_path_rms_m);
}

Claim relative_map(const Drive& ekf, const Drive& fej) {
  return assessed("3.2-relative-map", "Example 3.2, Figure 3.6",
                  "The relative map is internally consistent, but rotated and shifted from the actual "
                  "beacons: within 0.25 m rms after a rigid fit, at least twice as far before",
                  {.rule = Rule::superiority,
                   .measured = {"EKF: {}. With first-estimate Jacobians: {}", numbers(ekf), numbers(fej)},
                   .number = exactly("map after a rigid fit, rms", ekf.fitted.error.rms_m, "m")},
                  ekf.fitted.error.rms_m < good_map_m && ekf.map_rms_m > 2 * ekf.fitted.error.rms_m);
}

/// Detections are of reflectors only: beams with an intensity (docs/range-recordings.md). Those of surveyed landmarks
/// are within 1 m of one.
Claim trunks(const Data& data) {
  std::vector<int> detected(data.beacons.size());
  int all = 0, of_landmarks = 0;
  for (const auto& scan : data.recording.scans)
    for (const Detection& d : scan.detections) {
      ++all;
      if (d.identity == Detection::unknown) continue;
      ++of_landmarks;
      ++detected[static_cast<std::size_t>(d.identity)];
    }
  const auto often = std::ranges::count_if(detected, [](int times) { return times >= 10; });
  const auto surveyed = static_cast<std::ptrdiff_t>(detected.size());
  return assessed(
      "3.2-trunks", "Example 3.2",
      "The landmarks are tree trunks, which the laser does not mark as reflectors: fewer than half of the "
      "surveyed ones are marked so at least ten times",
      {.rule = Rule::example,
       .printed = "tree trunks, as measured with a laser range finder",
       .measured = {"{} of {} surveyed landmarks; {} of {} reflectors in the scans are within 1 m of one",
                    often, surveyed, of_landmarks, all},
       .number = exactly("surveyed landmarks that are marked as reflectors at least ten times",
                         static_cast<double>(often)),
       .why = "they are reflectors: most of the surveyed ones are marked as such"},
      2 * often < surveyed, in_truth(2 * often > surveyed));
}

Claim mapped_once(const Drive& ekf, const Drive& fej) {
  const auto once = [](const Drive& d) {
    return d.often_seen_mapped == d.often_seen && d.fitted.error.twice.empty() &&
           d.fitted.error.unmatched.empty();
  };
  const auto counts = [](const Drive& d) {
    return fmt::format(
        "{} of {} such beacons, {} landmarks in all, {} twice, {} of no beacon, {} of {} matches wrong",
        d.often_seen_mapped, d.often_seen, d.landmarks.size(), d.fitted.error.twice.size(),
        d.fitted.error.unmatched.size(), d.wrong, d.matched);
  };
  return assessed("3.2-mapped-once", "Figure 3.6",
                  "Every beacon that is detected at least ten times is mapped, none twice",
                  {.rule = Rule::example,
                   .measured = {"EKF: {}. First-estimate Jacobians: {}", counts(ekf), counts(fej)}},
                  once(ekf));
}

Claim depends_on_the_start(const Data& data) {
  const auto turn = [](const Drive& d) { return degrees(-d.fitted.fit.turn_rad); };
  std::vector<double> off{-10, 0, 10, 20}, turns, turns_by_sigma, shifts_by_sigma;
  for (const double o : off) turns.push_back(turn(drive(data, {.start = {.heading_off_deg = o}})));
  for (const double times : {1.0 / 3, 1.0, 2.0}) {  // of 15 degrees
    const Drive d = drive(data, {.start = {.heading_times = times}});
    turns_by_sigma.push_back(turn(d));
    shifts_by_sigma.push_back(d.fitted.fit.shift.norm());
  }
  const auto spread = [](const std::vector<double>& v) {
    return *std::ranges::max_element(v) - *std::ranges::min_element(v);
  };
  const Interval slope = slope_of(off, turns);
  return assessed(
      "3.2-start", "Example 3.2, Figure 3.5 (c)",
      "The amount of shift and turn depends on the initial vehicle uncertainty: a start with a heading sigma "
      "of 5, 15 or 30° changes the turn of the map by at least a degree or its shift by 0.2 m",
      {.rule = Rule::equality,
       .printed = "depends on the initial vehicle uncertainty",
       .measured = {"EKF, with sigma 5, 15, 30°: turned by {:.1f}°, shifted by {:.2f} m; with the start's "
                    "heading off by -10, 0, 10, 20° more: turned by {:.1f}°, slope {}",
                    fmt::join(turns_by_sigma, ", "), fmt::join(shifts_by_sigma, ", "), fmt::join(turns, ", "),
                    text(slope)},
       .number = ClaimNumber{"turn of the map over the initial heading's error, slope", slope},
       .why = "depends on the initial error, degree for degree (slope within 0.1 of 1)"},
      spread(turns_by_sigma) > 1 || spread(shifts_by_sigma) > 0.2, as_corrected(agrees(slope, 1, 0.1)));
}

/// The least sigma of a landmark at the end over what the start allows in the same direction: that of a landmark
/// measured without noise by a vehicle that is known as well as at the start.
double least_over_the_start(const Drive& d, const PlanarStartSettings& start) {
  const double position = std::pow(start.sigma_position_m, 2), heading = std::pow(start.sigma_heading_rad, 2);
  double least = 1e300;
  for (std::size_t i = 0; i < d.landmarks.size(); ++i) {
    const Vector2d to = d.landmarks[i] - d.path.front(), across(-to.y(), to.x());
    const Matrix2d allowed = position * Matrix2d::Identity() + heading * across * across.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix2d> shares(d.covariances[i], allowed,
                                                                    Eigen::EigenvaluesOnly);
    least = std::min(least, std::sqrt(shares.eigenvalues()[0]));
  }
  return least;
}

Claim covariance_keeps_the_start(const Drive& ekf, const Drive& fej, const Data& data) {
  const double by_ekf = least_over_the_start(ekf, data.settings.start),
               by_fej = least_over_the_start(fej, data.settings.start);
  return assessed(
      "3.2-bound", "Section 3.1, third property",
      "No landmark becomes better known, in any direction, than the vehicle's covariance at the start "
      "(0.316 m, 15°) allows, to 5 %",
      {.rule = Rule::superiority,
       .measured = {"least sigma of a landmark over its bound: EKF {:.3f}, first-estimate Jacobians {:.3f}",
                    by_ekf, by_fej},
       .number = exactly("least sigma of a landmark over its bound, EKF", by_ekf),
       .why = "Jacobians are taken at the first estimates: the EKF gains information about its heading "
              "that no measurement has"},
      by_ekf > 0.95, on_condition(by_fej > 0.95));
}

Claim false_gain(const Drive& ekf, const Data& data) {
  const double heading = degrees(ekf.sigma_heading_rad.back()),
               start = degrees(data.settings.start.sigma_heading_rad);
  return assessed(
      "3.2-false-gain", "Sections 2.2.3 and 3.1, with [8] and [70]",
      "Linearization makes the EKF optimistic: without anchors the sigma of its heading falls below that "
      "of the start, although no measurement has information about it, and its error is above 2 sigma",
      {.rule = Rule::superiority,
       .measured = {"heading sigma {:.1f}° at the start, {:.2f}° at the end, its error {:.1f}°", start,
                    heading, degrees(std::abs(ekf.fitted.fit.turn_rad))},
       .number = exactly("heading sigma after 112 s, from 15°", heading, "°")},
      heading < start && degrees(std::abs(ekf.fitted.fit.turn_rad)) > 2 * heading);
}

/// The plain EKF and one with an unscented vehicle, from headings known to 5, 15 and 30 degrees.
Claim unscented_vehicle_errs_less(const Data& data) {
  std::vector<double> less_of_path, less_of_map;  // share of the EKF's
  std::vector<std::string> errors;
  for (const double times : {1.0 / 3, 1.0, 2.0}) {
    Variant variant{.start = {.heading_times = times}};
    const Drive ekf = drive(data, variant);
    variant.linearization = Linearization::unscented_vehicle;
    const Drive unscented = drive(data, variant);
    less_of_path.push_back(1 - unscented.fitted_path_rms_m / ekf.fitted_path_rms_m);
    less_of_map.push_back(1 - unscented.fitted.error.rms_m / ekf.fitted.error.rms_m);
    errors.push_back(fmt::format(
        "{:.0f}°: path {:.3f} against {:.3f} m, map {:.3f} against {:.3f} m, before the fit "
        "{:.2f} against {:.2f} m",
        15 * times, unscented.fitted_path_rms_m, ekf.fitted_path_rms_m, unscented.fitted.error.rms_m,
        ekf.fitted.error.rms_m, unscented.map_rms_m, ekf.map_rms_m));
  }
  const double least_path = std::ranges::min(less_of_path), least_map = std::ranges::min(less_of_map);
  return assessed(
      "3.2-unscented", "Section 1.3, third contribution, with [6]",
      "The unscented transformation of the vehicle states reduces what linearization does to EKF SLAM: at "
      "least 1 % less error of path and map than the EKF's, after a rigid fit, from start headings known "
      "to 5, 15 and 30°",
      {.rule = Rule::superiority,
       .measured = {"unscented against EKF, {}", fmt::join(errors, "; ")},
       .number = exactly("least share by which the path's error falls", 100 * least_path, "%"),
       .runs = less_of_path.size()},
      std::min(least_path, least_map) > 0.01);
}

// With two anchors -----------------------------------------------------------------------------------

std::string errors(const char* filter, const Drive& d) {
  return fmt::format("{}: landmarks {:.3f} m, vehicle {:.3f} m", filter, d.map_rms_m, d.path_rms_m);
}

Claim absolute_error(const Drive& ekf, const Drive& alone) {
  const double share = ekf.map_rms_m / alone.map_rms_m;
  return assessed(
      "3.5-absolute", "Example 3.5, Figure 3.10 (c)",
      "With two anchors the absolute landmark error is significantly reduced: less than half of that "
      "without, nothing fitted",
      {.rule = Rule::superiority,
       .measured = {"EKF: {}, without anchors {:.3f} m", errors("with anchors", ekf), alone.map_rms_m},
       .number = exactly("landmarks' rms error over that without anchors", share)},
      share < 0.5);
}

/// Of three filters from the recording's heading, which is 15 degrees off.
Claim recovers_from_the_start(const Data& data, const Drive& ekf, const Drive& fej) {
  const Drive relative = drive(data, {.anchored = true, .map_frame = MapFrame::vehicle});
  return assessed(
      "3.5-first-estimate", "Example 3.5, Figure 3.11",
      "From a heading that is 15° off, first-estimate Jacobians and a map in the vehicle's frame find the "
      "absolute map with two anchors (landmarks within 0.25 m rms of the survey, the vehicle within 0.20 "
      "m rms of GPS), and the EKF does not",
      {.rule = Rule::superiority,
       .measured = {"{}; {}; {}", errors("first-estimate Jacobians", fej),
                    errors("map in the vehicle's frame", relative), errors("EKF", ekf)},
       .number = exactly("landmarks' rms error, first-estimate Jacobians", fej.map_rms_m, "m")},
      is_accurate(fej) && is_accurate(relative) && !is_accurate(ekf));
}

Claim independent_of_the_start(const Data& data, const Drive& ekf, const Drive& fej) {
  const double by_ekf = from_other_starts(data, anchored_ekf).apart_from(ekf),
               by_fej = from_other_starts(data, anchored_first_estimate).apart_from(fej);
  return assessed(
      "3.5-independent", "Example 3.5, Figure 3.10 (b), (d)",
      "With anchors the covariances do not depend on the initial conditions: mean landmark sigma and "
      "vehicle's after 112 s, from four other starts, within 10 % of those from the recording's own",
      {.rule = Rule::equality,
       .measured =
           {"from the recording's start EKF {}, first-estimate Jacobians {} m; largest relative difference "
            "from other starts {:.0f} % and {:.0f} %",
            last_sigmas(ekf), last_sigmas(fej), 100 * by_ekf, 100 * by_fej},
       .number = exactly("largest relative difference of a sigma from another start, EKF", 100 * by_ekf, "%"),
       .why =
           "Jacobians are taken at the first estimates. The EKF takes them at estimates that depend on the start"},
      by_ekf < same_sigmas, on_condition(by_fej < same_sigmas));
}

Claim reduced_covariance(const Drive& ekf, const Drive& ekf_alone, const Drive& fej, const Drive& alone) {
  const auto share = [](double one, double other) { return std::pow(one / other, 2); };
  return assessed(
      "3.5-covariance", "Example 3.5, Figure 3.10 (b), (d)",
      "Vehicle and landmark covariances are significantly reduced: variances at the end less than half of "
      "those without anchors",
      {.rule = Rule::superiority,
       .measured = {"sigmas, EKF: {}; first-estimate Jacobians: {}", sigmas_against(ekf, ekf_alone),
                    sigmas_against(fej, alone)},
       .number = exactly("landmarks' variance over that without anchors, EKF",
                         share(ekf.mean_landmark_sigma_m(), ekf_alone.mean_landmark_sigma_m()))},
      has_smaller_sigmas(ekf, ekf_alone, std::sqrt(0.5)));
}

Claim external_sensor(const Data& data) {
  const Drive d = drive(data, {.linearization = Linearization::first_estimate, .gps_all_along = true});
  return assessed("3.5-external", "Section 3.2, second way; Section 3.5",
                  "An external sensor that measures the vehicle at all times makes the system observable as "
                  "well: with GPS all along and no anchor, landmarks within 0.25 m rms of the survey",
                  {.rule = Rule::superiority,
                   .measured = {"landmarks {:.3f} m rms", d.map_rms_m},
                   .number = exactly("landmarks' rms error", d.map_rms_m, "m")},
                  d.map_rms_m < good_map_m);
}

LedgerEntry run_3_2(const ExperimentSettings& settings) {
  return unless_missing(example_3_2, load, [&](const Data& data) {
    const Drive ekf = drive(data, plain_ekf), fej = drive(data, first_estimate);
    return entry_of(example_3_2, settings,
                    {relative_map(ekf, fej), trunks(data), mapped_once(ekf, fej), depends_on_the_start(data),
                     false_gain(ekf, data), covariance_keeps_the_start(ekf, fej, data),
                     unscented_vehicle_errs_less(data)},
                    frames_and_map("fig-3.5", "fig-3.6", "Car park, no anchors, EKF", data, ekf));
  });
}

LedgerEntry run_3_5(const ExperimentSettings& settings) {
  return unless_missing(example_3_5, load, [&](const Data& data) {
    const Drive ekf = drive(data, anchored_ekf), fej = drive(data, anchored_first_estimate),
                alone = drive(data, first_estimate), ekf_alone = drive(data, plain_ekf);
    std::vector<Plot> plots =
        frames_and_map("fig-3.10", "fig-3.11", "Car park, two anchors, first-estimate Jacobians", data, fej);
    plots.push_back(map("fig-3.11-ekf", "Car park, two anchors, EKF", data, ekf));
    return entry_of(example_3_5, settings,
                    {absolute_error(ekf, ekf_alone), reduced_covariance(ekf, ekf_alone, fej, alone),
                     independent_of_the_start(data, ekf, fej), recovers_from_the_start(data, ekf, fej),
                     external_sensor(data)},
                    plots);
  });
}

}  // namespace

const Experiment example_3_2{"3.2", "The car park without anchors", {"fig-3.5", "fig-3.6"}, run_3_2};
const Experiment example_3_5{
    "3.5", "The car park with two anchors", {"fig-3.10", "fig-3.11", "fig-3.11-ekf"}, run_3_5};

}  // namespace incognita
