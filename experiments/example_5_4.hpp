// Runs of Example 5.4 in figures, and its claims, file by file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiments/evidence.hpp"
#include "experiments/example_5_4_run.hpp"
#include "experiments/seeds.hpp"
#include "incognita/report/experiment.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::swinging_camera {

inline const BackAndForthPath circle;  ///< of (5.28)

struct Summary {
  bool lost = false;
  double rms_error_m = 0;  ///< of the estimated position
  double estimated_off_m = 0,
         estimated_off_95_m = 0;  ///< from the path: median of ticks and 95 %, once settled
  double truly_off_m = 0, truly_off_95_m = 0, most_off_m = 0;
  double estimated_off_rms_m = 0, truly_off_rms_m = 0;  ///< the same, root mean squares
  double gaze_off_95_rad = 0;
  std::array<double, 6> inside{};              ///< share of ticks within 2 sigma
  double pose_nees = 0, nis = 0;               ///< means
  double least_sigma_m = 0, most_sigma_m = 0;  ///< of the position, once settled
  double last_sigma_angle_rad = 0;
  double at_limit = 0, at_limit_at_first = 0;  ///< share of ticks, once settled and before
  double most_m_s2 = 0, most_rad_s2 = 0;       ///< commanded, once settled
  int mapped = 0;
  double scale_off = 0;                  ///< of the true path, by the estimated one's, less 1
  std::vector<double> error_m, sigma_m;  ///< of the position, each second
};

Summary summary(const Course& course);
std::vector<Summary> runs(const Setup& setup, int seeds);

// Over runs

double mean(const std::vector<Summary>& runs, double Summary::*what);
double quantile(std::vector<double> values, double share);
double median(const std::vector<Summary>& runs, double Summary::*what);
/// Never farther than that from the path once settled.
constexpr double near_path_m = 0.3;
double share_near_path(const std::vector<Summary>& runs);
Answer follows(const std::vector<Summary>& runs);
/// The same share as the number of a claim, in percent.
ClaimNumber followers(std::string what, const std::vector<Summary>& runs);

/// Fewer runs, of what is compared with the example as it stands.
int fewer(const ExperimentSettings& settings);

std::vector<Claim> model_claims();
std::vector<Claim> law_claims(const ExperimentSettings& settings);
std::vector<Claim> loop_claims(const ExperimentSettings& settings, const std::vector<Summary>& runs);
/// Other paths in the same rooms, as many of each.
struct Compared {
  std::vector<Summary> example, steady, surges, swings, outward;
};
Compared compare_paths(const ExperimentSettings& settings, const std::vector<Summary>& example);
std::vector<Claim> path_claims(const ExperimentSettings& settings, const Compared& compared);

/// A camera with known state, steered by the setup's law; the states at its ticks.
std::vector<FreeCameraMotion::State<double>> steered(const Setup& setup, double sigma_disturbance,
                                                     std::uint64_t seed);

/// Figures 5.12 to 5.14, and what is compared with them.
std::vector<Plot> figures(const Compared& compared);

}  // namespace incognita::swinging_camera
