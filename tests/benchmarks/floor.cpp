// The lower limit for a cold picture: a bare program with the same target, encode and PNG settings
// as `glint render` and nothing else. cold.py compares glint with it, and the framebuffer path was
// chosen by it.
//
//   floor OUT.png [key=value ...]
//     backend=osmesa|egl   size=1024   samples=1|4   bands=1   triangles=4000
//     heap=none|keep|huge  (glibc settings: defaults; keep freed memory; also use huge pages)
//     print=1              (milliseconds of each step)
//     frames=1             (if larger: prints the steady state's median)
//     format=float|rgba8   (rgba8: the driver's own rounding; only to measure the cost of a float
//     target)
#include <dlfcn.h>
#include <glad/egl.h>
#include <glad/gl.h>
#include <malloc.h>
#include <spng.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace {

double now() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

void adviseHeap(const std::string& mode) {
  if (mode == "none") return;
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_ARENA_MAX, 1);
  if (mode != "huge") return;
  const std::size_t block = std::size_t(256) << 20;
  mallopt(M_TOP_PAD, int(block));
  void* volatile grown = std::malloc(std::size_t(1) << 20);  // grows the heap by the block
  std::free(grown);
  const std::uintptr_t page = 2 << 20, end = std::uintptr_t(sbrk(0));
  const std::uintptr_t begin = (end - block + page - 1) / page * page;
  madvise(reinterpret_cast<void*>(begin), (end - begin) / page * page, MADV_HUGEPAGE);
}

void* library(const char* name) {
  void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (!handle) std::exit((std::fprintf(stderr, "floor: %s\n", dlerror()), 3));
  return handle;
}

void openOsmesa() {
  using Create = void* (*)(const int*, void*);
  using MakeCurrent = unsigned char (*)(void*, void*, unsigned, int, int);
  void* lib = library("libOSMesa.so.8");
  const auto create = Create(dlsym(lib, "OSMesaCreateContextAttribs"));
  const auto makeCurrent = MakeCurrent(dlsym(lib, "OSMesaMakeCurrent"));
  const int attributes[] = {0x22, GL_RGBA, 0x33, 0x34, 0x36, 3, 0x37, 3, 0};
  void* context = create(attributes, nullptr);
  static char pixels[4 * 4 * 4];
  makeCurrent(context, pixels, GL_UNSIGNED_BYTE, 4, 4);
  glint_gladLoadGL(GLADloadfunc(dlsym(lib, "OSMesaGetProcAddress")));
}

void openEgl() {
  void* lib = library("libEGL.so.1");
  const auto load = GLADloadfunc(dlsym(lib, "eglGetProcAddress"));
  const auto getDisplay = PFNEGLGETPLATFORMDISPLAYEXTPROC(load("eglGetPlatformDisplayEXT"));
  eglInitialize = PFNEGLINITIALIZEPROC(dlsym(lib, "eglInitialize"));
  const EGLDisplay display =
      getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  eglInitialize(display, nullptr, nullptr);
  glint_gladLoadEGL(display, load);
  eglBindAPI(EGL_OPENGL_API);
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  const EGLContext context =
      eglCreateContext(display, EGLConfig(nullptr), EGL_NO_CONTEXT, attributes);
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  glint_gladLoadGL(load);
}

const char* const vertexSource = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform vec2 band;  // scale and offset of y
out vec3 normal;
out vec3 eye;
void main() {
  normal = position;
  eye = position - vec3(0, 0, 3);
  gl_Position = vec4(eye.xy * 3.0, 0.5 - eye.z * 0.1, -eye.z);
  gl_Position.y = gl_Position.y * band.x + gl_Position.w * band.y;
})";
const char* const fragmentSource = R"(#version 330 core
in vec3 normal;
in vec3 eye;
out vec4 color;
void main() {
  vec3 n = normal / sqrt(dot(normal, normal)), v = -eye / sqrt(dot(eye, eye));
  vec3 l = vec3(-0.38, 0.53, 0.76), h = l + v;
  h /= sqrt(dot(h, h));
  float nl = dot(n, l);
  vec3 c = vec3(0.8, 0.2, 0.1);
  vec3 sum = 0.1 * c;
  if (nl > 0.0) sum += c * nl + pow(max(dot(n, h), 0.0), 160.0);
  color = vec4(sum, 1.0);
})";

