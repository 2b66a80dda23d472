// A fuzz target, shared by the fuzzer and its replay.
#pragma once

#include <cstddef>
#include <cstdint>

/// Reads the bytes as a file, with the interface of libFuzzer: returns 0, or crashes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
