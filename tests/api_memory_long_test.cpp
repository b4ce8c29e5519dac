// A thousand sessions leak nothing.

#include <gtest/gtest.h>

#include "api_memory.h"
#include "models_file.h"

namespace api_memory_long_test {

TEST(ApiMemory, StaysFlatOverAThousandSessions) {
  const std::string model = (shipped::folder / "torus.glb").string();
  for (const int threads : {1, 4}) {
    SCOPED_TRACE(threads);
    glint::test::drawSessions(200, threads, model);  // allocates what is kept once
    const double before = glint::test::residentBytes();
    glint::test::drawSessions(1000, threads, model);
    const double growth = glint::test::residentBytes() - before;
    std::printf("%d threads: %.0f bytes a session\n", threads, growth / 1000);
    // A picture of this size and its model are 100 kB. A hundredth of that allows for allocators
    // and for the driver's own leak of a few hundred bytes (lsan.supp).
    EXPECT_LT(growth, 1000 * 2048.0);
  }
}

}  // namespace api_memory_long_test
