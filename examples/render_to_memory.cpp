// render_to_memory MODEL: draws a model into memory and counts the pixels that it covers.

#include <cstdio>

#include "glint/glint.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "render_to_memory MODEL\n");
    return 2;
  }
  glint::Session session;  // keeps its shaders from picture to picture
  const glint::Model model = glint::Model::load(argv[1]);
  // Like `glint render`, with only these options. The cheapest formulas within an error of 0.001 of
  // linear light are chosen.
  const glint::Options look{{"resolution", "256,256"},
                            {"shading", "blinn-phong"},
                            {"no-background", "true"},
                            {"max-error", "0.001"}};
  const glint::Image picture = session.draw(model, look);

  int covered = 0;
  for (std::size_t i = 3; i < picture.values.size(); i += 4) covered += picture.values[i] > 0;
  std::printf("%s: %d of %d pixels\n", session.description().c_str(), covered,
              picture.width * picture.height);
} catch (const glint::Error& error) {
  std::fprintf(stderr, "render_to_memory: %s\n", error.what());
  return 1;
}
