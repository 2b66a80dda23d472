// Standard input, output and error, as they are found.
#pragma once

#include <string>

namespace incognita {

/// Whoever starts the program may have closed them. The next file opened would then take their number, and
/// what is meant for the terminal would be written into it: from here on such a stream is taken, and refuses.
void take_closed_streams();

/// Hands everything to standard output. Why not all that was printed got there, ever; empty when it did.
std::string why_output_failed();

}  // namespace incognita
