// Checks that a level-5 MAT file is consistent with its own sizes before it is passed to a library.
#pragma once

#include <string>
#include <string_view>

namespace incognita {

/// Throws InputError beginning with `file` unless the bytes are a level-5 MAT file with complete variables,
/// none of them cells, structures, objects or sparse. Of compressed variables only the outer size is checked.
void check_mat_structure(std::string_view bytes, const std::string& file);

}  // namespace incognita
