// Outlier rejection by the share of outliers, on simulated frames: what the gate of each search leaves, one-point RANSAC as
// published (Civera, Grasa, Davison, Montiel 2010: random hypotheses, inliers within two sigmas of the pixel noise, then
// rescue of high-innovation inliers after an update with them), and consistent_matches().
//
//   outlier_trials [--frames N] [--matches N]
//
// A camera whose pose is uncertain by 3 cm and 0.03 rad sees points at 1 to 6 m, known to 1 cm, with noise of 0.5 px. An inlier
// has the residual of a true pose drawn from that belief; an outlier is anywhere in its own search ellipse of three sigmas.
// Printed per share of outliers: inliers and outliers that are accepted, the rms error of the pose after the update in
// sigmas of that update (1 is consistent), and time.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/slam/features/consensus.hpp"

namespace incognita {
namespace {

using Pose = Eigen::Matrix<double, 6, 1>;
using Mask = std::vector<bool>;

constexpr double sigma_px = 0.5, gate_probability = 0.99;
const double gate = chi_square_quantile(gate_probability, 2);

struct Frame {
  Eigen::MatrixXd H, S;
  Eigen::VectorXd residuals;
  Mask is_inlier;
  Pose error;  ///< true minus predicted
};

Pose prior_sigmas() {
  Pose sigmas;
  sigmas << 0.03, 0.03, 0.03, 0.03, 0.03, 0.03;
  return sigmas;
}

Eigen::VectorXd normal_vector(Eigen::Index size, RandomStream& random) {
  Eigen::VectorXd out(size);
  for (double& x : out) x = random.normal();
  return out;
}

/// Uniform in the ellipse of three sigmas.
Eigen::Vector2d anywhere(const Eigen::Matrix2d& S, RandomStream& random) {
  const double angle = random.uniform(0, 2 * std::acos(-1.0)), radius = 3 * std::sqrt(random.uniform());
  return S.llt().matrixL() * Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
}

Frame draw(int matches, double outlier_share, RandomStream& random) {
  const Camera camera = PinholeCamera{640, 480, 390, 390, 319.5, 239.5};
  CameraState x = CameraState::Zero();
  x[3] = 1;
  Frame frame;
  const Eigen::Index rows = 2 * matches;
  frame.H.resize(rows, 6);
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(rows, rows);
  for (int i = 0; i < matches; ++i) {
    const double depth = random.uniform(1, 6);
    const Eigen::Vector3d point(depth * random.uniform(-0.75, 0.75), depth * random.uniform(-0.55, 0.55),
                                depth);
    const auto seen = PointLandmark::predict_measurement(camera, x, point);
    frame.H.middleRows<2>(2 * i) = seen->Hv.leftCols<6>();
    map.block<2, 2>(2 * i, 2 * i) = 1e-4 * seen->Hl * seen->Hl.transpose();
    map.block<2, 2>(2 * i, 2 * i).diagonal().array() += sigma_px * sigma_px;
  }
  frame.S = frame.H * prior_sigmas().cwiseAbs2().asDiagonal() * frame.H.transpose() + map;
  frame.error = prior_sigmas().cwiseProduct(normal_vector(6, random));
  frame.residuals = frame.H * frame.error + map.llt().matrixL() * normal_vector(rows, random);
  for (int i = 0; i < matches; ++i) {
    frame.is_inlier.push_back(i >= std::lround(outlier_share * matches));
    if (!frame.is_inlier.back())
      frame.residuals.segment<2>(2 * i) = anywhere(frame.S.block<2, 2>(2 * i, 2 * i), random);
  }
  return frame;
}

std::vector<int> members(const Mask& mask) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(mask.size()); ++i)
    if (mask[static_cast<std::size_t>(i)]) rows.insert(rows.end(), {2 * i, 2 * i + 1});
  return rows;
}

/// Residuals and their covariance after an update with these matches. The rows of the matches themselves mean nothing.
std::pair<Eigen::VectorXd, Eigen::MatrixXd> after_update(const Frame& f, const Mask& with) {
  const std::vector<int> used = members(with);
  const Eigen::MatrixXd gain = f.S(used, used).llt().solve(f.S(used, Eigen::all)).transpose();
  return {f.residuals - gain * f.residuals(used), f.S - gain * f.S(used, Eigen::all)};
}

bool passes(const Eigen::VectorXd& r, const Eigen::MatrixXd& S, int i) {
  const Eigen::Vector2d own = r.segment<2>(2 * i);
  return own.dot(Eigen::Matrix2d(S.block<2, 2>(2 * i, 2 * i)).inverse() * own) <= gate;
}

