// Fuzz target: any bytes as an MCAP file or a ROS 1 bag must give a recording, or an error that names the file.
//
//   cmake -G Ninja -B build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DINCOGNITA_FUZZ=ON
//         -DINCOGNITA_SANITIZE=fuzzer-no-link,address,undefined -DINCOGNITA_BENCH=OFF
//   cmake --build build-fuzz --target bag_fuzz
//   mkdir -p build-fuzz/bags && build-fuzz/bag_fuzz -max_len=100000 -timeout=10 -max_total_time=600 build-fuzz/bags
//                                                   tests/io/bags/written
#include <cstdlib>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "incognita/io/recordings/recording.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/scratch.hpp"

namespace {

using namespace incognita;

void check_message(std::string_view message, const std::filesystem::path& path) {
  if (message.starts_with(path.string()) && message.size() < 4000) return;
  std::cerr << "a message that names no file, or is too long: " << message << '\n';
  std::abort();
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const incognita::testing::Scratch scratch;
  const std::filesystem::path path = scratch.write("x.bag", {reinterpret_cast<const char*>(data), size});
  std::optional<Recording> recording;
  try {
    recording = read_recording(path, "bag", 30);
  } catch (const InputError& error) {
    check_message(error.what(), path);
    return 0;
  }
  for (std::size_t frame = 0; frame < recording->frames.size(); ++frame) try {
      recording->images->read(frame);
    } catch (const std::runtime_error& error) {
      check_message(error.what(), path);
    }
  return 0;
}
