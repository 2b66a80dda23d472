#include "incognita/io/bags/compression.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace incognita::bags {
namespace {

/// What one step of a decompressor took and gave.
struct Step {
  std::size_t taken = 0, given = 0;
};

/// Output that grows by what was written to it, to at most `size` bytes and one more, which shows that there are more.
class GrowingOutput {
 public:
  explicit GrowingOutput(std::uint64_t size) : most_(size + 1) {}

  char* room() {
    constexpr std::uint64_t least = 64 * 1024;
    if (used_ == bytes_.size()) bytes_.resize(std::min(most_, std::max<std::uint64_t>(least, 2 * used_)));
    return bytes_.data() + used_;
  }
  std::size_t room_bytes() const { return bytes_.size() - used_; }
  void add(std::size_t n) { used_ += n; }
  bool full() const { return used_ == most_; }
  std::uint64_t used() const { return used_; }
  std::string take() {
    bytes_.resize(used_);
    return std::move(bytes_);
  }

 private:
  std::uint64_t most_;
  std::uint64_t used_ = 0;
  std::string bytes_;
};

/// Calls `step(input, output, room)` until it has taken all input and gives nothing more.
template <class StepFunction>
std::string run(std::string_view stored, std::uint64_t size, StepFunction step) {
  GrowingOutput output(size);
  while (!output.full()) {
    char* const room = output.room();
    const Step done = step(stored, room, output.room_bytes());
    stored.remove_prefix(done.taken);
    output.add(done.given);
    if (done.given == 0 && (stored.empty() || done.taken == 0)) break;
  }
  if (output.used() != size)
    throw std::runtime_error(fmt::format("it has {} bytes after decompression, not the {} stated",
                                         output.full() ? "more" : fmt::to_string(output.used()), size));
  if (!stored.empty())
    throw std::runtime_error(fmt::format("{} bytes follow its compressed content", stored.size()));
  return output.take();
}

std::string decompressed_lz4(std::string_view stored, std::uint64_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, &LZ4F_freeDecompressionContext);
  return run(stored, size, [&](std::string_view input, char* output, std::size_t room) {
    std::size_t taken = input.size(), given = room;
    const std::size_t result = LZ4F_decompress(context, output, &given, input.data(), &taken, nullptr);
    if (LZ4F_isError(result)) throw std::runtime_error(fmt::format("lz4: {}", LZ4F_getErrorName(result)));
    return Step{taken, given};
  });
}

std::string decompressed_zstd(std::string_view stored, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  if (!stream) throw std::bad_alloc();
  return run(stored, size, [&](std::string_view input, char* output, std::size_t room) {
    ZSTD_inBuffer in{input.data(), input.size(), 0};
    ZSTD_outBuffer out{output, room, 0};
    const std::size_t result = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(result)) throw std::runtime_error(fmt::format("zstd: {}", ZSTD_getErrorName(result)));
    return Step{in.pos, out.pos};
  });
}

/// The library counts in 32 bits, of which chunks have fewer.
std::string decompressed_bz2(std::string_view stored, std::uint64_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> owner(&stream, &BZ2_bzDecompressEnd);
  bool ended = false;
  return run(stored, size, [&](std::string_view input, char* output, std::size_t room) {
    if (ended) return Step{};
    stream.next_in = const_cast<char*>(input.data());
    stream.avail_in = static_cast<unsigned>(input.size());
    stream.next_out = output;
    stream.avail_out = static_cast<unsigned>(room);
    const int result = BZ2_bzDecompress(&stream);
    if (result != BZ_OK && result != BZ_STREAM_END)
      throw std::runtime_error(fmt::format("bz2: the data is damaged (code {})", result));
    ended = result == BZ_STREAM_END;
    return Step{input.size() - stream.avail_in, room - stream.avail_out};
  });
}

}  // namespace

std::optional<Compression> compression_of(std::string_view word) {
  if (word.empty() || word == "none") return Compression::none;
  if (word == "lz4") return Compression::lz4;
  if (word == "zstd") return Compression::zstd;
  if (word == "bz2") return Compression::bz2;
  return std::nullopt;
}

std::string word_of(Compression compression) {
  switch (compression) {
    case Compression::none:
      return "none";
    case Compression::lz4:
      return "lz4";
    case Compression::zstd:
      return "zstd";
    case Compression::bz2:
      return "bz2";
  }
  return "";
}

std::string decompressed(Compression compression, std::string_view stored, std::uint64_t size) {
  if (size > most_chunk_bytes || stored.size() > most_chunk_bytes)
    throw std::runtime_error(fmt::format("its {} bytes ({} compressed) are more than the {} MiB allowed",
                                         size, stored.size(), most_chunk_bytes >> 20));
  if (size == 0 && stored.empty()) return {};
  switch (compression) {
    case Compression::none:
      if (stored.size() != size) throw std::runtime_error("its two sizes differ");
      return std::string(stored);
    case Compression::lz4:
      return decompressed_lz4(stored, size);
    case Compression::zstd:
      return decompressed_zstd(stored, size);
    case Compression::bz2:
      return decompressed_bz2(stored, size);
  }
  return {};
}

}  // namespace incognita::bags
