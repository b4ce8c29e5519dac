// A driver that runs out of memory or loses its context in the middle of a picture: there must be
// an error message and no picture.

#include <glad/gl.h>

#include <string>

#include "stage.h"

namespace glint::test::context_lost_gl_test {

constexpr GLenum contextLost = 0x0507;

PFNGLGETERRORPROC realGetError = nullptr;
int goodCalls = 0;
GLenum failure = GL_NO_ERROR;

/// Returns the driver's own result a number of times, then the failure for ever, as for a lost
/// context.
GLenum failingGetError() { return goodCalls-- > 0 ? realGetError() : failure; }

/// Replaces glGetError while it lives.
class FailingDriver {
 public:
  FailingDriver(GLenum code, int callsBefore) {
    realGetError = glint_glad_glGetError;
    failure = code;
    goodCalls = callsBefore;
    glint_glad_glGetError = failingGetError;
  }
  ~FailingDriver() { glint_glad_glGetError = realGetError; }
};

class ContextLost : public OnStage {};

TEST_P(ContextLost, GivesAnErrorInWordsAndNoPicture) {
  const glint::Scene scene = sceneOf(sphere(8, 4), materialOf(1, 1, 0.5, 20));
  glint::Look look = parallelLook({0, 0, 1}, 16);
  look.light = {directional({0, 0, 1})};
  const glint::GlslSources sources;
  const std::pair<GLenum, std::string> failures[] = {{GL_OUT_OF_MEMORY, "out of memory"},
                                                     {contextLost, "the context is lost"}};
  for (const auto& [code, words] : failures)
    for (int calls = 0;; ++calls) {
      std::string message;
      bool reached = true;
      {
        const FailingDriver driver(code, calls);
        try {
          // A new renderer each time: creating the target is among what fails.
          stage().draw(sources, scene, look);
        } catch (const Error& error) {
          message = error.what();
        }
        reached = goodCalls < 0;
      }
      while (glGetError() != GL_NO_ERROR) {
      }
      if (!reached) {  // the whole picture makes fewer calls than that
        EXPECT_EQ(message, "");
        EXPECT_GE(calls, 4) << "making, uploading, drawing and reading are to be checked";
        break;
      }
      EXPECT_NE(message.find(words), std::string::npos) << calls << ": " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

INSTANTIATE_TEST_SUITE_P(Render, ContextLost, softwareBackends(), nameOfBackend);

}  // namespace glint::test::context_lost_gl_test
