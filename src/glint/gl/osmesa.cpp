// Mesa's off-screen library. Its header is not needed for five functions and a few constants.

#include <array>
#include <string>

#include "glint/gl/backends.h"

namespace glint::backends {

namespace {

using OsmesaHandle = struct OsmesaContextTag*;

struct OsmesaFunctions {
  OsmesaHandle (*createContextAttribs)(const int* attributes, OsmesaHandle share);
  void (*destroyContext)(OsmesaHandle context);
  unsigned char (*makeCurrent)(OsmesaHandle context, void* buffer, unsigned type, int width,
                               int height);
  OsmesaHandle (*getCurrentContext)();
  void (*(*getProcAddress)(const char* name))();
};

// Names and values from GL/osmesa.h; GL_RGBA and GL_UNSIGNED_BYTE for the colour buffer.
enum : int {
  osmesaFormat = 0x22,
  osmesaDepthBits = 0x30,
  osmesaStencilBits = 0x31,
  osmesaAccumBits = 0x32,
  osmesaProfile = 0x33,
  osmesaCoreProfile = 0x34,
  osmesaMajorVersion = 0x36,
  osmesaMinorVersion = 0x37,
  rgba = 0x1908,
  unsignedByte = 0x1401,
  glVersionName = 0x1F02,
};

/// GL_VERSION of the context that a driver without OpenGL 3.3 provides; empty if there is none.
std::string versionWithoutAttributes(const OsmesaFunctions& osmesa) {
  const int plain[] = {osmesaFormat, rgba, 0};
  const OsmesaHandle context = osmesa.createContextAttribs(plain, nullptr);
  if (!context) return {};
  std::string version;
  std::array<unsigned char, 4> pixel{};
  if (osmesa.makeCurrent(context, pixel.data(), unsignedByte, 1, 1)) {
    using GetString = const unsigned char* (*)(unsigned);
    const auto getString = reinterpret_cast<GetString>(osmesa.getProcAddress("glGetString"));
    const unsigned char* text = getString ? getString(glVersionName) : nullptr;
    if (text) version = reinterpret_cast<const char*>(text);
    osmesa.makeCurrent(nullptr, nullptr, 0, 0, 0);
  }
  osmesa.destroyContext(context);
  return version;
}

class OsmesaContext final : public Context {
 public:
  OsmesaContext(const OsmesaFunctions& osmesa, OsmesaHandle context, std::string description)
      : Context(Backend::osmesa, std::move(description)), osmesa_(osmesa), context_(context) {}
  ~OsmesaContext() override {
    OsmesaContext::release();
    osmesa_.destroyContext(context_);
  }

  void release() override {
    if (osmesa_.getCurrentContext() == context_) osmesa_.makeCurrent(nullptr, nullptr, 0, 0, 0);
  }

 private:
  void bind() override {
    if (!osmesa_.makeCurrent(context_, pixel_.data(), unsignedByte, 1, 1))
      throw ContextError("osmesa: OSMesaMakeCurrent failed");
  }
  Loader loader() const override { return osmesa_.getProcAddress; }

  OsmesaFunctions osmesa_;
  OsmesaHandle context_;
  std::array<unsigned char, 4> pixel_{};  // the colour buffer that OSMesa requires; not used
};

}  // namespace

std::unique_ptr<Context> openOsmesa(std::span<const char* const> sonames) {
  OsmesaFunctions osmesa{};
  const auto to = [](auto& function) { return reinterpret_cast<void**>(&function); };
  const Symbol symbols[] = {
      {"OSMesaCreateContextAttribs", to(osmesa.createContextAttribs)},
      {"OSMesaDestroyContext", to(osmesa.destroyContext)},
      {"OSMesaMakeCurrent", to(osmesa.makeCurrent)},
      {"OSMesaGetCurrentContext", to(osmesa.getCurrentContext)},
      {"OSMesaGetProcAddress", to(osmesa.getProcAddress)},
  };
  openLibrary(sonames, symbols, "install the Debian package libosmesa6");
  const int attributes[] = {osmesaFormat,
                            rgba,
                            osmesaDepthBits,
                            0,
                            osmesaStencilBits,
                            0,
                            osmesaAccumBits,
                            0,
                            osmesaProfile,
                            osmesaCoreProfile,
                            osmesaMajorVersion,
                            3,
                            osmesaMinorVersion,
                            3,
                            0};
  const OsmesaHandle context = osmesa.createContextAttribs(attributes, nullptr);
  if (!context) {
    const std::string version = versionWithoutAttributes(osmesa);
    throw ContextError(version.empty()
                           ? "OSMesaCreateContextAttribs cannot create a context of any OpenGL "
                             "version: reinstall the Debian package libosmesa6 or use another "
                             "--rendering-backend"
                           : "the driver has no OpenGL 3.3 core context, only " + version);
  }
  return std::make_unique<OsmesaContext>(osmesa, context, "osmesa: Mesa's off-screen library");
}

}  // namespace glint::backends
