#include "incognita/io/recordings/range_recording_builder.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "incognita/math/angles.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {
namespace {

template <class Row>
void in_order(const std::string& where, const std::vector<Row>& before, double t) {
  if (before.empty() || t >= before.back().t) return;
  throw InputError(
      fmt::format("{}: the times must not go backwards: {} comes after {}; sort the rows by time", where, t,
                  before.back().t));
}

/// A value out of range is more likely in degrees than wrong.
void in_radians(const std::string& where, const char* what, double angle, double limit) {
  if (std::abs(angle) < limit) return;
  throw InputError(fmt::format("{}: {} must be within +-{:.4g} rad, and is {}; is it in degrees?", where,
                               what, limit, angle));
}

/// A variance of 0 counts as 1, without correlation; one below 0 makes the result indefinite.
Eigen::Matrix3d correlations_of(const Eigen::Matrix3d& cov) {
  Eigen::Vector3d scale;
  for (int i = 0; i < 3; ++i) scale[i] = cov(i, i) != 0 ? std::sqrt(std::abs(cov(i, i))) : 1;
  return scale.cwiseInverse().asDiagonal() * cov * scale.cwiseInverse().asDiagonal();
}

Eigen::Vector3d eigenvalues_of(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

template <class First, class Second>
bool apart(const std::vector<First>& a, const std::vector<Second>& b) {
  return a.back().t < b.front().t || b.back().t < a.front().t;
}

template <class Row>
std::string span_of(const std::vector<Row>& rows) {
  return fmt::format("{} s to {} s", rows.front().t, rows.back().t);
}

}  // namespace

RangeRecordingBuilder::RangeRecordingBuilder(std::string format, std::string vehicle) {
  recording_.format = std::move(format);
  recording_.vehicle = std::move(vehicle);
}

void RangeRecordingBuilder::add_odometry(const std::string& where, const Odometry& odometry) {
  in_order(where, recording_.odometry, odometry.t);
  if (recording_.vehicle == "ackermann") {
    in_radians(where, "the steering angle", odometry.input[1], std::numbers::pi / 2);
  }
  recording_.odometry.push_back(odometry);
}

void RangeRecordingBuilder::add_increment(const std::string& where, double from, double to,
                                          const Eigen::Vector3d& increment, const Eigen::Matrix3d& cov) {
  if (const Eigen::Matrix3d relative = correlations_of(cov); !(eigenvalues_of(relative).minCoeff() > -1e-9))
    throw InputError(fmt::format(
        "{}: the covariance of the increment is none: its variances must be 0 or more, and no correlation beyond +-1",
        where));
  in_radians(where, "the turn since the row before", increment[2], std::numbers::pi);
  const double start = rounded_to_us(from), period = rounded_to_us(to) - start;
  const auto twist = twist_of_increment(increment, cov, period);
  if (!twist) throw InputError(fmt::format("{}: t_s must increase from row to row", where));
  add_odometry(where, {from, {twist->twist[0], twist->twist[2]}, twist});
}

void RangeRecordingBuilder::end_increments(const std::string& where, double t) {
  Odometry held = recording_.odometry.back();
  held.t = t;
  add_odometry(where, held);
}

void RangeRecordingBuilder::add_scan(const std::string& where, double t) {
  in_order(where, recording_.scans, t);
  if (recording_.scans.empty() || recording_.scans.back().t != t) recording_.scans.push_back({t, {}, {}});
}

void RangeRecordingBuilder::add_detection(const std::string& where, Detection detection) {
  add_detection(where, detection, &RangeRecording::Scan::detections);
}

void RangeRecordingBuilder::add_vehicle_detection(const std::string& where, Detection detection) {
  add_detection(where, detection, &RangeRecording::Scan::vehicles);
}

void RangeRecordingBuilder::add_detection(const std::string& where, Detection detection,
                                          std::vector<Detection> RangeRecording::Scan::*to) {
  if (!is_usable(detection)) {
    skip("detections without a positive range and a bearing are skipped", where);
    return;
  }
  in_radians(where, "the bearing", detection.bearing_rad, 2 * std::numbers::pi + 1e-6);
  detection.bearing_rad = wrap_angle(detection.bearing_rad);
  (recording_.scans.back().*to).push_back(detection);
}

void RangeRecordingBuilder::add_truth(const std::string& where,
                                      const RangeRecording::TimedPosition& reading) {
  in_order(where, recording_.truth, reading.t);
  recording_.truth.push_back(reading);
}

void RangeRecordingBuilder::add_fix(const std::string& where, const RangeRecording::TimedPosition& reading) {
  in_order(where, recording_.fixes, reading.t);
  recording_.fixes.push_back(reading);
}

void RangeRecordingBuilder::add_landmark(const std::string& where, const RangeRecording::Landmark& landmark) {
  const auto same = [&](const RangeRecording::Landmark& other) {
    return landmark.identity != Detection::unknown && other.identity == landmark.identity;
  };
  if (std::any_of(recording_.landmarks.begin(), recording_.landmarks.end(), same)) {
    throw InputError(fmt::format("{}: there is already a landmark {}; each identity names one landmark",
                                 where, landmark.identity));
  }
  recording_.landmarks.push_back(landmark);
}

void RangeRecordingBuilder::skip(const std::string& kind, const std::string& where) {
  const auto known = std::find_if(skipped_.begin(), skipped_.end(),
                                  [&](const Skipped& skipped) { return skipped.kind == kind; });
  if (known == skipped_.end()) {
    skipped_.push_back({kind, where, 1});
  } else {
    ++known->count;
  }
}

/// Fixes that all precede the odometry often give the start position and do not indicate another clock.
void RangeRecordingBuilder::note_clocks() {
  const auto &truth = recording_.truth, &fixes = recording_.fixes;
  const std::string odometry = span_of(recording_.odometry);
  if (!truth.empty() && apart(truth, recording_.odometry))
    note(
        fmt::format("the truth ({}) and the odometry ({}) do not overlap in time", span_of(truth), odometry));
  if (fixes.empty() || !apart(fixes, recording_.odometry)) return;
  const bool before = fixes.back().t < recording_.odometry.front().t;
  note(fmt::format("the fixes ({}) are all from {} the odometry ({}): {}", span_of(fixes),
                   before ? "before" : "after", odometry,
                   before ? "with start.at_first_fix the vehicle starts at the first fix"
                          : "check that both are on the same clock"));
}

RangeRecording RangeRecordingBuilder::finish(const std::string& where) {
  if (recording_.odometry.empty()) throw InputError(fmt::format("{}: there is no odometry", where));
  if (recording_.scans.empty()) throw InputError(fmt::format("{}: there are no scans", where));
  if (apart(recording_.odometry, recording_.scans)) {
    throw InputError(fmt::format(
        "{}: the odometry ({}) and the scans ({}) do not overlap in time; both must be in s and on the same clock",
        where, span_of(recording_.odometry), span_of(recording_.scans)));
  }
  note_clocks();
  for (const Skipped& skipped : skipped_) {
    note(fmt::format("{} {}, the first at {}", skipped.count, skipped.kind, skipped.first));
  }
  return std::move(recording_);
}

}  // namespace incognita
