#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app.h"
#include "light_edit.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

constexpr float handleRadius = 7;  // at scale 1

bool hasPlace(const Light& light) {
  return light.type == Light::Type::point || light.type == Light::Type::spot;
}

// The direction to the light, world space.
glm::dvec3 towards(const Light& light, const glm::dmat3& axes) {
  const glm::dvec3 d = light.type == Light::Type::camera ? axes * light.direction : light.direction;
  const double length = glm::length(d);
  return length > 0 ? d / length : axes[2];
}

glm::dvec3 tidyVector(const glm::dvec3& v) { return glm::round(v * 1e4) / 1e4; }

}  // namespace

// A point or spot light has a handle at its position, and a spot another where it shines; a
// directional light has one on a ball around the model.
std::vector<App::LightHandle> App::lightHandles() const {
  std::vector<LightHandle> handles;
  if (!session_.lightHandles || !session_.model || !shownResult_.a) return handles;
  const Bounds& bounds = session_.model->bounds;
  const Camera& camera = shownResult_.a->list.camera;
  const std::vector<Light> lights = shownLights(&session_.model->scene, session_.document.a);
  const auto add = [&](std::size_t i, bool aim, const glm::dvec3& at, bool behind) {
    if (const auto place = placeOf(at)) handles.push_back({i, aim, *place, behind});
  };
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights[i];
    if (!hasPlace(light)) {
      const glm::dvec3 to = towards(light, camera.axes);
      add(i, false, bounds.center + to * bounds.radius, glm::dot(to, camera.axes[2]) < 0);
      continue;
    }
    add(i, false, light.position, false);
    if (light.type != Light::Type::spot) continue;
    const double length = glm::length(light.direction);
    const double reach = glm::length(bounds.center - light.position);
    if (length > 0) add(i, true, light.position + light.direction / length * reach, false);
  }
  return handles;
}

std::optional<App::LightHandle> App::handleAt(glm::dvec2 mouse) const {
  std::optional<LightHandle> nearest;
  double distance = 1.6 * double(handleRadius * widgets::style().scale);
  for (const LightHandle& handle : lightHandles())
    if (const double d = glm::length(handle.place - mouse); d < distance) {
      distance = d;
      nearest = handle;
    }
  return nearest;
}

void App::drawLightHandles() {
  const std::vector<LightHandle> handles = lightHandles();
  if (handles.empty()) return;
  const std::vector<Light> lights = shownLights(&session_.model->scene, session_.document.a);
  const auto center = placeOf(session_.model->bounds.center);
  const float s = widgets::style().scale, r = handleRadius * s;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto vec = [](const glm::dvec2& p) { return ImVec2(float(p.x), float(p.y)); };
  for (const LightHandle& handle : handles) {
    const bool selected = handle.light == session_.light;
    const ImU32 color = selected ? IM_COL32(255, 214, 120, 255) : IM_COL32(255, 255, 255, 220);
    const ImVec2 at = vec(handle.place);
    if (handle.aim) {
      for (const LightHandle& from : handles)
        if (from.light == handle.light && !from.aim) draw->AddLine(vec(from.place), at, color, s);
      draw->AddRect(ImVec2(at.x - r / 2, at.y - r / 2), ImVec2(at.x + r / 2, at.y + r / 2), color,
                    0, 0, 1.5f * s);
      continue;
    }
    if (center && !hasPlace(lights[handle.light])) draw->AddLine(vec(*center), at, color, s);
    draw->AddCircleFilled(at, r, IM_COL32(0, 0, 0, 150));
    if (!handle.behind) draw->AddCircleFilled(at, r * 0.6f, color);
    draw->AddCircle(at, r, color, 24, 1.5f * s);
    const std::string number = std::to_string(handle.light + 1);
    draw->AddText(ImVec2(at.x + r + 2 * s, at.y - ImGui::GetTextLineHeight() / 2), color,
                  number.c_str());
  }
}

void App::dragLight(glm::dvec2 mouse) {
  const Model& model = *session_.model;
  const Camera& camera = shownResult_.a->list.camera;
  std::vector<Light> lights = shownLights(&model.scene, session_.document.a);
  if (draggedLight_->light >= lights.size()) return;
  Light& light = lights[draggedLight_->light];
  const Ray ray = rayThrough(camera, mouse, resolution_);
  if (draggedLight_->aim) {
    const auto hit = hitAt(mouse);
    const double reach = glm::length(model.bounds.center - light.position);
    const double ahead = glm::dot(model.bounds.center - ray.origin, ray.direction);
    const glm::dvec3 at = hit ? hit->position : ray.origin + ray.direction * ahead;
    const glm::dvec3 way = at - light.position;
    if (glm::length(way) > 1e-9 * reach) light.direction = tidyVector(glm::normalize(way));
  } else if (hasPlace(light)) {
    // In the plane through the light that faces the camera.
    const glm::dvec3 ahead = -camera.axes[2];
    const double along = glm::dot(ray.direction, ahead);
    const double t = glm::dot(light.position - ray.origin, ahead) / along;
    const glm::dvec3 moved = ray.origin + ray.direction * t;
    const double step =
        std::pow(10.0, std::floor(std::log10(std::max(model.bounds.radius, 1e-30))) - 3);
    light.position = glm::round(moved / step) * step;
  } else {
    const auto center = placeOf(model.bounds.center);
    const auto rim = placeOf(model.bounds.center + camera.axes[0] * model.bounds.radius);
    if (!center || !rim) return;
    const double radius = std::max(1.0, glm::length(*rim - *center));
    const glm::dvec2 pixel = mouse / ratio_ + glm::dvec2(0, double(menuHeight_));
    glm::dvec2 off = (pixel - *center) / radius * glm::dvec2(1, -1);
    const double r = glm::length(off);
    if (r > 1) off /= r;
    const double z = std::sqrt(std::max(0.0, 1 - glm::dot(off, off)));
    // A drag past the rim continues on the other side.
    if (r > 1) draggedLight_->behind = !wasBeyond_ ? !draggedLight_->behind : draggedLight_->behind;
    wasBeyond_ = r > 1;
    const glm::dvec3 eye(off, draggedLight_->behind ? -z : z);
    light.direction = tidyVector(light.type == Light::Type::camera ? eye : camera.axes * eye);
  }
  const std::string became =
      setLights(session_.document.a, &model.scene, model.bounds, std::move(lights));
  if (!became.empty()) session_.say(became);
}

}  // namespace glint::viewer