GLuint makeProgram() {
  const GLuint program = glCreateProgram();
  for (auto [stage, source] :
       {std::pair{GL_VERTEX_SHADER, vertexSource}, std::pair{GL_FRAGMENT_SHADER, fragmentSource}}) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
  }
  glLinkProgram(program);
  return program;
}

int makeSphere(int triangles) {
  const int n = std::max(2, int(std::sqrt(triangles / 4.0))), m = 2 * n;
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      const double t = M_PI * j / n, p = 2 * M_PI * i / m;
      for (double x : {std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p)})
        positions.push_back(float(x));
      const std::uint32_t a = j * (m + 1) + i, b = a + m + 1;
      if (j < n && i < m) indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  GLuint names[2], array;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(2, names);
  glBindBuffer(GL_ARRAY_BUFFER, names[0]);
  glBufferData(GL_ARRAY_BUFFER, positions.size() * 4, positions.data(), GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 12, nullptr);
  glEnableVertexAttribArray(0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, names[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, indices.size() * 4, indices.data(), GL_STATIC_DRAW);
  return int(indices.size());
}

GLuint makeFramebuffer(int width, int height, int samples, bool floats) {
  GLuint framebuffer, buffers[2];
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenRenderbuffers(2, buffers);
  const GLenum formats[] = {GLenum(floats ? GL_RGBA32F : GL_RGBA8), GL_DEPTH_COMPONENT32F};
  for (int i = 0; i < 2; ++i) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, formats[i], width,
                                     height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                              GL_RENDERBUFFER, buffers[i]);
  }
  return framebuffer;
}

