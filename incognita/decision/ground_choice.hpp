// Choice of the translation of a vehicle on the ground or on a line: thesis 6.3.1, among those that it can execute.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incognita/decision/action_choice.hpp"
#include "incognita/decision/body_choice.hpp"
#include "incognita/decision/ground_actions.hpp"

namespace incognita {

class GroundChoice final : public BodyChoice {
 public:
  /// `tick_s`: duration of one input. `who`: index of the body. Throws std::invalid_argument as ActionChoice and
  /// GroundActions do.
  GroundChoice(const DecisionSettings& settings, const BodyModel& body, double tick_s, std::uint64_t seed,
               std::size_t who = 0);

  void choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
              const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) override;
  void forget() override { choice_.forget(); }
  void state(StateArchive& archive) override;
  const std::vector<std::string>& names() const override { return choice_.names(); }

 private:
  AnyMotion motion_;
  GroundActions actions_;
  ActionChoice choice_;
};

}  // namespace incognita
