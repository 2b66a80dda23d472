// What would be seen from where nobody is yet.
#pragma once

#include <vector>

#include "incognita/decision/expected_look.hpp"
#include "incognita/decision/exploration.hpp"

namespace incognita {

class Expectation {
 public:
  virtual ~Expectation() = default;
  /// Replaces `looks` by what would be seen with the vehicle in that state.
  virtual void expect(const BlockVector& state, std::vector<ExpectedLook>& looks) const = 0;
};

/// Leaves of the first `count` looks the `most` with the largest covariance of what is expected, as a search
/// for so many would choose them; the others, and what follows, stay in order. `traces`: of those
/// covariances, px^2 or so.
void keep_most_uncertain(std::vector<ExpectedLook>& looks, std::vector<double>& traces, std::size_t count,
                         int most);

}  // namespace incognita
