// Fuzz target: any bytes as run.mcap must give a run whose frames can be read, or an error that names the file.
//
//   cmake -G Ninja -B build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DINCOGNITA_FUZZ=ON
//         -DINCOGNITA_SANITIZE=fuzzer-no-link,address,undefined -DINCOGNITA_BENCH=OFF
//   cmake --build build-fuzz --target run_fuzz
//   mkdir -p build-fuzz/found && build-fuzz/run_fuzz -max_len=100000 -timeout=10 -max_total_time=600 build-fuzz/found
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "incognita/messages/errors.hpp"
#include "incognita/record/replay/recorded_run.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/scratch.hpp"

namespace {

using namespace incognita;

/// A frame that was accepted once can always be read.
void use(const RecordedRun& run) {
  run.series_json();
  for (std::int64_t frame = 0; frame < run.frames(); ++frame) run.frame_json(frame);
}

void check(const InputError& error, const std::filesystem::path& path) {
  const std::string_view message = error.what();
  if (message.starts_with(path.string()) && message.size() < 2000) return;
  std::cerr << "a message that names no file, or is too long: " << message << '\n';
  std::abort();
}

/// What may be damaged although the frames are not.
void use_rest(const RecordedRun& run, const std::filesystem::path& path) {
  try {
    run.info_json();
    for (std::int64_t frame = 0; frame < run.frames(); ++frame) run.image(frame);
  } catch (const InputError& error) {
    check(error, path);
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const incognita::testing::Scratch scratch;
  const std::filesystem::path path = scratch.write("run.mcap", {reinterpret_cast<const char*>(data), size});
  std::optional<RecordedRun> run;
  try {
    run.emplace(path);
  } catch (const InputError& error) {
    check(error, path);
    return 0;
  }
  use(*run);
  use_rest(*run, path);
  return 0;
}
