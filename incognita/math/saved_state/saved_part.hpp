// A part of a run whose state can be saved and restored.
#pragma once

namespace incognita {

class StateArchive;

/// Base of the interfaces of the loop. What is configuration is not state: a part is built from the scenario first, and then
/// restored.
class SavedPart {
 public:
  virtual ~SavedPart() = default;
  /// Saves or restores what changes during a run: state_archive.hpp. Throws CannotBeSaved unless the class overrides it.
  virtual void state(StateArchive& archive);
};

}  // namespace incognita
