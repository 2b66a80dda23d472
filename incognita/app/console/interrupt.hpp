// The wish to end the program: Ctrl-C and its like.
#pragma once

namespace incognita {

/// From now on SIGINT, SIGTERM and SIGHUP do not end the program, however often they are sent, but set interrupted(). A SIGHUP
/// that is ignored, as under nohup, stays ignored.
void catch_interrupts();

bool interrupted();

}  // namespace incognita
