#include "experiments/headlines.hpp"

#include <algorithm>
#include <iterator>

namespace incognita {
namespace {

struct Headline {
  std::string_view claim;
  std::string_view sentence;
};

// Each says what the claim finds, whose test keeps it so: a finding that changes changes its sentence here.
constexpr Headline all_headlines[] = {
    {"abstract-inconsistency",
     "Partial observability alone does not make a filter inconsistent: the linear filter without an anchor is consistent. "
     "Linearization makes it so."},
    {"abstract-diagonalisation",
     "Decorrelating the map alone needs no anchor; decorrelating the vehicle from the map does."},
    {"text-2.2.3-stationary",
     "An EKF that stands still becomes overconfident in its heading, which no measurement observes; with Jacobians at the first "
     "estimates it does not."},
    {"3.4-one-anchor",
     "One anchor does not make a planar vehicle observable, although the method of the thesis says so: vehicle and map "
     "can rotate about it."},
    {"4.6-rank",
     "In Example 4.6, bearings to two landmarks, the information matrix has rank 2, 3 and 4 of 7 along the motion; freezing "
     "the measurement within a segment counts one too many (2, 4, 5)."},
    {"5.2-law",
     "In Example 5.2 the printed feedback law (5.12) drives a vehicle whose state is known off its circle; with the signs of "
     "(5.9) and the velocity of the path, whose factor w (5.15) lacks, it follows."},
    {"5.1-control",
     "Control is affected by the estimation: steered by its estimate the vehicle ends farther from its goal than steered by "
     "the truth."},
    {"3.2-unscented",
     "The unscented transformation of the vehicle states reduces the errors of path and map of EKF SLAM after a rigid "
     "fit, as the thesis says."},
    {"6.3-images-i-entropy",
     "On images a free camera that moves by information gain, as printed, gaze at a constant rate, ends with more entropy than "
     "one on a fixed path, and with less than one that stands."},
    {"6.4.3-backwards",
     "A vehicle that drives by information gain explores backward, as the thesis observed."}};

}  // namespace

std::string headline_of(std::string_view claim) {
  const auto found = std::ranges::find(all_headlines, claim, &Headline::claim);
  return found == std::end(all_headlines) ? "" : std::string(found->sentence);
}

}  // namespace incognita
