// Robust handling of standard input, output and error.
#pragma once

#include <string>

namespace incognita {

/// Opens standard streams that are closed at program start, such that using them fails. Otherwise the next
/// opened file would get their descriptor, and terminal output would be written into it.
void take_closed_streams();

/// Flushes standard output and returns why any output so far was lost; empty if none was.
std::string why_output_failed();

}  // namespace incognita
