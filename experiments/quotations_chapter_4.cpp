// What Chapter 4 of the thesis says, by claim.
#include "experiments/quotations.hpp"

namespace incognita {

std::span<const Quotation> quotations_of_chapter_4() {
  static constexpr Quotation all[] = {
      {"4.1-more", "4.1.1",
       "Adding more features or time segments does not modify the observability conditions."},
  };
  return all;
}

}  // namespace incognita
