// Whether a MAT file of level 5 is what its own sizes say, before a library believes them.
#pragma once

#include <string>
#include <string_view>

namespace incognita {

/// Throws InputError beginning with `file` unless the bytes are a MAT file of level 5 whose variables are all
/// whole, and none of them cells, structures, objects or sparse. Of compressed variables only the outer size
/// is looked at.
void check_mat_structure(std::string_view bytes, const std::string& file);

}  // namespace incognita
