// turntable MODEL COUNT NAME: writes NAME-0.png and so on, views of the model from all around.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "glint/compare.h"
#include "glint/glint.h"

int main(int argc, char** argv) try {
  const int count = argc == 4 ? std::atoi(argv[2]) : 0;
  if (count < 1) {
    std::fprintf(stderr, "turntable MODEL COUNT NAME\n");
    return 2;
  }
  glint::Session session;
  const glint::Model model = glint::Model::load(argv[1]);  // loaded once, for all pictures
  for (int i = 0; i < count; ++i) {
    const std::string path = argv[3] + ("-" + std::to_string(i)) + ".png";
    const std::string degrees = std::to_string(360.0 * i / count);
    glint::writePicture(path, session.drawCodes(model, {{"resolution", "192,192"},
                                                        {"camera-azimuth-angle", degrees}}));
    std::printf("%s\n", path.c_str());
  }
} catch (const glint::Error& error) {
  std::fprintf(stderr, "turntable: %s\n", error.what());
  return 1;
}
