// What variants do not depend on, and what they are made from: transforms, images, lights.

#include <gmock/gmock.h>

#include <algorithm>

#include "glint/render/draw_list.h"
#include "random.h"
#include "variants.h"

namespace glint::test::variant_inputs_test {

// Numbers, colours, the camera and the resolution are uniforms and do not change the variant.
TEST(Variants, DoNotDependOnNumbers) {
  Random random(3);
  const auto number = [&] { return 0.01 + 0.98 * random.unit(); };
  for (Shading program : everyShading) {
    const Variant plain = plainInputs(program).variant();
    for (int i = 0; i < 50; ++i) {
      VariantInputs in = plainInputs(program);
      in.material.shading.ambient = number();
      in.material.shading.diffuse = number();
      in.material.shading.specular = number();
      in.material.shading.exponent = 1000 * number();
      in.material.shading.ior = 1 + number();
      in.material.shading.color = {number(), 0, number()};
      in.material.alpha = number();
      in.material.alphaCutoff = number();
      in.world =
          translation({number(), 1e6, 0}) * rotation(6 * number()) * scaling(glm::dvec3(number()));
      in.look.ambientLight = glm::dvec3(number());
      in.look.blinnFactor = in.look.schlickExponent = number();
      in.look.mediumIor = 0.9 * number();
      in.look.environmentRotation = in.look.exposure = number();
      in.look.cameraPosition = glm::dvec3(number());
      in.look.resolution = {i + 1, 7};
      in.look.backgroundColor = glm::dvec3(number());
      in.look.noBackground = i % 2;
      in.look.environmentBackground = i % 3 == 0;
      EXPECT_EQ(in.variant(), plain);
    }
  }
}

TEST(Variants, SampleIsBroad) {
  const auto sample = sampledVariants();
  EXPECT_GT(sample.size(), 150u);
  for (Shading program : everyShading)
    EXPECT_GT(std::count_if(sample.begin(), sample.end(),
                            [&](const Variant& v) { return v.program == program; }),
              20);
}

TEST(Similarity, IsRotationAndOneScaleToAMillionth) {
  const glm::dmat3 turned(rotation(0.7));
  for (double scale : {1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    EXPECT_TRUE(isSimilarity(turned * scale)) << scale;
    EXPECT_TRUE(isSimilarity(-turned * scale)) << scale;
    // A relative scale error e changes the Gram matrix by 2e: the limit is e = 5e-7.
    EXPECT_TRUE(isSimilarity(glm::dmat3(scaling(glm::dvec3(scale, scale, scale * (1 + 4e-7))))));
    EXPECT_FALSE(isSimilarity(glm::dmat3(scaling(glm::dvec3(scale, scale, scale * (1 + 6e-7))))));
  }
  EXPECT_FALSE(isSimilarity(glm::dmat3(0.0)));
  EXPECT_FALSE(isSimilarity(glm::dmat3(scaling(glm::dvec3(0, 1, 1)))));
}

TEST(ImagesRead, AreThoseOfTheVariants) {
  Material material = materialOf(1, 1, 0, 1);
  material.colorTexture = Texture{1, 0, {}};
  material.emissionTexture = Texture{3, 0, {}};
  Scene scene = sceneOf(plainInputs().mesh, material);
  scene.images.resize(5);
  EXPECT_THAT(imagesRead(scene, {}), testing::ElementsAre(1));  // no emission factor
  scene.materials[0].emission = glm::dvec3(1);
  EXPECT_THAT(imagesRead(scene, {}), testing::ElementsAre(1, 3));
  scene.materials[0].unlit = true;
  EXPECT_THAT(imagesRead(scene, {}), testing::ElementsAre(1));
  scene.instances.clear();
  EXPECT_TRUE(imagesRead(scene, {}).empty());
}

TEST(Lights, AreTheGivenOnesElseTheDefaultUnlessThereAreNone) {
  Look look;
  ASSERT_EQ(lightsOf(look).size(), 1u);
  EXPECT_EQ(lightsOf(look)[0].type, Light::Type::camera);
  EXPECT_EQ(lightsOf(look)[0].direction, glm::dvec3(-0.5, 0.7, 1));
  EXPECT_EQ(lightsOf(look)[0].intensity, glm::dvec3(1));
  look.light = {directional({1, 0, 0}), lightOf(Light::Type::point)};
  EXPECT_EQ(lightsOf(look), *look.light);
  look.noLights = true;
  EXPECT_TRUE(lightsOf(look).empty());
}

}  // namespace glint::test::variant_inputs_test
