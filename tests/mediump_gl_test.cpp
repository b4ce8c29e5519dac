// What the driver makes of mediump.

#include "glint/gl/mediump.h"

#include <gmock/gmock.h>

#include "glint/gl/context.h"

namespace glint {
namespace mediump_gl_test {

// Mesa's software driver of 22.3 computes all floats in 32 bits, though it says that mediump has 10
// bits; later ones are free to take halves.
TEST(Mediump, IsFoundOutByWhatIsLost) {
  const MediumpReport report = mediumpOfDriver();
  EXPECT_FALSE(report.renderer.empty());
  if (report.renderer.starts_with("llvmpipe (LLVM 15")) {
    EXPECT_FALSE(report.isHalf);
  }
  // OpenGL's own functions are loaded again by whoever comes next.
  const auto context = openContext(Backend::eglSoftware);
  context->makeCurrent();
  EXPECT_THAT(glStrings().version, testing::HasSubstr("Core Profile"));
}

}  // namespace mediump_gl_test
}  // namespace glint