Mask own_gates(const Frame& f, RandomStream&) {
  Mask mask;
  for (int i = 0; i < f.residuals.size() / 2; ++i) mask.push_back(passes(f.residuals, f.S, i));
  return mask;
}

Mask one_point_ransac(const Frame& f, RandomStream& random) {
  const int n = static_cast<int>(f.residuals.size() / 2);
  Mask best(static_cast<std::size_t>(n), false);
  int most = 0;
  double needed = 1000;
  for (int k = 0; k < needed && k < 1000; ++k) {
    Mask one(static_cast<std::size_t>(n), false);
    const int hypothesis = random.below(n);
    one[static_cast<std::size_t>(hypothesis)] = true;
    const Eigen::VectorXd r = after_update(f, one).first;
    Mask votes = one;
    int count = 1;
    for (int i = 0; i < n; ++i)
      if (i != hypothesis && r.segment<2>(2 * i).norm() < 2 * sigma_px)
        votes[static_cast<std::size_t>(i)] = true, ++count;
    if (count <= most) continue;
    most = count;
    best = votes;
    needed = std::log(0.01) / std::log(std::max(1e-9, 1 - static_cast<double>(count) / n));
  }
  const auto [r, S] = after_update(f, best);
  Mask out = best;
  for (int i = 0; i < n; ++i)
    if (!best[static_cast<std::size_t>(i)]) out[static_cast<std::size_t>(i)] = passes(r, S, i);
  return out;
}

Mask ours(const Frame& f, RandomStream&) { return consistent_matches(f.residuals, f.S, gate); }

struct Score {
  double inliers = 0, accepted_inliers = 0, outliers = 0, accepted_outliers = 0, nees = 0, us = 0;
};

void add(Score& score, const Frame& f, const Mask& mask) {
  for (std::size_t i = 0; i < mask.size(); ++i) {
    (f.is_inlier[i] ? score.inliers : score.outliers) += 1;
    (f.is_inlier[i] ? score.accepted_inliers : score.accepted_outliers) += mask[i];
  }
  const std::vector<int> used = members(mask);
  const Eigen::MatrixXd PHt = prior_sigmas().cwiseAbs2().asDiagonal() * f.H.transpose();
  const Eigen::MatrixXd gain = f.S(used, used).llt().solve(PHt(Eigen::all, used).transpose()).transpose();
  const Pose off = f.error - gain * f.residuals(used);
  const Eigen::Matrix<double, 6, 6> P =
      Eigen::MatrixXd(prior_sigmas().cwiseAbs2().asDiagonal()) - gain * PHt(Eigen::all, used).transpose();
  score.nees += off.dot(P.llt().solve(off)) / 6;
}

void print_trials(int frames, int matches) {
  const std::vector<std::pair<const char*, std::function<Mask(const Frame&, RandomStream&)>>> methods{
      {"own gates", own_gates}, {"1-point RANSAC", one_point_ransac}, {"consistent_matches", ours}};
  std::printf(
      "| outliers | method | inliers accepted | outliers accepted | rms error of the pose, sigmas | time, us |\n");
  std::printf("|---:|---|---:|---:|---:|---:|\n");
  for (const double share : {0.0, 0.2, 0.4, 0.6, 0.8})
    for (const auto& [name, method] : methods) {
      RandomStream random(1, "bench.outliers"), choices(1, "bench.hypotheses");
      Score score;
      for (int k = 0; k < frames; ++k) {
        const Frame frame = draw(matches, share, random);
        const auto before = std::chrono::steady_clock::now();
        const Mask mask = method(frame, choices);
        score.us +=
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count();
        add(score, frame, mask);
      }
      std::printf("| %.0f %% | %s | %.1f %% | %.1f %% | %.2f | %.0f |\n", 100 * share, name,
                  100 * score.accepted_inliers / score.inliers,
                  score.outliers > 0 ? 100 * score.accepted_outliers / score.outliers : 0,
                  std::sqrt(score.nees / frames), score.us / frames);
    }
}

}  // namespace
}  // namespace incognita

int main(int argc, char** argv) {
  int frames = 500, matches = 60;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word == "--frames")
      frames = std::stoi(argv[i + 1]);
    else if (word == "--matches")
      matches = std::stoi(argv[i + 1]);
    else {
      std::cerr << word << ": unknown option; see the head of bench/outlier_trials.cpp\n";
      return 2;
    }
  }
  incognita::print_trials(frames, matches);
}
