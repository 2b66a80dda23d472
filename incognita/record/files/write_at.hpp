// Writes bytes at an offset of a file, without short writes.
#pragma once

#include <cstdint>
#include <string_view>

namespace incognita {

/// Writes all bytes at `offset`, independent of the file position. Returns 0, or errno on failure; part of
/// the bytes may have been written then.
int write_at(int descriptor, std::string_view bytes, std::int64_t offset);

}  // namespace incognita
