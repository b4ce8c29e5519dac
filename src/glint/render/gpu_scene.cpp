#include "glint/render/gpu_scene.h"

#include <algorithm>
#include <deque>
#include <span>
#include <utility>

#include "glint/gl/context.h"
#include "glint/image/mipmaps.h"
#include "glint/render/face_mesh.h"
#include "glint/render/variant.h"

namespace glint {
namespace {

// Shorter arrays are copied: a separate buffer costs more.
constexpr std::size_t leastInPlace = std::size_t(1) << 20;  // bytes

// Makes the driver read a buffer from the program's own memory.
void setInPlace(const Buffer& buffer, const void* bytes, std::size_t size) {
  glBindBuffer(GL_EXTERNAL_VIRTUAL_MEMORY_BUFFER_AMD, buffer.id());
  glBufferData(GL_EXTERNAL_VIRTUAL_MEMORY_BUFFER_AMD, GLsizeiptr(size), bytes, GL_STATIC_DRAW);
  glBindBuffer(GL_EXTERNAL_VIRTUAL_MEMORY_BUFFER_AMD, 0);
}

// Gathers attribute arrays one after the other in a single buffer, then points a vertex array at
// them. Each long array that the scene keeps gets a buffer that lies in the scene's memory instead.
class VertexLayout {
 public:
  explicit VertexLayout(bool inPlace) : inPlace_(inPlace) {}

  /// An array of the scene.
  template <typename Vector>
  void addKept(GLuint location, const std::vector<Vector>& values,
               std::span<const std::uint32_t> source = {}) {
    addBytes(location, values, source, true);
  }
  /// An array that lives until upload().
  template <typename Vector>
  void add(GLuint location, const std::vector<Vector>& values,
           std::span<const std::uint32_t> source = {}) {
    addBytes(location, values, source, false);
  }
  std::vector<Buffer> upload() const {
    std::vector<Buffer> buffers;
    if (size_ > 0) {
      glBindBuffer(GL_ARRAY_BUFFER, buffers.emplace_back(Buffer::make()).id());
      glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(size_), nullptr, GL_STATIC_DRAW);
      for (const Attribute& a : attributes_) {
        if (a.inPlace) continue;
        glBufferSubData(GL_ARRAY_BUFFER, GLintptr(a.offset), GLsizeiptr(a.size), a.bytes);
        point(a);
      }
    }
    for (const Attribute& a : attributes_) {
      if (!a.inPlace) continue;
      const Buffer& own = buffers.emplace_back(Buffer::make());
      setInPlace(own, a.bytes, a.size);
      glBindBuffer(GL_ARRAY_BUFFER, own.id());
      point(a);
    }
    return buffers;
  }

 private:
  struct Attribute {
    GLuint location;
    GLint components;
    const void* bytes;
    std::size_t size, offset;
    bool inPlace;
  };
  // With `source`, vertex i is a copy of source[i].
  template <typename Vector>
  void addBytes(GLuint location, const std::vector<Vector>& values,
                std::span<const std::uint32_t> source, bool isKept) {
    if (values.empty()) return;
    const void* bytes = values.data();
    std::size_t size = values.size() * sizeof(Vector);
    if (!source.empty()) {
      std::vector<char>& copy = copies_.emplace_back(source.size() * sizeof(Vector));
      auto* to = reinterpret_cast<Vector*>(copy.data());
      for (std::size_t i = 0; i < source.size(); ++i) to[i] = values[source[i]];
      bytes = copy.data();
      size = copy.size();
    }
    const bool inPlace = inPlace_ && isKept && source.empty() && size >= leastInPlace;
    attributes_.push_back({location, Vector::length(), bytes, size, inPlace ? 0 : size_, inPlace});
    if (!inPlace) size_ += size;
  }
  static void point(const Attribute& a) {
    glVertexAttribPointer(a.location, a.components, GL_FLOAT, GL_FALSE, 0,
                          reinterpret_cast<const void*>(a.offset));
    glEnableVertexAttribArray(a.location);
  }

