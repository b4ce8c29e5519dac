#include "glint/gl/layers.h"

#include "glint/gl/check.h"

namespace glint {

bool canLayerSamples() { return GLINT_GLAD_GL_ARB_sample_shading != 0; }

DepthLayers::DepthLayers(const RenderTarget& target) : target_(target) {
  for (int i = 0; i < 2; ++i) {
    depths_[i] = target.makeDepths();
    depthAlone_[i] = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, depthAlone_[i].id());
    target.attachDepths(depths_[i]);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    checkFramebuffer();
    withColor_[i] = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, withColor_[i].id());
    target.attachColors();
    target.attachDepths(depths_[i]);
    checkFramebuffer();
  }
  checkGl("making depth layers");
}

void DepthLayers::bindDepths(int number, GLuint unit) const {
  glBindFramebuffer(GL_FRAMEBUFFER, depthAlone_[number % 2].id());
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(target_.textureTarget(),
                number == 0 ? target_.depths().id() : depths_[(number + 1) % 2].id());
  glBindSampler(unit, 0);
}

void DepthLayers::bindColors(int number) const {
  glBindFramebuffer(GL_FRAMEBUFFER, withColor_[number % 2].id());
}

}  // namespace glint
