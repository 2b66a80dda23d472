// The files of scenarios/ and systems/ that are built into the program, so that it runs from any folder.
#pragma once

#include <span>
#include <string_view>

namespace incognita {

struct EmbeddedFile {
  std::string_view name;  ///< relative to its folder, e.g. "targets/sheet.toml"
  std::string_view bytes;
};

std::span<const EmbeddedFile> embedded_files();    ///< files of scenarios/
std::span<const EmbeddedFile> embedded_systems();  ///< files of systems/

}  // namespace incognita
