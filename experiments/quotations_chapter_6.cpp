// What Chapters 6, 7 and the appendices of the thesis says, by claim.
#include "experiments/quotations.hpp"

namespace incognita {

std::span<const Quotation> quotations_of_chapter_6() {
  static constexpr Quotation all[] = {
      {"6.6-identity", "6.1.1", "which, for our Gaussian multivariate case, evaluates to"},
      {"6.6-positive", "6.1.1",
       "Mutual information is always positive; it is not possible to lose information through knowledge of the outcome of other experiments."},
      {"6.2-entropy", "6.1.1", "for our case where p(x) is a n-variable Gaussian distribution, reduces to"},
      {"6.1-conditional", "6.1.1",
       "and, their conditional entropy, the uncertainty about x, given the knowledge in [...], is"},
      {"6.2-between", "6.1.1",
       "Moving to the location in between landmarks 2 and 3 maximises the mutual information between the SLAM prior and the measurements for this particular example."},
      {"6.7-sign", "6.1.2", "The Fisher information is defined as"},
      {"6.8-limit", "6.1.2", "It should be noticed that, in the limit Fisher information is [...]"},
      {"6.8-uncertain", "6.3.1",
       "landmarks that have been observed for a small period of time still have large depth uncertainty, and the Fisher Information metric is maximised when observations are directed towards them."},
      {"6.8-close", "6.1.2",
       "Under a Fisher information motion strategy, maximally informative actions move the robot as close as possible to the landmarks under observation."},
      {"6.1-fully-correlated", "6.1.1",
       "From then on, entropy can still be used to decide what actions to take to reduce the camera’s own uncertainty, and this can be done just by replacing [...]"},
      {"6.1-mutual-or-entropy", "6.2",
       "it must be computed different priors for all actions. In such a case, computing the mutual information seems to be a better choice compared to the evaluation of entropy only."},
      {"6.10-lever", "6.4.1",
       "Robot motion taking into account surface contact at all times, we can substitute the previous motion prediction model with a constrained model for the continuous transition of the optic centre of the camera"},
      {"6.10-ground", "6.4",
       "this model not only considers the nonholonomic constraints of the vehicle, but the slope of the terrain as well."},
      {"6.4-table", "6.4.2",
       "At each time step we compute, in turn, the mutual information for one action in the set [...] That is, for every linear and angular instant acceleration combination."},
  };
  return all;
}

}  // namespace incognita
