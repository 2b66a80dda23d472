#include "incognita/record/mcap/mcap_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/record/files/write_at.hpp"

namespace incognita {
namespace {

constexpr std::size_t chunk_bytes = 1024 * 1024;
constexpr std::uint64_t chunk_ns = 2'000'000'000;

}  // namespace

McapFile::McapFile(std::filesystem::path path, std::string_view library) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw RecordError(write_failure(path_, errno));
  const std::string opening = mcap::opening_part(library);
  data_end_ = opening.size();
  data_crc_.add(opening);
  closing_ = mcap::closing_part(summary_, data_end_, data_crc_.value());
  if (const int error = write_at(descriptor_, opening + closing_, 0)) {
    ::close(descriptor_);
    ::unlink(path_.c_str());
    throw RecordError(write_failure(path_, error));
  }
}

McapFile::~McapFile() {
  try {
    close();
  } catch (const RecordError&) {  // the file is valid as it is, and a destructor must not throw
  }
}

/// Adds the chunk's bytes from `begin` on. Done per message, so that no single frame pays for a whole chunk.
void McapFile::add_to_checksum(std::size_t begin) {
  chunk_.records_crc.add(std::string_view(chunk_.records).substr(begin));
}

std::uint16_t McapFile::schema_id(std::string_view name, std::string_view text) {
  for (const mcap::Schema& schema : summary_.schemas)
    if (schema.name == name) return schema.id;
  const auto id = static_cast<std::uint16_t>(summary_.schemas.size() + 1);
  summary_.schemas.push_back({id, std::string(name), std::string(text)});
  mcap::append_schema(chunk_.records, summary_.schemas.back());
  return id;
}

std::uint16_t McapFile::add_channel(std::string_view topic, std::string_view schema_name,
                                    std::string_view schema_text) {
  const std::size_t begin = chunk_.records.size();
  const std::uint16_t schema = schema_id(schema_name, schema_text);
  const auto id = static_cast<std::uint16_t>(summary_.channels.size() + 1);
  summary_.channels.push_back({id, schema, std::string(topic)});
  mcap::append_channel(chunk_.records, summary_.channels.back());
  add_to_checksum(begin);
  return id;
}

bool McapFile::chunk_is_due(std::uint64_t time_ns) const {
  // A clock that jumps back ends a chunk, too.
  return chunk_.records.size() >= chunk_bytes || time_ns < chunk_.end_ns ||
         time_ns - chunk_.start_ns >= chunk_ns;
}

void McapFile::write(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  if (!is_open()) return;
  if (!chunk_.messages.empty() && chunk_is_due(time_ns)) flush();
  if (chunk_.messages.empty()) chunk_.start_ns = time_ns;
  chunk_.end_ns = time_ns;
  const std::size_t begin = chunk_.records.size();
  chunk_.messages[channel].emplace_back(time_ns, begin);
  const std::uint64_t count = summary_.message_counts[channel]++;
  mcap::append_message(chunk_.records, {channel, static_cast<std::uint32_t>(count), time_ns, json});
  add_to_checksum(begin);
}

void McapFile::flush() {
  if (!is_open() || chunk_.messages.empty()) return;
  writing_.clear();
  summary_.chunks.push_back(mcap::append_chunk(writing_, chunk_, data_end_));
  data_crc_.add(writing_);
  const std::uint64_t next_end = data_end_ + writing_.size();
  std::string closing = mcap::closing_part(summary_, next_end, data_crc_.value());
  writing_ += closing;
  if (const int error = write_at(descriptor_, writing_, static_cast<std::int64_t>(data_end_))) fail(error);
  data_end_ = next_end;
  closing_ = std::move(closing);
  chunk_.clear();
}

void McapFile::fail(int error) {
  const bool closed = write_at(descriptor_, closing_, static_cast<std::int64_t>(data_end_)) == 0;
  const std::uint64_t end = data_end_ + (closed ? closing_.size() : 0);
  // Truncating needs no disk space; if it fails nevertheless, there is no better fallback.
  [[maybe_unused]] const int cut = ::ftruncate(descriptor_, static_cast<off_t>(end));
  ::close(std::exchange(descriptor_, -1));
  chunk_.clear();
  throw RecordError(write_failure(path_, error));
}

void McapFile::close() {
  if (!is_open()) return;
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0) throw RecordError(write_failure(path_, errno));
}

}  // namespace incognita