  bool inPlace_;
  std::vector<Attribute> attributes_;
  std::vector<std::vector<char>> copies_;
  std::size_t size_ = 0;
};

// The mesh's coordinates for a texture, before the texture's transform; null if it has none.
const std::vector<glm::vec2>* plainTexcoords(const Mesh& mesh, const Texture& texture) {
  const auto set = std::size_t(texture.texcoord);
  return set < mesh.texcoords.size() && !mesh.texcoords[set].empty() ? &mesh.texcoords[set]
                                                                     : nullptr;
}

bool transforms(const Texture& texture) { return texture.transform != glm::dmat3x2(1.0); }

std::vector<glm::vec2> texcoordsOf(const Mesh& mesh, const Texture& texture) {
  const auto* const plain = plainTexcoords(mesh, texture);
  if (!plain) return {};
  std::vector<glm::vec2> places = *plain;
  if (transforms(texture))
    for (glm::vec2& place : places) place = glm::vec2(texture.transform * glm::dvec3(place, 1));
  return places;
}

// The coordinates of the faces' centroids, at the vertices that carry the faces.
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

// Drops the levels that are too large for the driver. False if none was dropped.
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

// Uploads the codes unchanged: glsl/texture.glsl decodes them.
TextureHandle uploadTexture(const DecodedImage& decoded) {
  TextureHandle texture = TextureHandle::make();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const auto upload = [&](GLint level, const ByteImage& from) {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, from.width, from.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, from.values.data());
  };
  // Smallest level first: the driver guesses the size of the whole pyramid from the first upload.
  // Given the largest first, it would allocate only that level, and later all of them again.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, GLint(decoded.mipLevels.size()));
  for (std::size_t i = decoded.mipLevels.size(); i > 0; --i)
    upload(GLint(i), decoded.mipLevels[i - 1]);
  upload(0, decoded.image);
  // Texels are fetched one by one; with other filters drivers may consider the texture incomplete.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  return texture;
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, DecodedImages images)
    : scene_(&scene), inPlace_(drawsFromOwnMemory()), images_(std::move(images)) {}

GpuScene::GpuScene(const Scene& scene, GpuScene& textures)
    : scene_(&scene), inPlace_(drawsFromOwnMemory()), shared_(&textures) {}

void GpuScene::pose(const Scene& scene, std::span<const int> changed) {
  scene_ = &scene;
  for (const int mesh : changed) {
    geometries_.erase({mesh, false});
    geometries_.erase({mesh, true});
  }
  // Meshes that have moved in memory are no longer where the driver reads them.
  std::erase_if(geometries_, [&](const auto& entry) {
    const void* const place = entry.second.inPlace;
    return place && place != scene.meshes[std::size_t(entry.first.first)].positions.data();
  });
}

const GpuScene::Geometry& GpuScene::geometry(int index, bool faces) {
  const Mesh& mesh = scene_->meshes[std::size_t(index)];
  faces = faces && mesh.topology == Topology::triangles;
  const auto [place, isNew] = geometries_.try_emplace({index, faces});
  Geometry& g = place->second;
  if (!isNew) return g;

  g.array = VertexArray::make();
  g.indices = Buffer::make();
  glBindVertexArray(g.array.id());
  const FaceMesh faceMesh = faces ? makeFaceMesh(mesh) : FaceMesh{};
  const std::span<const std::uint32_t> source = faceMesh.source;
  const Material& material = scene_->materials[std::size_t(mesh.material)];
  VertexLayout layout(inPlace_);
  layout.addKept(0, mesh.positions, source);
  if (faces)
    layout.add(1, faceMesh.normals);
  else
    layout.addKept(1, mesh.normals);
  layout.addKept(2, mesh.colors, source);
  std::deque<std::vector<glm::vec2>> made;  // does not move its elements
  const auto addTexcoords = [&](GLuint location, const std::optional<Texture>& texture) {
    if (!texture) return;
    if (transforms(*texture))
      layout.add(location, made.emplace_back(texcoordsOf(mesh, *texture)), source);
    else if (const auto* const plain = plainTexcoords(mesh, *texture))
      layout.addKept(location, *plain, source);
  };
  addTexcoords(3, material.colorTexture);
  addTexcoords(4, material.emissionTexture);
  if (!faces && !mesh.tangents.empty()) {
    layout.addKept(6, mesh.tangents);
    addTexcoords(7, material.normalTexture);
  }
  GLuint location = 8;
  for (const Texture* looked : parameterPlaces(material)) {
    if (faces)
      layout.add(location, made.emplace_back(centralPlaces(faceMesh, texcoordsOf(mesh, *looked))));
    else
      addTexcoords(location, *looked);
    ++location;
  }
  if (faces) layout.add(5, faceMesh.centers);
  // Points and lines have no faces: flat shading uses a line's last vertex.
  if (mesh.topology != Topology::triangles && !mesh.normals.empty())
    layout.addKept(5, mesh.positions);
  g.vertices = layout.upload();
  const auto& indices = faces ? faceMesh.indices : mesh.indices;
  const std::size_t indexBytes = indices.size() * sizeof indices[0];
  const bool indicesInPlace = inPlace_ && !faces && indexBytes >= leastInPlace;
  if (indicesInPlace) setInPlace(g.indices, indices.data(), indexBytes);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g.indices.id());
  if (!indicesInPlace)
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indexBytes), indices.data(), GL_STATIC_DRAW);
  if (inPlace_) g.inPlace = mesh.positions.data();
  g.mode = modeOf(mesh.topology);
  g.count = GLsizei(indices.size());
  // Faces are the same triangles, each perhaps starting at another corner.
  if (mesh.topology == Topology::triangles) g.runs = makeTriangleRuns(mesh);
  return g;
}

