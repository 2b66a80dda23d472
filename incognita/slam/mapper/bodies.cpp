#include "incognita/slam/mapper/bodies.hpp"

#include <cmath>

#include "incognita/models/any_motion.hpp"
#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {

AnyBelief empty_belief(const MapperSettings& filter) {
  if (filter.form == BeliefForm::information) return AnyBelief(InformationBelief());
  return AnyBelief(Belief(64, filter.decorrelate == Decorrelation::map_linear
                                  ? MapCorrelations::block_diagonal
                                  : MapCorrelations::full));
}

void add_body(Estimate& e, const BodyModel& model, const SmallVector& start, const SmallMatrix& P, double t,
              bool in_vehicle_frame) {
  Body& body = e.bodies.emplace_back();
  body.t = t;
  if (in_vehicle_frame) {
    const planar::FramedPose world = planar::inverse(planar::Pose<double>(start));
    body.block = e.belief.add_vehicle(planar::pose_chart, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
    e.world =
        e.belief.add_vehicle(planar::pose_chart, world.pose, world.by_frame * P * world.by_frame.transpose());
  } else {
    body.block = e.belief.add_vehicle(chart_of(model.motion), start, P);
  }
  body.prediction = e.belief.mean(body.block);
  const int axes = traits_of(model.motion).position_size;
  body.start_sigma_m = std::sqrt(P.diagonal().head(axes).maxCoeff());
}

void stop_and_search(Estimate& e, std::size_t i, const EstimatorSettings& settings) {
  const HealthSettings& h = settings.health;
  const MotionTraits& traits = traits_of(settings.bodies[i].motion);
  SmallVector x = e.belief.mean(e.bodies[i].block);
  const int errors = e.belief.chart(e.bodies[i].block).tangent(), axes = traits.position_size;
  SmallVector sigmas = SmallVector::Constant(errors, h.sigma_search_rotation_rad);
  SmallMatrix A = SmallMatrix::Identity(errors, errors);
  sigmas.head(axes).setConstant(h.sigma_search_position_m);
  if (traits.in_space()) {
    x.tail<6>().setZero();
    A.bottomRightCorner<6, 6>().setZero();
    sigmas.segment<3>(6).setConstant(h.sigma_search_velocity_m_s);
    sigmas.tail<3>().setConstant(h.sigma_search_rate_rad_s);
  }
  e.belief.predict({e.bodies[i].block, x, A, sigmas.cwiseAbs2().asDiagonal()});
  e.bodies[i].input.reset();
  e.bodies[i].twist.reset();
  e.bodies[i].input_period = 0;
}

void put_body(Estimate& e, std::size_t i, const SmallVector& state, const SmallMatrix& P) {
  Body& body = e.bodies[i];
  const int errors = e.belief.chart(body.block).tangent();
  e.belief.predict({body.block, state, SmallMatrix::Zero(errors, errors), P});
  body.prediction = state;
  body.input.reset();
  body.twist.reset();
  body.input_period = 0;
}

namespace {

/// State and covariance of a body in the world.
void express_in_world(const Estimate& e, Body& body) {
  if (!e.world) {
    body.state = e.belief.mean(body.block);
    body.state_covariance = e.belief.covariance(body.block);
    return;
  }
  const planar::FramedPose at = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)),
                                                 planar::Pose<double>(e.belief.mean(body.block)));
  const SmallMatrix cross = at.by_pose * e.belief.covariance(body.block, *e.world) * at.by_frame.transpose();
  body.state = at.pose;
  body.state_covariance = at.by_frame * e.belief.covariance(*e.world) * at.by_frame.transpose() +
                          at.by_pose * e.belief.covariance(body.block) * at.by_pose.transpose() + cross +
                          cross.transpose();
}

}  // namespace

void express_in_world(Estimate& e, const EstimatorSettings& settings) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    Body& body = e.bodies[i];
    express_in_world(e, body);
    const SmallMatrix J = pose_jacobian(settings.bodies[i].motion, body.state);
    body.pose = pose_of(settings.bodies[i].motion, body.state);
    body.pose_covariance = J * body.state_covariance * J.transpose();
  }
}

void decorrelate(Estimate& e, Decorrelation which) {
  if (which == Decorrelation::everything) e.belief.decorrelate(Belief::Scope::everything);
  if (which == Decorrelation::map) e.belief.decorrelate(Belief::Scope::map);
}

}  // namespace incognita
