#include "incognita/record/files/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "incognita/io/bags/input_file.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::string_view state_mark = "incognita state\n";
constexpr std::size_t version_size = 32, name_size = 16, head_size = 60, entry_size = 32, most_sections = 64;
constexpr const char* another_file =
    "resume from another file: the one of an earlier save, or run the scenario again";

std::uint32_t crc32_of(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return static_cast<std::uint32_t>(crc.checksum());
}

template <class Number>
void append_bytes_of(std::string& to, Number number) {
  to.append(reinterpret_cast<const char*>(&number), sizeof number);
}
template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

void append_padded(std::string& to, std::string_view text, std::size_t size) {
  if (text.size() > size) throw std::length_error(fmt::format("`{}` is longer than {} bytes", text, size));
  to.append(text).append(size - text.size(), '\0');
}
/// Without its padding; other bytes than printable ones are shown as `?`.
std::string padded_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::string text(bytes.substr(at, size));
  text.resize(std::min(text.find('\0'), text.size()));
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  return text;
}

std::string head_of(std::string_view program_version, std::size_t sections) {
  std::string head(state_mark);
  append_bytes_of(head, state_format);
  append_padded(head, program_version, version_size);
  append_bytes_of(head, static_cast<std::uint32_t>(sections));
  append_bytes_of(head, crc32_of(head));
  return head;
}

std::string entry_of(const StateSection& section) {
  std::string entry;
  append_padded(entry, section.name, name_size);
  append_bytes_of(entry, static_cast<std::uint64_t>(section.bytes.size()));
  append_bytes_of(entry, crc32_of(section.bytes));
  append_bytes_of(entry, crc32_of(entry));
  return entry;
}

InputError damaged_state(const InputFile& file, const std::string& what) {
  return InputError(fmt::format("{}: {}: the file is damaged; {}", file.path().string(), what, another_file));
}

/// The number of sections; fills the version.
std::size_t read_head(const InputFile& file, std::string& program_version) {
  const std::string path = file.path().string();
  const std::string head = file.read(0, std::min<std::uint64_t>(file.size(), head_size));
  if (!state_mark.starts_with(head.substr(0, state_mark.size())))
    throw InputError(
        fmt::format("{}: is not a saved run; name a {} that `incognita run` wrote", path, state_file_name));
  if (head.size() < head_size) throw damaged_state(file, fmt::format("it ends at byte {}", head.size()));
  const std::string_view checked = std::string_view(head).substr(0, head_size - 4);
  if (crc32_of(checked) != number_at<std::uint32_t>(head, head_size - 4))
    throw damaged_state(file, fmt::format("the checksum of bytes 0 to {} does not fit", head_size - 5));
  program_version = padded_at(head, state_mark.size() + 4, version_size);
  const auto format = number_at<std::uint32_t>(head, state_mark.size());
  if (format != state_format)
    throw InputError(fmt::format(
        "{}: byte {}: has format {}, written by incognita {}; this program reads format {}: resume it with "
        "that version, or run the scenario again",
        path, state_mark.size(), format, program_version, state_format));
  const auto sections = number_at<std::uint32_t>(head, head_size - 8);
  if (sections > most_sections) throw damaged_state(file, fmt::format("it has {} sections", sections));
  return sections;
}

struct SectionEntry {
  std::string name;
  std::uint64_t offset = 0, length = 0;
  std::uint32_t crc = 0;
};

std::vector<SectionEntry> read_entries(const InputFile& file, std::size_t count) {
  std::vector<SectionEntry> entries;
  std::uint64_t offset = head_size + count * entry_size;
  if (offset > file.size()) throw damaged_state(file, fmt::format("it ends at byte {}", file.size()));
  const std::string table = file.read(head_size, count * entry_size);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view entry = std::string_view(table).substr(i * entry_size, entry_size);
    const std::size_t at = head_size + i * entry_size;
    if (crc32_of(entry.substr(0, entry_size - 4)) != number_at<std::uint32_t>(entry, entry_size - 4))
      throw damaged_state(
          file, fmt::format("the checksum of bytes {} to {} does not fit", at, at + entry_size - 5));
    const auto length = number_at<std::uint64_t>(entry, name_size);
    const std::string name = padded_at(entry, 0, name_size);
    if (length > file.size() - offset)
      throw damaged_state(file, fmt::format("section `{}` is at bytes {} to {}, and the file ends at byte {}",
                                            name, offset, offset + length, file.size()));
    entries.push_back({name, offset, length, number_at<std::uint32_t>(entry, name_size + 8)});
    offset += length;
  }
  if (offset != file.size())
    throw damaged_state(
        file, fmt::format("the last section ends at byte {}, and the file at byte {}", offset, file.size()));
  return entries;
}

}  // namespace

bool StateFile::has(std::string_view name) const {
  return std::ranges::any_of(sections, [&](const StateSection& s) { return s.name == name; });
}

const StateSection& StateFile::section(std::string_view name) const {
  const auto found = std::ranges::find_if(sections, [&](const StateSection& s) { return s.name == name; });
  if (found == sections.end())
    throw InputError(
        fmt::format("{}: has no section `{}`; it was written by incognita {}: resume it with that version",
                    path.string(), name, program_version));
  return *found;
}

std::string state_file_bytes(std::string_view program_version, const std::vector<StateSection>& sections) {
  if (sections.size() > most_sections) throw std::length_error("a saved run has 64 sections at most");
  std::string bytes = head_of(program_version, sections.size());
  std::size_t size = bytes.size() + sections.size() * entry_size;
  for (const StateSection& section : sections) size += section.bytes.size();
  bytes.reserve(size);
  for (const StateSection& section : sections) bytes += entry_of(section);
  for (const StateSection& section : sections) bytes += section.bytes;
  return bytes;
}

StateFile read_state_file(const std::filesystem::path& path) {
  const InputFile file(path);
  StateFile state;
  state.path = path;
  const std::size_t count = read_head(file, state.program_version);
  for (SectionEntry& entry : read_entries(file, count)) {
    std::string bytes = file.read(entry.offset, entry.length);
    if (crc32_of(bytes) != entry.crc)
      throw damaged_state(file, fmt::format("the checksum of section `{}`, bytes {} to {}, does not fit",
                                            entry.name, entry.offset, entry.offset + entry.length));
    state.sections.push_back({std::move(entry.name), std::move(bytes), entry.offset});
  }
  return state;
}

}  // namespace incognita