void GpuScene::draw(int mesh, bool faces, std::size_t times, const Buffer* indices) {
  const Geometry& g = geometry(mesh, faces);
  glBindVertexArray(g.array.id());
  if (indices) glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices->id());
  if (times == 1)
    glDrawElements(g.mode, g.count, GL_UNSIGNED_INT, nullptr);
  else
    glDrawElementsInstanced(g.mode, g.count, GL_UNSIGNED_INT, nullptr, GLsizei(times));
  if (indices) glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g.indices.id());
  queue_.drawn(std::size_t(g.count) * times);
}

bool GpuScene::findShown(int mesh, bool faces, const RunView& view) {
  firsts_.clear();
  counts_.clear();
  appendShown(geometry(mesh, faces).runs, view, firsts_, counts_);
  return !counts_.empty();
}

void GpuScene::drawShown(int mesh, bool faces) {
  const Geometry& g = geometry(mesh, faces);
  glBindVertexArray(g.array.id());
  std::vector<const void*> offsets;
  std::vector<GLsizei> counts;
  std::size_t room = queue_.room(), sum = 0;
  const auto drawPortion = [&] {
    glMultiDrawElements(g.mode, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                        GLsizei(counts.size()));
    queue_.drawn(sum);
    offsets.clear();
    counts.clear();
    room = queue_.room();
    sum = 0;
  };
  for (std::size_t i = 0; i < firsts_.size(); ++i) {
    std::size_t first = firsts_[i], left = std::size_t(counts_[i]);
    while (left > 0) {
      const std::size_t count = std::min(left, room - sum);
      offsets.push_back(reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
      counts.push_back(GLsizei(count));
      first += count;
      left -= count;
      sum += count;
      if (sum == room) drawPortion();
    }
  }
  if (sum > 0) drawPortion();
}

void GpuScene::bindTexture(const Texture& use, GLuint unit) {
  if (shared_) return shared_->bindTexture(use, unit);
  glActiveTexture(GL_TEXTURE0 + unit);
  Uploaded& uploaded = textures_[use.image];
  if (!uploaded.texture) {
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
    uploaded = {uploadTexture(decoded), decoded.hasNormalLengths};
    images_.erase(use.image);
  }
  glBindTexture(GL_TEXTURE_2D, uploaded.texture.id());
}

bool GpuScene::hasImage(int image, bool withNormalLengths) const {
  if (const auto decoded = images_.find(image); decoded != images_.end())
    return decoded->second.hasNormalLengths >= withNormalLengths;
  if (const auto known = textures_.find(image); known != textures_.end())
    return known->second.hasNormalLengths >= withNormalLengths;
  return shared_ && shared_->hasImage(image, withNormalLengths);
}

void GpuScene::addImages(DecodedImages&& images) {
  for (auto& [image, decoded] : images) {
    textures_.erase(image);
    images_.insert_or_assign(image, std::move(decoded));
  }
}

}  // namespace glint
