// The section [camera] of a scenario file.
#include <fmt/format.h>

#include "incognita/io/calibrations/calibration_readers.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/io/scenario/scenario_tree.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

void refuse_unknown_keys(const SettingReader& reader, const TomlTable& table, const std::string& name) {
  std::vector<std::string> known;
  for (const SettingInForce& setting : reader.settings())
    known.push_back(setting.key.substr(std::string("camera.").size()));
  for (const TomlEntry& entry : table)
    if (!reader.has("camera." + entry.key))
      throw InputError(
          fmt::format("{}:{}: there is no setting `camera.{}` with this model; the nearest is `camera.{}`",
                      name, entry.line, entry.key, nearest_name(entry.key, known)));
}

}  // namespace

CalibrationFile read_camera_table(const std::string& text, const std::filesystem::path& file) {
  const std::string name = shown(file);
  const TomlTable table = parse_toml(text, name);
  const TomlTable* camera = nullptr;
  CalibrationFile found{CalibrationFormat::incognita, {file, {}, ""}, {}};
  for (const TomlEntry& entry : table) {
    if (entry.key == "camera") camera = std::get_if<TomlTable>(&entry.value.value);
  }
  if (!camera) throw InputError(name + ": has no section [camera]");
  GivenValues given;
  for (const TomlEntry& entry : *camera)
    given["camera." + entry.key].push_back({entry.value, fmt::format("{}:{}", name, entry.line)});
  SettingReader reader(given);
  read_camera(reader, found.calibrated.camera);
  if (!reader.problems().empty()) throw InputError(fmt::format("{}", fmt::join(reader.problems(), "\n")));
  refuse_unknown_keys(reader, *camera, name);
  for (const char* key : {"camera.model", "camera.width_px", "camera.height_px", "camera.fu_px",
                          "camera.fv_px", "camera.u0_px", "camera.v0_px"})
    if (!given.contains(key)) throw InputError(fmt::format("{}: {} is missing", name, key));
  if (table.size() > 1) found.notes.push_back("only its section [camera] is used");
  return found;
}

}  // namespace incognita
