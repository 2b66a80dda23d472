// A recorded snapshot with what it shares with earlier ones.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace incognita {

struct RecordedFrameTexts {
  std::string snapshot;  ///< incognita.Snapshot
  std::optional<std::string>
      with_landmarks;  ///< the snapshot whose landmarks and exploration hold; none: this one
  std::optional<std::string> with_exploration;  ///< the snapshot whose exploration holds, if another one
  std::optional<std::filesystem::path>
      map_csv;  ///< of the last frame: its exact landmarks, if these are the same ones
};

/// {"snapshot": ...} with one list per particle. Throws InputError, beginning with `place`, if a text is damaged.
std::string complete_snapshot(const RecordedFrameTexts& texts, const std::string& place);

}  // namespace incognita