// Encodes one channel value with thresholds, by the same table search as glint.
struct Encoder {
  float thresholds[257];
  std::uint8_t buckets[14 * 128];
  Encoder() {
    for (int k = 1; k < 256; ++k) {
      const double s = (k - 0.5) / 255;
      thresholds[k] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    thresholds[256] = INFINITY;
    for (std::uint32_t i = 0; i < sizeof buckets; ++i) {
      const std::uint32_t bits = ((127 - 13) << 23) + (i << 16);
      float x;
      std::memcpy(&x, &bits, 4);
      int k = 0;
      while (k < 255 && thresholds[k + 1] <= x) ++k;
      buckets[i] = std::uint8_t(k);
    }
  }
  std::uint8_t operator()(float x) const {
    if (!(x >= thresholds[1])) return 0;
    if (x >= 1) return 255;
    std::uint32_t bits;
    std::memcpy(&bits, &x, 4);
    const int k = buckets[(bits - ((127 - 13) << 23)) >> 16];
    return std::uint8_t(k + (x >= thresholds[k + 1]));
  }
};

void encodeRows(const Encoder& encode, const float* from, std::uint8_t* to, int width, int rows) {
  auto work = [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* in = from + std::size_t(4) * width * (rows - 1 - y);
      std::uint8_t* out = to + std::size_t(3) * width * y;
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) out[3 * x + c] = encode(in[4 * x + c]);
    }
  };
  std::thread other(work, 0, rows / 2);
  work(rows / 2, rows);
  other.join();
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> o{
      {"backend", "osmesa"}, {"size", "1024"},      {"samples", "1"},
      {"bands", "1"},        {"triangles", "4000"}, {"heap", "huge"},
      {"frames", "1"},       {"format", "float"},   {"level", "1"}};
  for (int i = 2; i < argc; ++i) {
    const std::string a = argv[i];
    o[a.substr(0, a.find('='))] = a.substr(a.find('=') + 1);
  }
  const int size = std::stoi(o["size"]), samples = std::stoi(o["samples"]),
            bands = std::stoi(o["bands"]), rows = size / bands, frames = std::stoi(o["frames"]);
  const bool floats = o["format"] == "float";
  double t[8] = {now()};
  adviseHeap(o["heap"]);
  o["backend"] == "egl" ? openEgl() : openOsmesa();
  t[1] = now();
  const int indices = makeSphere(std::stoi(o["triangles"]));
  const GLuint program = makeProgram();
  glUseProgram(program);
  t[2] = now();
  const GLuint resolved = makeFramebuffer(size, rows, 1, floats);
  const GLuint target = samples > 1 ? makeFramebuffer(size, rows, samples, floats) : resolved;
  const double tfb = now();
  const Encoder encode;
  std::vector<float> values(floats ? std::size_t(4) * size * rows : 0);
  std::vector<std::uint8_t> bytes(floats ? 0 : std::size_t(4) * size * rows);
  std::vector<std::uint8_t> codes(std::size_t(3) * size * size);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glViewport(0, 0, size, rows);
  const double tvec = now();
  std::vector<double> times;
  double draw = 0, read = 0, code = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double start = now();
    for (int band = 0; band < bands; ++band) {
      const double t0 = now();
      glBindFramebuffer(GL_FRAMEBUFFER, target);
      glUniform2f(glGetUniformLocation(program, "band"), float(bands),
                  float(-(bands - 1) + 2 * band));
      glClearColor(0.033f, 0.033f, 0.033f, 1);
      glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      glDrawElements(GL_TRIANGLES, indices, GL_UNSIGNED_INT, nullptr);
      if (samples > 1) {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
        glBlitFramebuffer(0, 0, size, rows, 0, 0, size, rows, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved);
      }
      if (frame || frames == 1) glFinish();
      const double t1 = now();
      if (floats)
        glReadPixels(0, 0, size, rows, GL_RGBA, GL_FLOAT, values.data());
      else
        glReadPixels(0, 0, size, rows, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
      const double t2 = now();
      std::uint8_t* out = codes.data() + std::size_t(3) * size * rows * (bands - 1 - band);
      if (floats)
        encodeRows(encode, values.data(), out, size, rows);
      else
        for (std::size_t i = 0; i < bytes.size() / 4; ++i)
          std::memcpy(out + 3 * i, &bytes[4 * i], 3);
      draw += t1 - t0, read += t2 - t1, code += now() - t2;
    }
    times.push_back(now() - start);
  }
  t[3] = now();
  spng_ctx* png = spng_ctx_new(SPNG_CTX_ENCODER);
  std::FILE* file = std::fopen(argv[1], "wb");
  spng_set_png_file(png, file);
  spng_ihdr header{std::uint32_t(size), std::uint32_t(size), 8, SPNG_COLOR_TYPE_TRUECOLOR, 0, 0, 0};
  spng_set_ihdr(png, &header);
  spng_set_option(png, SPNG_IMG_COMPRESSION_LEVEL, std::stoi(o["level"]));
  spng_set_option(png, SPNG_FILTER_CHOICE, SPNG_DISABLE_FILTERING);
  spng_encode_image(png, codes.data(), codes.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  std::fclose(file);
  t[4] = now();
  if (frames > 1) {
    std::sort(times.begin(), times.end());
    std::printf("frame %.2f ms\n", times[times.size() / 2]);
  } else if (o.count("print")) {
    std::printf(
        "context %.1f mesh+program %.1f framebuffer %.1f buffers %.1f draw %.1f read %.1f "
        "encode %.1f png %.1f total %.1f\n",
        t[1] - t[0], t[2] - t[1], tfb - t[2], tvec - tfb, draw, read, code, t[4] - t[3],
        t[4] - t[0]);
  }
  std::fflush(stdout);
  std::_Exit(0);
}
