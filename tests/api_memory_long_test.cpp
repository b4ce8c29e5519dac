// A thousand sessions leave nothing behind.

#include <gtest/gtest.h>

#include "api_memory.h"
#include "models_file.h"

namespace api_memory_long_test {

TEST(ApiMemory, StaysFlatOverAThousandSessions) {
  const std::string model = (shipped::folder / "torus.glb").string();
  for (const int threads : {1, 4}) {
    SCOPED_TRACE(threads);
    glint::test::drawSessions(200, threads, model);  // what is kept once
    const double before = glint::test::residentBytes();
    glint::test::drawSessions(1000, threads, model);
    const double growth = glint::test::residentBytes() - before;
    std::printf("%d threads: %.0f bytes a session\n", threads, growth / 1000);
    // A picture of this size and its model are 100 kB: a hundredth of that is what allocators and
    // the driver's own few hundred bytes (lsan.supp) come to.
    EXPECT_LT(growth, 1000 * 2048.0);
  }
}

}  // namespace api_memory_long_test
