// Makes the models of this folder: make_models FOLDER. The files are the same on every machine.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "glb.h"
#include "materials.h"
#include "mesh.h"
#include "scene_models.h"

namespace {

using glint::models::material;
using nlohmann::json;

json redPlastic() {
  return material("Red plastic",
                  {{"ambient", 1},
                   {"diffuse", 0.8},
                   {"specular", 0.5},
                   {"exponent", 40},
                   {"metalness", 0},
                   {"ior", 1.5},
                   {"color", {0.7, 0.05, 0.03}}},
                  {{"baseColorFactor", {0.7, 0.05, 0.03, 1}},
                   {"metallicFactor", 0},
                   {"roughnessFactor", 0.3333}});
}

json gold() {
  return material("Gold",
                  {{"ambient", 1},
                   {"diffuse", 0.4},
                   {"specular", 0.9},
                   {"exponent", 25},
                   {"metalness", 1},
                   {"ior", 1.5},
                   {"color", {1, 0.71, 0.29}}},
                  {{"baseColorFactor", {1, 0.71, 0.29, 1}},
                   {"metallicFactor", 1},
                   {"roughnessFactor", 0.3742}});
}

json glazedCeramic() {
  json ceramic = material("Glazed ceramic",
                          {{"ambient", 1},
                           {"diffuse", 0.8},
                           {"specular", 0.6},
                           {"exponent", 80},
                           {"metalness", 0},
                           {"ior", 1.5},
                           {"color", {0.02, 0.35, 0.38}}},
                          {{"baseColorFactor", {0.02, 0.35, 0.38, 1}},
                           {"metallicFactor", 0},
                           {"roughnessFactor", 0.2807}});
  // The inside of the pot is visible between lid and rim, and through the spout.
  ceramic["doubleSided"] = true;
  return ceramic;
}

json matteGrey() {
  return material(
      "Matte grey",
      {{"ambient", 1},
       {"diffuse", 1},
       {"specular", 0},
       {"exponent", 10},
       {"metalness", 0},
       {"ior", 1.5},
       {"color", {0.6, 0.6, 0.6}}},
      {{"baseColorFactor", {0.6, 0.6, 0.6, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}});
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file.exceptions(std::ios::badbit | std::ios::failbit);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "make_models: give the folder to write the models to\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  try {
    using namespace glint::models;
    write(folder / "sphere.glb", glb(sphere(72, 36), redPlastic()));
    write(folder / "torus.glb", glb(torus(0.75, 0.25, 96, 32), gold()));
    write(folder / "teapot.glb", glb(teapot(12), glazedCeramic()));
    write(folder / "torus-knot.glb",
          glb(torusKnot(0.6, 0.26, 0.14, 192, 16), material("Jade", {0.05, 0.4, 0.2}, 0.6, 60, 0)));
    write(folder / "preview.glb", preview());
    write(folder / "chart.glb", chart());
    write(folder / "bend.glb", bend());
    write(folder / "morph.glb", morph());
    write(folder / "lights.glb", lights());
    for (int level = 1; level <= 6; ++level) {
      write(folder / "sphere-series" / ("sphere-" + std::to_string(level) + ".glb"),
            glb(icosphere(level), matteGrey()));
    }
  } catch (const std::exception& error) {
    std::cerr << "make_models: cannot write to " << folder.string() << ": " << error.what() << '\n';
    return 1;
  }
  return 0;
}
