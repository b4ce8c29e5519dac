#include "glint/render/probe.h"

#include <glad/gl.h>

#include <algorithm>
#include <regex>

#include "glint/gl/check.h"
#include "glint/gl/handles.h"
#include "glint/gl/program.h"
#include "glint/image/error.h"

namespace glint {
namespace {

// Evaluations of a batch: few enough that inputs and results stay in the caches of a CPU.
constexpr int targetWidth = 1024, targetHeight = 256;

constexpr const char* vertexText = R"(#version 330 core
void main() {  // one triangle that covers the target
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

/// The floats in a float or vector type; 0 for any other name.
int floatsOf(const std::string& type) {
  if (type == "float") return 1;
  return type.size() == 4 && type.starts_with("vec") && type[3] >= '2' && type[3] <= '4'
             ? type[3] - '0'
             : 0;
}

/// The types of a struct's members, or the type itself for a float or vector. Empty if unknown.
std::vector<std::string> membersOf(const std::string& type, const std::string& files) {
  if (floatsOf(type) > 0) return {type};
  std::smatch match;
  std::vector<std::string> members;
  if (!std::regex_search(files, match, std::regex("struct\\s+" + type + "\\s*\\{([^}]*)\\}")))
    return {};
  // Without comments, "float e; vec3 a, b;": a type and names before each semicolon.
  const std::string body = std::regex_replace(match[1].str(), std::regex("//[^\n]*"), "");
  const std::regex member("(\\w+)\\s+(\\w+(?:\\s*,\\s*\\w+)*)\\s*;");
  for (std::sregex_iterator i(body.begin(), body.end(), member), end; i != end; ++i) {
    if (floatsOf((*i)[1]) == 0) return {};
    const std::string names = (*i)[2];
    members.insert(members.end(), 1 + std::size_t(std::ranges::count(names, ',')), (*i)[1]);
  }
  return members;
}

struct Prototype {
  std::string result, name;
  std::vector<std::string> arguments;  // their types
  bool hasBody = false;
};

Prototype parse(const std::string& text) {
  const std::regex form("^\\s*(\\w+)\\s+(\\w+)\\s*\\(([^)]*)\\)\\s*(\\{[\\s\\S]*)?$");
  std::smatch match;
  if (!std::regex_match(text, match, form))
    throw Error("probe: \"" + text + "\" is not a prototype: write it as \"float f(float, vec3)\"");
  Prototype prototype{match[1], match[2], {}, match[4].matched};
  const std::string list = match[3];
  const std::regex argument("(?:const\\s+|in\\s+)*(\\w+)[^,]*");
  for (std::sregex_iterator i(list.begin(), list.end(), argument), end; i != end; ++i)
    prototype.arguments.push_back((*i)[1]);
  if (floatsOf(prototype.result) == 0)
    throw Error("probe: " + prototype.name + " gives a " + prototype.result +
                ": only float, vec2, vec3 and vec4 can be read back");
  return prototype;
}

GLint limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

struct Probe::Function {
  Prototype prototype;
  std::vector<int> floats;  // of each argument
  int resultFloats = 1;
  Program program;
  GLint count = -1;  // uniform locations: of `count` and of the steps
  std::vector<GLint> steps;
};

/// A buffer that shaders read as floats.
struct InputColumn {
  Buffer buffer = Buffer::make();
  TextureHandle texture = TextureHandle::make();
};

struct Probe::Objects {
  VertexArray vertexArray = VertexArray::make();
  std::vector<InputColumn> inputs;
  // A target for each format, made when first needed.
  struct Target {
    Renderbuffer color;
    Framebuffer framebuffer;
    int rows = 0;
  } targets[3];
  int width = std::min(targetWidth, int(limit(GL_MAX_RENDERBUFFER_SIZE)));
  int maxRows = std::min(targetHeight, int(limit(GL_MAX_RENDERBUFFER_SIZE)));
  std::size_t maxFloats = std::size_t(limit(GL_MAX_TEXTURE_BUFFER_SIZE));
  std::vector<float> padded;  // three-float results as read back, padded to four

  void bindTarget(int floats, int rows);
};

namespace {

struct Format {
  GLenum internal, read;
};
/// The formats of targets that the results of 1, 2, and 3 or 4 floats are drawn into.
constexpr Format formats[3] = {{GL_R32F, GL_RED}, {GL_RG32F, GL_RG}, {GL_RGBA32F, GL_RGBA}};

int formatOf(int floats) { return std::min(floats, 3) - 1; }

}  // namespace

/// Binds a target of at least `rows` rows; targets never shrink.
void Probe::Objects::bindTarget(int floats, int rows) {
  Target& target = targets[formatOf(floats)];
  if (target.rows < rows) {
    target = Target{Renderbuffer::make(), Framebuffer::make(), rows};
    glBindRenderbuffer(GL_RENDERBUFFER, target.color.id());
    glRenderbufferStorage(GL_RENDERBUFFER, formats[formatOf(floats)].internal, width, rows);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              target.color.id());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      target = Target{};
      checkGl("probe");
      throw Error("probe: this driver draws into no target of " + std::to_string(floats) +
                  " floats");
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.id());
}

Probe::Probe(GlslSources sources, ProbeText text)
    : sources_(std::move(sources)), text_(std::move(text)), objects_(std::make_unique<Objects>()) {}
Probe::~Probe() = default;
Probe::Probe(Probe&&) noexcept = default;
Probe& Probe::operator=(Probe&&) noexcept = default;

std::unique_ptr<Probe::Function> Probe::compile(std::string_view text) const {
  auto function = std::make_unique<Function>();
  function->prototype = parse(std::string(text));
  const Prototype& prototype = function->prototype;
  function->resultFloats = floatsOf(prototype.result);

  const bool fileNames = fileNamesInLines();
  std::string files;
  for (const auto& [name, value] : text_.defines)
    files += "#define " + name + " " + std::to_string(value) + "\n";
  files += text_.text;
  int number = 0;
  for (const std::string& file : text_.files)
    files += "#line 1 " + (fileNames ? "\"" + file + "\"" : std::to_string(++number)) + "\n" +
             sources_.text(file);

  std::string body, call;
  for (std::size_t a = 0; a < prototype.arguments.size(); ++a) {
    const std::string& type = prototype.arguments[a];
    const std::vector<std::string> members = membersOf(type, files);
    if (members.empty())
      throw Error("probe: " + prototype.name + " takes a " + type +
                  ": arguments are float, vec2, vec3, vec4 and structs of them in the files");
    const std::string id = std::to_string(a);
    body += "uniform samplerBuffer column" + id + ";\nuniform int step" + id + ";\n";
    std::string value;
    int floats = 0;
    const auto fetch = [&] {
      return "texelFetch(column" + id + ", at" + id + " + " + std::to_string(floats++) + ").r";
    };
    for (const std::string& member : members) {
      value += value.empty() ? member + "(" : ", " + member + "(";
      for (int i = 0, n = floatsOf(member); i < n; ++i) value += (i ? ", " : "") + fetch();
      value += ")";
    }
    function->floats.push_back(floats);
    call += "  int at" + id + " = row * step" + id + ";\n  " + type + " argument" + id + " = " +
            type + "(" + value + ");\n";
  }
  call += "  " + prototype.result + " value = " + prototype.name + "(";
  for (std::size_t a = 0; a < prototype.arguments.size(); ++a)
    call += (a ? ", argument" : "argument") + std::to_string(a);
  const int padding = prototype.result == "vec3" ? 1 : 0;
  const std::string target =
      padding ? "vec4" : prototype.result;  // GL cannot draw into three floats
  call += ");\n  probeResult = " + (padding ? "vec4(value, 0.0)" : std::string("value")) + ";\n";

  std::string fragment = "#version 330 core\n";
  if (fileNames) fragment += "#extension GL_ARB_shading_language_include : enable\n";
  fragment += files;
  fragment += fileNames ? "#line 1 \"probe\"\n" : "#line 1 0\n";
  if (prototype.hasBody) fragment += std::string(text) + "\n";
  fragment += body + "uniform int count;\nlayout(location = 0) out " + target + " probeResult;\n" +
              "void main() {\n  int row = min(int(gl_FragCoord.y) * " +
              std::to_string(objects_->width) + " + int(gl_FragCoord.x), count - 1);\n" + call +
              "}\n";

  const ShaderSource stages[] = {{GL_VERTEX_SHADER, vertexText}, {GL_FRAGMENT_SHADER, fragment}};
  function->program = Program("probe " + prototype.name, stages);
  function->count = function->program.uniform("count");
  for (std::size_t a = 0; a < prototype.arguments.size(); ++a) {
    function->program.bindSampler(("column" + std::to_string(a)).c_str(), GLint(a));
    function->steps.push_back(function->program.uniform(("step" + std::to_string(a)).c_str()));
  }
  return function;
}

Probe::Function& Probe::function(std::string_view text) {
  auto found = functions_.find(text);
  if (found == functions_.end()) found = functions_.emplace(text, compile(text)).first;
  return *found->second;
}

namespace {

/// The number of rows that the columns have in common. Throws Error if there is no such number.
std::size_t commonRows(const std::string& name, const std::vector<int>& floats,
                       const std::vector<std::span<const float>>& columns) {
  if (columns.size() != floats.size())
    throw Error("probe: " + name + " takes " + std::to_string(floats.size()) + " columns, not " +
                std::to_string(columns.size()));
  std::size_t rows = 1;  // of all columns except those of a single row
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const std::size_t n = std::size_t(floats[a]), own = columns[a].size() / n;
    if (columns[a].size() % n != 0 || (own != 1 && rows != 1 && own != rows))
      throw Error("probe: column " + std::to_string(a + 1) + " of " + name + " has " +
                  std::to_string(columns[a].size()) + " floats: it takes " + std::to_string(n) +
                  " for each row, and as many rows as the columns before it");
    if (own != 1) rows = own;
  }
  return rows;
}

}  // namespace

std::vector<float> Probe::run(std::string_view text,
                              const std::vector<std::span<const float>>& columns) {
  const Function& f = function(text);
  std::vector<float> results(commonRows(f.prototype.name, f.floats, columns) *
                             std::size_t(f.resultFloats));
  run(text, columns, results);
  return results;
}

void Probe::run(std::string_view text, const std::vector<std::span<const float>>& columns,
                std::span<float> results) {
  const Function& f = function(text);
  const std::size_t rows = commonRows(f.prototype.name, f.floats, columns);
  const std::size_t resultFloats = std::size_t(f.resultFloats);
  if (results.size() != rows * resultFloats)
    throw Error("probe: " + f.prototype.name + " gives " + std::to_string(rows * resultFloats) +
                " floats, not " + std::to_string(results.size()));
  if (rows == 0) return;

  Objects& gl = *objects_;
  const std::size_t width = std::size_t(gl.width);
  std::size_t batch = width * std::size_t(gl.maxRows);
  for (int n : f.floats) batch = std::min(batch, gl.maxFloats / std::size_t(n));
  while (gl.inputs.size() < columns.size()) gl.inputs.emplace_back();

  for (GLenum state : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_MULTISAMPLE,
                       GL_STENCIL_TEST, GL_DITHER})
    glDisable(state);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindVertexArray(gl.vertexArray.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  f.program.use();

  for (std::size_t first = 0; first < rows; first += batch) {
    const std::size_t count = std::min(batch, rows - first);
    for (std::size_t a = 0; a < columns.size(); ++a) {
      const std::size_t n = std::size_t(f.floats[a]);
      const bool one = columns[a].size() == n;
      const std::span<const float> part =
          one ? columns[a] : columns[a].subspan(first * n, count * n);
      glBindBuffer(GL_TEXTURE_BUFFER, gl.inputs[a].buffer.id());
      glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(part.size_bytes()), part.data(), GL_STREAM_DRAW);
      glActiveTexture(GL_TEXTURE0 + GLenum(a));
      glBindTexture(GL_TEXTURE_BUFFER, gl.inputs[a].texture.id());
      glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, gl.inputs[a].buffer.id());
      glUniform1i(f.steps[a], one ? 0 : GLint(n));
    }
    glUniform1i(f.count, GLint(count));

    const int height = int((count + width - 1) / width);
    gl.bindTarget(f.resultFloats, height);
    glViewport(0, 0, gl.width, height);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    const GLenum format = formats[formatOf(f.resultFloats)].read;
    const std::size_t readFloats = resultFloats == 3 ? 4 : resultFloats;
    float* out = &results[first * resultFloats];
    if (resultFloats == 3) {
      gl.padded.resize(std::max(gl.padded.size(), count * readFloats));
      out = gl.padded.data();
    }
    const int fullRows = int(count / width), rest = int(count % width);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    if (fullRows > 0) glReadPixels(0, 0, gl.width, fullRows, format, GL_FLOAT, out);
    if (rest > 0)
      glReadPixels(0, fullRows, rest, 1, format, GL_FLOAT,
                   out + std::size_t(fullRows) * width * readFloats);
    if (resultFloats == 3)
      for (std::size_t i = 0; i < count; ++i)
        std::copy_n(&gl.padded[4 * i], 3, &results[3 * (first + i)]);
  }
  checkGl("probe");
}

}  // namespace glint
