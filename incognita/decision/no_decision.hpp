// For bodies whose motion is prescribed: no action is chosen.
#pragma once

#include "incognita/decision/strategy.hpp"

namespace incognita {

class NoDecision final : public Strategy {
 public:
  Goal choose(const Estimate&, const Observation&, const Tick&) override { return {}; }
  void state(StateArchive&) override {}  // it has none
  const std::vector<std::string>& actions(std::size_t) const override { return none_; }

 private:
  std::vector<std::string> none_;
};

}  // namespace incognita
