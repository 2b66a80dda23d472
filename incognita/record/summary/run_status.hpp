// How a run ended.
#pragma once

namespace incognita {

enum class RunStatus { done, failed, interrupted };
const char* name(RunStatus status);

}  // namespace incognita
