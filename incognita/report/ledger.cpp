#include "incognita/report/ledger.hpp"

namespace incognita {

const char* name(Finding finding) {
  switch (finding) {
    case Finding::holds:
      return "holds";
    case Finding::misprint:
      return "misprint";
    case Finding::holds_if:
      return "holds-if";
    case Finding::does_not_hold:
      return "does-not-hold";
    case Finding::undecided:
      return "undecided";
  }
  return "unknown";
}

const char* verdict(Finding finding) {
  return finding == Finding::misprint || finding == Finding::holds_if ? "holds-as-corrected" : name(finding);
}

const std::vector<Rule>& all_rules() {
  static const std::vector<Rule> all{Rule::identity, Rule::dimension, Rule::example,     Rule::superiority,
                                     Rule::equality, Rule::coverage,  Rule::boundedness, Rule::frequency};
  return all;
}

const char* name(Rule rule) {
  switch (rule) {
    case Rule::identity:
      return "identity";
    case Rule::dimension:
      return "dimension";
    case Rule::example:
      return "example";
    case Rule::superiority:
      return "superiority";
    case Rule::equality:
      return "equality";
    case Rule::coverage:
      return "coverage";
    case Rule::boundedness:
      return "boundedness";
    case Rule::frequency:
      return "frequency";
  }
  return "unknown";
}

const char* rule_text(Rule rule) {
  switch (rule) {
    case Rule::identity:
      return "Two expressions agree in all cases, up to rounding or to the tolerance that the claim names.";
    case Rule::dimension:
      return "A rank or a null space is the same in all cases; singular values that count as zero are a factor of "
             "1000 below the others.";
    case Rule::example:
      return "A claim that something can be is shown by one case, a claim that it always is is refuted by one.";
    case Rule::superiority:
      return "The interval of the mean difference, of runs paired by seed where there are pairs, lies on one side "
             "of zero or of the bound that the claim names.";
    case Rule::equality:
      return "The interval lies within the margin that the claim names; outside of it the claim is refuted.";
    case Rule::coverage:
      return "The interval of the share of errors inside their 2 sigma bounds lies above 90 %; a consistent Gaussian "
             "filter has 95.4 % per axis.";
    case Rule::boundedness:
      return "From half of the time to its end the quantity grows by less than 5 %.";
    case Rule::frequency:
      return "The interval (Wilson) of the share of cases lies above the share that the claim names.";
  }
  return "";
}

}  // namespace incognita
