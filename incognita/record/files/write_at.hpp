// Bytes at a place in a file, all of them or a reason.
#pragma once

#include <cstdint>
#include <string_view>

namespace incognita {

/// Writes until done or refused, wherever the file's own position is. 0, or the error number of the refusal;
/// some of the bytes may be in the file then.
int write_at(int descriptor, std::string_view bytes, std::int64_t offset);

}  // namespace incognita
