// What Chapter 5 of the thesis says, by claim.
#include "experiments/quotations.hpp"

namespace incognita {

std::span<const Quotation> quotations_of_chapter_5() {
  static constexpr Quotation all[] = {
      {"5.1-stable", "5.1",
       "LQG is stable for a controllable vehicle in SLAM. Moreover, having full observability, the filter in SLAM is also stable due to the separation principle."},
  };
  return all;
}

}  // namespace incognita
