#include "incognita/io/bags/ros1_record.hpp"

namespace incognita::ros1 {
namespace {

constexpr std::uint64_t most_header_bytes = 1 << 20;

/// The length before a header or data, which must end at `end` at the latest.
std::uint64_t length_at(bags::RecordBytes& bytes, std::uint64_t at, std::uint64_t end, std::uint64_t record) {
  constexpr std::uint64_t length_bytes = 4;
  if (at > end || end - at < length_bytes) throw bags::Damage{record, "a record is cut off"};
  const auto length = bags::RecordCursor(bytes.read(at, length_bytes), record).number<std::uint32_t>();
  if (length > end - at - length_bytes)
    throw bags::Damage{
        record, fmt::format("a record of {} bytes is cut off after {}", length, end - at - length_bytes)};
  return length;
}

}  // namespace

HeaderFields::HeaderFields(std::string_view bytes, std::uint64_t offset) : offset_(offset) {
  bags::RecordCursor cursor(bytes, offset);
  while (!cursor.done()) {
    const std::string_view field = cursor.text();
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw bags::Damage{offset, "no record begins there"};
    fields_.emplace_back(field.substr(0, equals), field.substr(equals + 1));
  }
}

const std::string* HeaderFields::find(std::string_view name) const {
  for (const auto& [key, value] : fields_)
    if (key == name) return &value;
  return nullptr;
}

const std::string& HeaderFields::text(std::string_view name) const {
  if (const std::string* value = find(name)) return *value;
  throw bags::Damage{offset_, fmt::format("a record has no field `{}`", name)};
}

std::uint64_t HeaderFields::time(std::string_view name) const {
  bags::RecordCursor fields(text(name), offset_);
  return time_of(fields);
}

std::uint64_t time_of(bags::RecordCursor& fields) {
  constexpr std::uint64_t second = 1'000'000'000;
  const auto seconds = fields.number<std::uint32_t>(), nanoseconds = fields.number<std::uint32_t>();
  return seconds * second + nanoseconds;
}

Record record_at(bags::RecordBytes& bytes, std::uint64_t offset, std::uint64_t end) {
  const std::uint64_t header_length = length_at(bytes, offset, end, offset), header = offset + 4;
  if (header_length > most_header_bytes)
    throw bags::Damage{offset, fmt::format("a header of {} bytes is longer than any", header_length)};
  Record record{.offset = offset, .header = HeaderFields(bytes.read(header, header_length), offset)};
  record.op = static_cast<Op>(record.header.number<std::uint8_t>("op"));
  record.length = length_at(bytes, header + header_length, end, offset);
  record.data = header + header_length + 4;
  return record;
}

}  // namespace incognita::ros1
