#include "overlay.h"

#include <algorithm>
#include <cstdlib>
#include <glm/gtc/type_ptr.hpp>

#include "glint/gl/check.h"

namespace glint::viewer {
namespace {

constexpr const char* surfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clipFromModel;
uniform mat3 worldFromModelNormal;
out vec3 worldNormal;
void main() {
  worldNormal = worldFromModelNormal * normal;
  gl_Position = clipFromModel * vec4(position, 1.0);
}
)";

constexpr const char* surfaceFragment = R"(#version 330 core
uniform int mode;  // 1 edges, 2 normals, 3 facing, 4 what is outlined, 5 what hides it
uniform float side;
in vec3 worldNormal;
out vec4 color;
void main() {
  vec3 n = normalize(worldNormal + vec3(0.0, 0.0, 1e-20));
  if (mode == 1) color = vec4(1.0, 0.75, 0.2, 0.85);
  else if (mode == 4) color = vec4(1.0);
  else if (mode == 5) color = vec4(0.0);
  else if (mode == 2) color = vec4(n * 0.5 + 0.5, 1.0);
  else {
    vec3 base = (gl_FrontFacing ? 1.0 : -1.0) * side > 0.0 ? vec3(0.2, 0.45, 1.0) : vec3(1.0, 0.25, 0.2);
    color = vec4(base * (0.6 + 0.4 * abs(n.z)), 1.0);
  }
}
)";

Program make(const char* name, const char* vertex, const char* fragment) {
  const ShaderSource sources[] = {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}};
  return Program(name, sources);
}

}  // namespace

namespace {

// Pixels within two pixels of the edge of the marked ones: bright, inside a dark border.
std::vector<std::uint8_t> outlineOf(const std::vector<std::uint8_t>& mask, glm::ivec2 size) {
  std::vector<std::uint8_t> out(mask.size(), 0);
  const auto marked = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < size.x && y < size.y &&
           mask[std::size_t(4) * (std::size_t(size.x) * std::size_t(y) + std::size_t(x)) + 3] > 0;
  };
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const bool here = marked(x, y);
      int nearest = 3;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          if (marked(x + dx, y + dy) != here)
            nearest = std::min(nearest, std::max(std::abs(dx), std::abs(dy)));
      if (nearest > 2) continue;
      std::uint8_t* p =
          out.data() + std::size_t(4) * (std::size_t(size.x) * std::size_t(y) + std::size_t(x));
      const bool bright = here || nearest == 1;
      p[0] = bright ? 255 : 0;
      p[1] = bright ? 190 : 0;
      p[2] = bright ? 60 : 0;
      p[3] = 255;
    }
  return out;
}

}  // namespace

OverlayDrawer::OverlayDrawer() : surface_(make("overlay", surfaceVertex, surfaceFragment)) {}

void OverlayDrawer::resize(glm::ivec2 size) {
  if (size == size_) return;
  size_ = size;
  color_ = TextureHandle::make();
  depth_ = Renderbuffer::make();
  framebuffer_ = Framebuffer::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, color_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size.x, size.y);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
}

std::vector<std::uint8_t> OverlayDrawer::draw(GpuScene& scene, const DrawList& list,
                                              Overlay overlay, int outlined, glm::ivec2 size) {
  resize(size);
  const bool reversed = GLINT_GLAD_GL_ARB_clip_control != 0;
  const glm::mat4 clip(projection(list.camera, {0, 0}, {1, 1}, reversed));
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, size.x, size.y);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  if (reversed) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
  glClearDepth(reversed ? 0.0 : 1.0);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  surface_.use();
  const int mode = overlay == Overlay::wireframe ? 1
                   : overlay == Overlay::normals ? 2
                   : overlay == Overlay::outline ? 4
                                                 : 3;
  glUniform1i(surface_.uniform("mode"), mode);
  const glm::mat3 worldFromEye(list.camera.axes);
  const auto drawAll = [&] {
    for (const DrawItem& item : list.items) {
      if (scene.scene().meshes[std::size_t(item.mesh)].topology != Topology::triangles) continue;
      if (mode != 3 && item.faces != FaceSide::both) {
        glEnable(GL_CULL_FACE);
        glCullFace(item.faces == FaceSide::front ? GL_BACK : GL_FRONT);
      } else {
        glDisable(GL_CULL_FACE);
      }
      glFrontFace(item.mirrored ? GL_CW : GL_CCW);
      const glm::mat4 clipFromModel = clip * item.draw.eyeFromModel;
      const glm::mat3 normals = worldFromEye * glm::mat3(item.draw.normalMatrix);
      glUniformMatrix4fv(surface_.uniform("clipFromModel"), 1, GL_FALSE,
                         glm::value_ptr(clipFromModel));
      glUniformMatrix3fv(surface_.uniform("worldFromModelNormal"), 1, GL_FALSE,
                         glm::value_ptr(normals));
      glUniform1f(surface_.uniform("side"), 1.0f);
      if (mode == 4)
        glUniform1i(surface_.uniform("mode"), outlined < 0 || item.material == outlined ? 4 : 5);
      const auto& g = scene.geometry(item.mesh, item.variant.program == Shading::flat);
      glBindVertexArray(g.array.id());
      glDrawElements(g.mode, g.count, GL_UNSIGNED_INT, nullptr);
    }
  };
  if (mode == 1) {
    // First the surfaces' depth, pushed back a little, then the edges that they do not hide.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(reversed ? -1.0f : 1.0f, reversed ? -1.0f : 1.0f);
    drawAll();
    glDisable(GL_POLYGON_OFFSET_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    drawAll();
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  } else {
    drawAll();
  }
  glDisable(GL_CULL_FACE);
  const std::size_t across = std::size_t(4) * std::size_t(size.x), height = std::size_t(size.y);
  std::vector<std::uint8_t> bottomUp(across * height), layer(across * height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, bottomUp.data());
  for (std::size_t y = 0; y < height; ++y)
    std::copy_n(bottomUp.data() + across * (height - 1 - y), across, layer.data() + across * y);
  checkGl("overlay");
  return mode == 4 ? outlineOf(layer, size) : layer;
}

}  // namespace glint::viewer
