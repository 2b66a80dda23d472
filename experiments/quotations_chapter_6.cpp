// What Chapters 6, 7 and the appendices of the thesis says, by claim.
#include "experiments/quotations.hpp"

namespace incognita {

std::span<const Quotation> quotations_of_chapter_6() {
  static constexpr Quotation all[] = {
      {"6.2-between", "6.1.1",
       "Moving to the location in between landmarks 2 and 3 maximises the mutual information between the SLAM prior and the measurements for this particular example."},
  };
  return all;
}

}  // namespace incognita
