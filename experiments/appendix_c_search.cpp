// What a search promises by its S: Appendix C.2.
//
// Experiment: the camera of section_6_1.hpp in random layouts, after 0, 3 and 10 measurements of all landmarks from
// around. One landmark is measured at a time. The plan, written before the runs: of any two landmarks the one with the
// larger S reduces the entropy of camera and features by more, computed from covariances before and after; beside it,
// how often that is so of the camera's entropy alone.
#include "experiments/appendix_c.hpp"
#include "experiments/common.hpp"
#include "experiments/section_6_1.hpp"

namespace incognita::appendix_c {
namespace {

using namespace section_6_1_plane;

struct Search {
  double S = 0, of_all = 0, of_camera = 0;  ///< rad^2, nats
};

double half_log_det(const MatrixXd& P) { return P.llt().matrixLLT().diagonal().array().log().sum(); }

std::vector<Search> searches(const Plane& plane) {
  const MatrixXd P = plane.belief.dense_covariance();
  std::vector<Search> all;
  for (const PredictedMeasurement& one : plane.step_to({0, 0}).measurements) {
    Eigen::RowVectorXd H = Eigen::RowVectorXd::Zero(P.cols());
    H.segment(0, 3) = one.Hv;
    H.segment(plane.belief.offset(one.block), 2) = one.Hl;
    const double S = H * P * H.transpose() + one.R(0, 0);
    const MatrixXd after = P - P * H.transpose() * H * P / S;
    all.push_back({S, half_log_det(P) - half_log_det(after),
                   half_log_det(P.topLeftCorner(3, 3)) - half_log_det(after.topLeftCorner(3, 3))});
  }
  return all;
}

}  // namespace

std::vector<Claim> search_claims() {
  int pairs = 0, of_all = 0, of_camera = 0;
  RandomStream random(5, "appendix-c");
  for (int i = 0; i < 300; ++i) {
    Plane plane = drawn_landmarks(random);
    measure_often(plane, std::vector{0, 3, 10}[static_cast<std::size_t>(i % 3)], random);
    const std::vector<Search> all = searches(plane);
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const Search &more = all[all[a].S > all[b].S ? a : b], &less = all[all[a].S > all[b].S ? b : a];
        ++pairs, of_all += more.of_all > less.of_all, of_camera += more.of_camera > less.of_camera;
      }
  }
  return {assessed(
      "C.2-high-S", "Appendix C.2",
      "Of two searches the one with the larger S, whose result is more difficult to predict, provides more information "
      "about camera and features",
      {.rule = Rule::example,
       .measured = {"in {} of {} pairs; about the camera in {}", of_all, pairs, of_camera},
       .number = exactly("percent of pairs in which the larger S gives more information about the camera",
                         std::round(1000.0 * of_camera / pairs) / 10, "%"),
       .runs = pairs},
      of_all == pairs)};
}

}  // namespace incognita::appendix_c
