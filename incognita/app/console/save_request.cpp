#include "incognita/app/console/save_request.hpp"

#include <atomic>
#include <csignal>

namespace incognita {
namespace {

std::atomic<bool> save_is_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // a handler may set it

void request_by_signal(int) { save_is_requested = true; }

}  // namespace

void catch_save_signal() { std::signal(SIGUSR1, request_by_signal); }

void request_save() { save_is_requested = true; }

bool take_save_request() { return save_is_requested.exchange(false); }

}  // namespace incognita
