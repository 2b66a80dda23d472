// What the fuzzer and its replay feed.
#pragma once

#include <cstddef>
#include <cstdint>

/// Reads the bytes as a system file, as libFuzzer wants it: returns 0, or dies.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
