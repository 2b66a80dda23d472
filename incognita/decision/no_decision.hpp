// Where there is nothing to decide, as for a recorded drive.
#pragma once

#include <string>
#include <vector>

#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

class NoDecision {
 public:
  template <class Estimate>
  Goal choose(const Estimate&, const Tick&) const {
    return {};
  }
  const std::vector<std::string>& actions() const { return none_; }

 private:
  std::vector<std::string> none_;
};

}  // namespace incognita
