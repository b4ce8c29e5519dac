// libFuzzer's entry point; GLINT_FUZZ_TARGET names the target.

#include <cstdint>
#include <cstdlib>

#include "targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto run = [] {
    for (const auto& target : glint::test::fuzzTargets())
      if (target.name == GLINT_FUZZ_TARGET) return target.run;
    std::abort();
  }();
  run(std::as_bytes(std::span(data, size)));
  return 0;
}
