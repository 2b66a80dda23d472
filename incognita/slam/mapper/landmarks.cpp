#include "incognita/slam/mapper/landmarks.hpp"

#include <algorithm>
#include <utility>

#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {

void add_landmark(Estimate& e, Landmark landmark, const NewLandmark& initialized) {
  const BlockParent parent{initialized.body, initialized.by_body};
  landmark.block = e.belief.augment(initialized.chart, initialized.mean, {&parent, 1}, initialized.noise);
  const std::int64_t id = landmark.id;
  e.landmarks.emplace(id, std::move(landmark));
}

void convert_to_point(AnyBelief& belief, Landmark& landmark, const SmallVector& position,
                      const SmallMatrix& J, const SmallMatrix& noise) {
  belief.replace(landmark.block, Chart::line(static_cast<int>(position.size())), position, J, noise);
  landmark.form.kind = LandmarkParametrization::Kind::point;
  if (landmark.by_turn.rows() > 0) landmark.by_turn = (J * landmark.by_turn).eval();
}

void remove_landmark(Estimate& e, std::int64_t id) {
  const Landmark& landmark = e.landmarks.at(id);
  if (!landmark.fixed) e.belief.drop(landmark.block);
  e.landmarks.erase(id);
}

namespace {

/// The landmark of a detection without its depth, which depth lines find.
void leave_out_depth(AnyInitialization& initialized, SmallMatrix& noise) {
  constexpr int errors = 5;
  initialized.form.kind = LandmarkParametrization::Kind::ray;
  initialized.chart = Chart::line(errors);
  initialized.landmark.conservativeResize(errors);
  initialized.Jv.conservativeResize(errors, Eigen::NoChange);
  noise.conservativeResize(errors, errors);
}

}  // namespace

bool initialize_from_detection(Estimate& e, int body, const PointDetection& detection,
                               const EstimatorSettings& settings) {
  const Body& viewer = e.bodies[static_cast<std::size_t>(body)];
  const AnyMotion& motion = settings.bodies[static_cast<std::size_t>(body)].motion;
  const PointSensor& sensor = sensor_of(settings, body, detection.sensor);
  if (!is_usable(sensor.sensor, detection.z)) return false;
  auto initialization = initialize_landmark(sensor.sensor, motion, e.belief.mean(viewer.block), detection.z,
                                            settings.filter.inverse_depth_per_m);
  if (!initialization) return false;
  if (settings.filter.linearization ==
      Linearization::first_estimate) {  // Jacobians consistent with those of later measurements
    const auto prediction = predict_measurement(sensor.sensor, motion, viewer.prediction,
                                                initialization->form, initialization->landmark);
    if (!prediction) return false;
    initialization->Jz = Eigen::Matrix2d(prediction->Hl).inverse();
    initialization->Jv = -initialization->Jz * prediction->Hv;
  }
  SmallMatrix noise =
      initialization->Jz * detection_noise(sensor, detection.z) * initialization->Jz.transpose();
  if (initialization->Jd.size() > 0) {
    const double sigma = settings.filter.sigma_inverse_depth_per_m;
    noise += sigma * sigma * initialization->Jd * initialization->Jd.transpose();
  }
  // The initial position duplicates that of the body: regularization keeps the covariance positive definite
  if (initialization->form.kind == LandmarkParametrization::Kind::inverse_depth)
    noise.diagonal().head(initialization->landmark.size() == 4 ? 2 : 3).array() += 1e-8;
  if (settings.depth_lines) leave_out_depth(*initialization, noise);
  Landmark landmark;
  landmark.id = detection.identity;
  landmark.form = initialization->form;
  landmark.first = initialization->landmark;
  landmark.detection_count = 1;
  add_landmark(e, std::move(landmark),
               {initialization->chart, initialization->landmark, viewer.block, initialization->Jv, noise});
  return true;
}

namespace {

bool measures(const BodyModel& body, const Landmark& landmark) {
  return std::any_of(body.sensors.begin(), body.sensors.end(),
                     [&](const PointSensor& sensor) { return is_measurable(landmark, sensor.sensor); });
}

}  // namespace

void convert_converged_inverse_depths(Estimate& e, const EstimatorSettings& settings) {
  for (auto next = e.landmarks.begin(); next != e.landmarks.end();) {
    const auto at = next++;
    Landmark& landmark = at->second;
    if (landmark.fixed || landmark.camera >= 0) continue;
    if (landmark.form.kind != LandmarkParametrization::Kind::inverse_depth) continue;
    const SmallVector mean = e.belief.mean(landmark.block);
    const Eigen::Index last = mean.size() - 1;
    if (mean[last] < 0) {
      remove_landmark(e, landmark.id);
      continue;
    }
    const double var = e.belief.covariance(landmark.block)(last, last);
    const int dimensions = static_cast<int>(mean.size()) / 2;
    // The largest of all bodies that may measure it: for each of them the measurement must be linear enough
    double index = 0;
    for (std::size_t i = 0; i < e.bodies.size(); ++i) {
      if (!measures(settings.bodies[i], landmark)) continue;
      index = std::max(
          index,
          linearity_index(
              landmark.form, mean, var,
              position_of(settings.bodies[i].motion, e.belief.mean(e.bodies[i].block), dimensions).position));
    }
    if (!(index < settings.filter.max_linearity_index)) continue;
    const auto point = position_of(landmark.form, mean);
    if (!point) continue;
    const auto size = point->position.size();
    convert_to_point(e.belief, landmark, point->position, point->J, SmallMatrix::Zero(size, size));
    landmark.first = point->position;
  }
}

}  // namespace incognita
