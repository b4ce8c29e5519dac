#include "glint/render/gpu_scene.h"

#include <algorithm>
#include <span>
#include <utility>

#include "glint/image/mipmaps.h"
#include "glint/render/face_mesh.h"
#include "glint/render/variant.h"

namespace glint {
namespace {

// Gathers attribute arrays one after the other in a single buffer, then points a vertex array at
// it.
class VertexLayout {
 public:
  template <typename Vector>
  void add(GLuint location, std::span<const Vector> values) {
    if (values.empty()) return;
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    attributes_.push_back({location, Vector::length(), bytes, values.size_bytes(), size_});
    size_ += values.size_bytes();
  }
  // With `source`, vertex i is a copy of source[i].
  template <typename Vector>
  void add(GLuint location, std::span<const Vector> values, std::span<const std::uint32_t> source) {
    if (values.empty() || source.empty()) return add(location, values);
    std::vector<char>& copy = copies_.emplace_back(source.size() * sizeof(Vector));
    auto* to = reinterpret_cast<Vector*>(copy.data());
    for (std::size_t i = 0; i < source.size(); ++i) to[i] = values[source[i]];
    add(location, std::span<const Vector>(to, source.size()));
  }
  void upload() const {
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(size_), nullptr, GL_STATIC_DRAW);
    for (const Attribute& a : attributes_) {
      glBufferSubData(GL_ARRAY_BUFFER, GLintptr(a.offset), GLsizeiptr(a.size), a.bytes);
      glVertexAttribPointer(a.location, a.components, GL_FLOAT, GL_FALSE, 0,
                            reinterpret_cast<const void*>(a.offset));
      glEnableVertexAttribArray(a.location);
    }
  }

 private:
  struct Attribute {
    GLuint location;
    GLint components;
    const char* bytes;
    std::size_t size, offset;
  };
  std::vector<Attribute> attributes_;
  std::vector<std::vector<char>> copies_;
  std::size_t size_ = 0;
};

// The coordinates by which a texture is looked up, with its transform.
std::vector<glm::vec2> texcoordsOf(const Mesh& mesh, const Texture& texture) {
  if (std::size_t(texture.texcoord) >= mesh.texcoords.size()) return {};
  std::vector<glm::vec2> places = mesh.texcoords[std::size_t(texture.texcoord)];
  if (texture.transform != glm::dmat3x2(1.0))
    for (glm::vec2& place : places) place = glm::vec2(texture.transform * glm::dvec3(place, 1));
  return places;
}

std::vector<glm::vec2> texcoordsOf(const Mesh& mesh, const std::optional<Texture>& texture) {
  return texture ? texcoordsOf(mesh, *texture) : std::vector<glm::vec2>();
}

// Those of the faces' centroids, at the vertices that carry the faces.
std::vector<glm::vec2> centralPlaces(const FaceMesh& faces, const std::vector<glm::vec2>& places) {
  std::vector<glm::vec2> central(places.empty() ? 0 : faces.source.size());
  for (std::size_t i = 0; !places.empty() && i + 2 < faces.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return glm::dvec2(places[faces.source[faces.indices[i + k]]]);
    };
    central[faces.indices[i + 2]] = glm::vec2((at(0) + at(1) + at(2)) / 3.0);
  }
  return central;
}

GLenum modeOf(Topology topology) {
  return topology == Topology::points  ? GL_POINTS
         : topology == Topology::lines ? GL_LINES
                                       : GL_TRIANGLES;
}

// What a driver cannot take is left out from the pyramid's top. False where nothing was.
bool fitDriver(DecodedImage& decoded, bool isData) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  const auto fits = [&] { return std::max(decoded.image.width, decoded.image.height) <= limit; };
  if (fits()) return false;
  const bool hadLevels = !decoded.mipLevels.empty();
  if (!hadLevels) decoded.mipLevels = mipLevels(decoded.image, isData);
  while (!fits()) {
    decoded.image = std::move(decoded.mipLevels.front());
    decoded.mipLevels.erase(decoded.mipLevels.begin());
  }
  if (!hadLevels) decoded.mipLevels.clear();
  return true;
}

