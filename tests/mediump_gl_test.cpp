// The precision that the driver gives mediump.

#include "glint/gl/mediump.h"

#include <gmock/gmock.h>

#include "glint/gl/context.h"

namespace glint {
namespace mediump_gl_test {

// Mesa's software driver of 22.3 computes all floats in 32 bits, though it reports 10 bits for
// mediump; later ones may use halves.
TEST(Mediump, IsFoundOutByWhatIsLost) {
  const MediumpReport report = mediumpOfDriver();
  EXPECT_FALSE(report.renderer.empty());
  if (report.renderer.starts_with("llvmpipe (LLVM 15")) {
    EXPECT_FALSE(report.isHalf);
  }
  // OpenGL's own functions are loaded again by the next context.
  const auto context = openContext(Backend::eglSoftware);
  context->makeCurrent();
  EXPECT_THAT(glStrings().version, testing::HasSubstr("Core Profile"));
}

}  // namespace mediump_gl_test
}  // namespace glint
