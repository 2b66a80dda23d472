// Fuzz target: any bytes as a system file must give a system, or an error that names the file.
//
//   cmake -G Ninja -B build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DINCOGNITA_FUZZ=ON
//         -DINCOGNITA_SANITIZE=fuzzer-no-link,address,undefined -DINCOGNITA_BENCH=OFF
//   cmake --build build-fuzz --target system_fuzz
//   mkdir -p build-fuzz/found && build-fuzz/system_fuzz -max_len=20000 -timeout=10 -max_total_time=600
//         -detect_leaks=0 build-fuzz/found tests/fuzz/corpus systems
//
// GiNaC's power::derivative leaks some 40 bytes when a number overflows and it throws: these leaks are in GiNaC.
#include "tests/fuzz/fuzz_target.hpp"

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "incognita/analysis/systems/symbolic_system.hpp"
#include "incognita/analysis/systems/system_error.hpp"
#include "incognita/analysis/systems/system_instance.hpp"
#include "incognita/io/formats/system_file.hpp"
#include "incognita/messages/errors.hpp"

namespace {

using namespace incognita;

/// Computes all derivatives once, at the center of its region.
void use(const SystemText& text) {
  const SymbolicSystem system = make_symbolic(text);
  const SystemInstance instance(system, text.landmark ? 1 : 0, text.anchor ? 1 : 0);
  const auto middle = [](const std::vector<NamedRange>& first, const std::vector<NamedRange>& then) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(first.size() + then.size()));
    Eigen::Index i = 0;
    for (const auto* ranges : {&first, &then})
      for (const NamedRange& r : *ranges) values[i++] = r.low / 2 + r.high / 2;
    return values;
  };
  instance.linearize(
      {middle(system.vehicle.region, text.landmark ? system.landmark.region : std::vector<NamedRange>{}),
       middle(system.input_ranges, {}), middle(system.anchor.region, {})});
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    use(read_system({reinterpret_cast<const char*>(data), size}, "fuzz.toml"));
  } catch (const SystemError&) {
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    if (message.starts_with("fuzz.toml:") && message.size() < 2000) return 0;
    std::cerr << "a message that names no file, or is too long: " << message << '\n';
    std::abort();
  }
  return 0;
}