// Codes as they are: glsl/texture.glsl makes values of them.
TextureHandle uploadTexture(const DecodedImage& decoded) {
  TextureHandle texture = TextureHandle::make();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const auto upload = [&](GLint level, const ByteImage& from) {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, from.width, from.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, from.values.data());
  };
  // From the smallest on, by which the driver guesses the whole pyramid's size: from the largest
  // on, it would reserve that alone, and then everything again.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, GLint(decoded.mipLevels.size()));
  for (std::size_t i = decoded.mipLevels.size(); i > 0; --i)
    upload(GLint(i), decoded.mipLevels[i - 1]);
  upload(0, decoded.image);
  // Texels are fetched one by one; with another filter drivers may take the texture for incomplete.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  return texture;
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, DecodedImages images)
    : scene_(&scene), images_(std::move(images)) {}

void GpuScene::pose(const Scene& scene, std::span<const int> changed) {
  scene_ = &scene;
  for (const int mesh : changed) {
    geometries_.erase({mesh, false});
    geometries_.erase({mesh, true});
  }
}

const GpuScene::Geometry& GpuScene::geometry(int index, bool faces) {
  const Mesh& mesh = scene_->meshes[std::size_t(index)];
  faces = faces && mesh.topology == Topology::triangles;
  const auto [place, isNew] = geometries_.try_emplace({index, faces});
  Geometry& g = place->second;
  if (!isNew) return g;

  g.array = VertexArray::make();
  g.vertices = Buffer::make();
  g.indices = Buffer::make();
  glBindVertexArray(g.array.id());
  glBindBuffer(GL_ARRAY_BUFFER, g.vertices.id());
  const FaceMesh faceMesh = faces ? makeFaceMesh(mesh) : FaceMesh{};
  const std::span<const std::uint32_t> source = faceMesh.source;
  const Material& material = scene_->materials[std::size_t(mesh.material)];
  VertexLayout layout;
  layout.add(0, std::span(mesh.positions), source);
  layout.add(1, faces ? std::span(faceMesh.normals) : std::span(mesh.normals));
  layout.add(2, std::span(mesh.colors), source);
  const auto colorPlaces = texcoordsOf(mesh, material.colorTexture);
  const auto emissionPlaces = texcoordsOf(mesh, material.emissionTexture);
  const auto normalPlaces = texcoordsOf(mesh, material.normalTexture);
  layout.add(3, std::span(colorPlaces), source);
  layout.add(4, std::span(emissionPlaces), source);
  if (!faces && !mesh.tangents.empty()) {
    layout.add(6, std::span(mesh.tangents));
    layout.add(7, std::span(normalPlaces));
  }
  std::vector<std::vector<glm::vec2>> parameterTexcoords;
  for (const Texture* looked : parameterPlaces(material)) {
    const auto places = texcoordsOf(mesh, *looked);
    parameterTexcoords.push_back(faces ? centralPlaces(faceMesh, places) : places);
  }
  for (std::size_t i = 0; i < parameterTexcoords.size(); ++i)
    layout.add(GLuint(8 + i), std::span(std::as_const(parameterTexcoords[i])));
  if (faces) layout.add(5, std::span(faceMesh.centers));
  // Points and lines have no faces: of a line the last vertex counts for flat shading.
  if (mesh.topology != Topology::triangles && !mesh.normals.empty())
    layout.add(5, std::span(mesh.positions));
  layout.upload();
  const auto& indices = faces ? faceMesh.indices : mesh.indices;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g.indices.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof indices[0]),
               indices.data(), GL_STATIC_DRAW);
  g.mode = modeOf(mesh.topology);
  g.count = GLsizei(indices.size());
  return g;
}

void GpuScene::draw(int mesh, bool faces) {
  const Geometry& g = geometry(mesh, faces);
  glBindVertexArray(g.array.id());
  glDrawElements(g.mode, g.count, GL_UNSIGNED_INT, nullptr);
}

void GpuScene::bindTexture(const Texture& use, GLuint unit) {
  glActiveTexture(GL_TEXTURE0 + unit);
  TextureHandle& texture = textures_[use.image];
  if (!texture) {
    const EncodedImage& image = scene_->images[std::size_t(use.image)];
    DecodedImage& decoded = images_.at(use.image);
    if (fitDriver(decoded, image.isData))
      warnings_.push_back("the image " + image.name +
                          " is larger than this driver takes, and is "
                          "shown with " +
                          std::to_string(decoded.image.width) + " x " +
                          std::to_string(decoded.image.height) + " pixels");
    if (decoded.mipLevels.empty() && readsMipLevels(*scene_, use.image))
      decoded.mipLevels = mipLevels(decoded.image, image.isData);
    texture = uploadTexture(decoded);
    images_.erase(use.image);
  }
  glBindTexture(GL_TEXTURE_2D, texture.id());
}

}  // namespace glint
