// What a viewer of the page asks for: control of the loop, another run, interventions.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "incognita/messages/intervention.hpp"

namespace incognita {

struct PauseRun {};
struct ResumeRun {};
/// One frame; the run stays paused.
struct StepRun {};
/// Run time per wall time; 0: as fast as possible.
struct SetSpeed {
  double factor = 1;
};
struct StopRun {};
/// Stops a robot at once, until it is released.
struct StopRobot {
  bool stopped = true;
};
/// Saves the whole state of the run.
struct SaveRun {};
/// Ends the current run and starts another.
struct StartRun {
  std::string scenario;
  std::vector<std::string> settings;  ///< "run.seed=7"
};

using ViewerCommand =
    std::variant<PauseRun, ResumeRun, StepRun, SetSpeed, StopRun, SaveRun, StartRun, StopRobot, Intervention>;

/// Reads a JSON message of a viewer: {"type":"speed","factor":2}. Throws InputError that names the field and what is
/// allowed.
ViewerCommand viewer_command(std::string_view json);

/// The type of a message, of an intervention its own, for an answer; empty if it has none.
std::string type_of_message(std::string_view json);

}  // namespace incognita
