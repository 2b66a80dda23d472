// Decompresses the chunks of bags.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace incognita::bags {

enum class Compression { none, lz4, zstd, bz2 };

/// Of the word in the file; nullopt for another word. An empty word is `none`.
std::optional<Compression> compression_of(std::string_view word);
std::string word_of(Compression compression);

/// Larger chunks are refused. Writers make chunks of some megabytes, or of one message that is larger.
constexpr std::uint64_t most_chunk_bytes = std::uint64_t{256} << 20;

/// The `size` bytes that `stored` holds. Memory grows with what is decompressed, whatever `size` says. Throws
/// std::runtime_error with the reason, without the file, if the bytes are damaged or are not `size` bytes.
std::string decompressed(Compression compression, std::string_view stored, std::uint64_t size);

}  // namespace incognita::bags
