// The error messages if there is no OpenGL: fake drivers, no context.

#include <gmock/gmock.h>

#include "glint/gl/backends.h"
#include "glint/gl/context.h"

namespace glint::gl_failure_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string fake(const char* folder, const char* library) {
  return std::string(GLINT_BINARY_DIR "/tests/fake/") + folder + "/" + library;
}

std::unique_ptr<glint::Context> openEgl(const char* folder, bool software = false) {
  const std::string path = fake(folder, "libEGL.so.1");
  const char* const names[] = {path.c_str()};
  return glint::backends::openEgl(names, software);
}

std::unique_ptr<glint::Context> openOsmesa(const char* folder) {
  const std::string path = fake(folder, "libOSMesa.so.8");
  const char* const names[] = {path.c_str()};
  return glint::backends::openOsmesa(names);
}

/// The message of the ContextError, or a text that no test expects.
template <class Open>
std::string failure(Open open) {
  try {
    open();
  } catch (const ContextError& error) {
    return error.what();
  }
  return "opened";
}

std::unique_ptr<glint::Context> openMissing() {
  const char* const names[] = {"libNoEGL.so.1", "libNoEGL.so.0"};
  return glint::backends::openEgl(names, false);
}

TEST(GlFailure, MissingLibraryNamesThePackages) {
  EXPECT_EQ(failure(openMissing),
            "libNoEGL.so.1 or libNoEGL.so.0 not found: install the Debian packages libegl1, "
            "libegl-mesa0, libgl1-mesa-dri");
  const char* const osmesa[] = {"libNoOSMesa.so.8"};
  EXPECT_EQ(failure([&] { glint::backends::openOsmesa(osmesa); }),
            "libNoOSMesa.so.8 not found: install the Debian package libosmesa6");
}

TEST(GlFailure, MissingSymbolIsNamed) {
  EXPECT_THAT(failure([] { openEgl("no-symbols"); }),
              HasSubstr("libEGL.so.1 lacks the symbol eglGetProcAddress"));
  EXPECT_THAT(failure([] { openOsmesa("no-symbols"); }),
              AllOf(HasSubstr("libOSMesa.so.8 lacks the symbol OSMesaCreateContextAttribs"),
                    HasSubstr("install the Debian package libosmesa6")));
}

TEST(GlFailure, UnloadableLibraryGivesTheLoadersReason) {
  const char* const names[] = {GLINT_SOURCE_DIR "/CMakeLists.txt"};
  EXPECT_THAT(failure([&] { glint::backends::openOsmesa(names); }),
              AllOf(HasSubstr("cannot load"), HasSubstr("invalid ELF header")));
}

TEST(GlFailure, LaterNameServesAfterUselessOne) {
  const std::string empty = fake("no-symbols", "libEGL.so.1"), gpu = fake("gpu", "libEGL.so.1");
  const char* const names[] = {"libNoEGL.so.1", empty.c_str(), gpu.c_str()};
  EXPECT_EQ(glint::backends::openEgl(names, false)->backend(), Backend::egl);
}

TEST(GlFailure, NoContext) {
  EXPECT_THAT(failure([] { openOsmesa("no-context"); }), HasSubstr("cannot create a context"));
}

TEST(GlFailure, NoDevice) {
  EXPECT_THAT(failure([] { openEgl("no-context"); }),
              AllOf(HasSubstr("no device"), HasSubstr("libegl-mesa0")));
  // A GPU is not a software device.
  EXPECT_THAT(failure([] { openEgl("no-start", true); }), HasSubstr("no software device"));
}

TEST(GlFailure, EglErrorsAreInWords) {
  EXPECT_EQ(failure([] { openEgl("no-start"); }),
            "device 0, /dev/dri/fake: eglInitialize: EGL_NOT_INITIALIZED, the driver cannot be "
            "started (is the user in the group render?)");
}

TEST(GlFailure, OldVersionIsNamed) {
  EXPECT_THAT(failure([] { openEgl("old-version"); }),
              HasSubstr("no OpenGL 3.3 core context, only 2.1 Fake"));
  EXPECT_THAT(failure([] { openOsmesa("old-version"); }),
              HasSubstr("no OpenGL 3.3 core context, only 2.1 Fake"));
}

TEST(GlFailure, GpuComesFirstAndIsNotTakenForSoftware) {
  EXPECT_EQ(openEgl("gpu")->description(), "egl: device 0, /dev/dri/fake");
  EXPECT_THAT(failure([] { openEgl("gpu", true); }),
              HasSubstr("draws with \"Fake GPU\", not with Mesa's software renderer"));
}

TEST(GlFailure, SoftwareByEnvironmentLeavesGpusOut) {
  setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
  EXPECT_EQ(openEgl("gpu")->description(), "egl: Mesa's surfaceless platform");
  unsetenv("LIBGL_ALWAYS_SOFTWARE");
}

TEST(GlFailure, MakeCurrentRefusesADriverWithoutFunctions) {
  const auto context = openEgl("gpu");
  EXPECT_THAT(failure([&] { context->makeCurrent(); }), HasSubstr("OpenGL 3.3 is needed"));
}

TEST(GlFailure, FirstThatWorksRemarksOnTheOthers) {
  const glint::backends::Opener openers[] = {{"missing", openMissing},
                                             {"gpu", [] { return openEgl("gpu"); }}};
  const auto context = glint::backends::openFirst(openers, true);
  EXPECT_THAT(context->remark(), StartsWith("missing: libNoEGL.so.1 or libNoEGL.so.0 not found"));
  // Without a GPU, a missing library is not reported; one that fails is.
  EXPECT_EQ(glint::backends::openFirst(openers, false)->remark(), "");
  const glint::backends::Opener failing[] = {{"broken", [] { return openOsmesa("no-context"); }},
                                             {"gpu", [] { return openEgl("gpu"); }}};
  EXPECT_THAT(glint::backends::openFirst(failing, false)->remark(), StartsWith("broken: "));
}

TEST(GlFailure, AllReasonsAreToldInOneLine) {
  const glint::backends::Opener openers[] = {{"one", openMissing},
                                             {"two", [] { return openOsmesa("no-context"); }}};
  const std::string all = failure([&] { glint::backends::openFirst(openers, false); });
  EXPECT_THAT(all, AllOf(StartsWith("no OpenGL context: one: "), HasSubstr("; two: ")));
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 0);
  EXPECT_THAT(failure([&] {
                glint::backends::openFirst({openers, 1}, false);
              }),
              Not(HasSubstr("\n")));
}

TEST(GlFailure, BackendNames) {
  for (Backend backend : {Backend::automatic, Backend::egl, Backend::eglSoftware, Backend::osmesa})
    EXPECT_EQ(glint::backendFromName(glint::backendName(backend)), backend);
  EXPECT_THROW(glint::backendFromName("vulkan"), glint::InputError);
}

}  // namespace glint::gl_failure_test
