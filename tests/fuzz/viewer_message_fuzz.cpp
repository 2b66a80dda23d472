// Fuzz target: messages of viewers, of the page and of Foxglove, and addresses of requests. Built with clang as
// system_fuzz.cpp is.
#include <cstdlib>
#include <string>

#include "incognita/live/foxglove_messages.hpp"
#include "incognita/live/url.hpp"
#include "incognita/live/viewer_commands.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/snapshot/interventions.hpp"
#include "tests/fuzz/fuzz_target.hpp"

using namespace incognita;

/// What was understood means the same after it is written and read again.
static void check(const ViewerCommand& command) {
  const auto* intervention = std::get_if<Intervention>(&command);
  if (!intervention) return;
  const std::string written = intervention_json(*intervention);
  if (intervention_json(intervention_from_json(written)) != written) std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    check(viewer_command(text));
  } catch (const InputError&) {
  }
  try {
    foxglove::request(text);
  } catch (const InputError&) {
  }
  try {
    from_log_row(text);
  } catch (const InputError&) {
  }
  type_of_message(text);
  parse_target(text);
  return 0;
}
