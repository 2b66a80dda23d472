// The wish to save the state of the run that goes on.
#pragma once

namespace incognita {

/// From now on SIGUSR1 asks for a save and does not end the program.
void catch_save_signal();

/// Asks for one; from any thread.
void request_save();

/// Whether it was asked for since the last call.
bool take_save_request();

}  // namespace incognita
