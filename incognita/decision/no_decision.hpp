// Where there is nothing to decide, as for a recorded drive.
#pragma once

#include <vector>

#include "incognita/decision/actions.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

class NoDecision {
 public:
  template <class Estimate>
  Goal choose(const Estimate&, const Tick&) const {
    return {};
  }
  const std::vector<Translation>& actions() const { return none_; }

 private:
  std::vector<Translation> none_;
};

}  // namespace incognita
