// What Chapters 1 to 3 of the thesis says, by claim.
#include "experiments/quotations.hpp"

namespace incognita {

std::span<const Quotation> quotations_of_chapters_1_to_3() {
  static constexpr Quotation all[] = {
      {"3.1-eigenvalue-one", "3.1",
       "We are able to see in the end, that the estimated system has a pole on the unit circle of the z -plane, making the filter marginally stable."},
  };
  return all;
}

}  // namespace incognita
