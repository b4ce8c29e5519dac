// A libFuzzer target for the glTF loader, not part of the build. With clang, from the root, after a
// configured build (for the include folders) in build/dev:
//
//   clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -Ibuild/dev/include/scene \
//     -Ibuild/dev/include/image tests/fuzz/gltf_fuzz.cpp src/scene/gltf*.cpp -ltinygltf -o
//     gltf_fuzz
//   ./gltf_fuzz -max_len=100000 CORPUS     (a folder of small .gltf and .glb files)
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("model", MFD_CLOEXEC);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) __builtin_trap();
  try {
    const glint::Scene scene = glint::loadGltf("/proc/self/fd/" + std::to_string(file));
    for (const glint::Mesh& mesh : scene.meshes) {
      for (const auto index : mesh.indices) {
        if (index >= mesh.positions.size()) __builtin_trap();
      }
    }
  } catch (const glint::InputError&) {
    // Refusing is fine; crashing, hanging and any other exception are not.
  }
  close(file);
  return 0;
}
