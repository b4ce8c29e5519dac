// Cost tables: the shipped one, files with measured ones, and invalid ones.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "files.h"
#include "glint/budget/cost_file.h"
#include "glint/image/error.h"
#include "gltf_text.h"

namespace glint {
namespace cost_file_test {

using Json = nlohmann::ordered_json;

std::string written(const std::string& text) {
  const std::string path = test::temporaryFolder() + "/costs.json";
  std::ofstream(path) << text;
  return path;
}

TEST(CostTable, CountsTheProductsOfAPower) {
  // x, x^2, x^2 x, (x^2)^2, ... : squarings, and one product for each further bit.
  const int products[] = {0, 1, 2, 2, 3, 3, 4, 3};
  for (int power = 1; power <= 8; ++power) EXPECT_EQ(productsOf(power), products[power - 1]);
  EXPECT_EQ(productsOf(127), 12);
  EXPECT_EQ(productsOf(128), 7);
  const CostTable shipped;
  EXPECT_EQ(shipped.lobe(Highlight::integer, 127), shipped.lobes.at(Highlight::integer).back());
  EXPECT_EQ(shipped.lobe(Highlight::lyonTuned, 64), shipped.lobes.at(Highlight::lyon).back());
  EXPECT_EQ(shipped.lobe(Highlight::pade, 1), shipped.lobes.at(Highlight::pade).front());
  EXPECT_NE(shipped.reflectance(Fresnel::schlick, 5, false),
            shipped.reflectance(Fresnel::schlick, 4, false));
  EXPECT_EQ(shipped.reflectance(Fresnel::exact, 5, true), shipped.fresnelDenser.exact);
}

TEST(CostFile, HoldsEveryCost) {
  CostFile file;
  file.gl = {"v", "llvm\"pipe", "4.5"};
  file.noise = 1.25;
  // Every cost is different, so that none can be mistaken for another.
  double next = 1.0 / 3;
  CostTable& t = file.costs;
  for (auto& [form, costs] : t.lobes)
    for (double& cost : costs) cost = next++;
  for (ReflectanceCosts* c : {&t.fresnel, &t.fresnelDenser})
    for (double* cost :
         {&c->exact, &c->textbook, &c->schlickExp2, &c->rational, &c->schlick, &c->schlickExponent})
      *cost = next++;
  const CostFile read = readCostFile(written(costFileText(file)));
  EXPECT_EQ(read.costs, file.costs);
  EXPECT_EQ(read.noise, file.noise);
  EXPECT_EQ(read.gl.renderer, file.gl.renderer);
  Look look;
  EXPECT_EQ(costTableFor(look), CostTable());
  look.costTable = written(costFileText(file));
  EXPECT_EQ(costTableFor(look), file.costs);
}

TEST(CostFile, RefusesWhatIsNoTable) {
  const auto refused = [](const std::string& text, const std::string& words) {
    EXPECT_THAT(test::messageOf([&] { readCostFile(written(text)); }),
                testing::AllOf(testing::HasSubstr(words), testing::HasSubstr("costs.json: "),
                               testing::HasSubstr("glint study --measure-costs")));
  };
  const Json good = Json::parse(costFileText({}));
  const auto changed = [&](const char* pointer, const Json& value) {
    Json json = good;
    json[Json::json_pointer(pointer)] = value;
    return json.dump();
  };
  refused("", "is not valid JSON");
  refused("{\"glint-costs\": 1", "is not valid JSON");
  refused("[1, 2]", "is not a cost table");
  refused("{\"glint-look\": 1}", "is not a cost table");
  refused(changed("/glint-costs", 2), "version 2, and this glint reads 1");
  refused(changed("/highlight", 3), "lacks the cost of highlight exact");
  refused(changed("/highlight/pow", "dear"), "highlight pow is not a number");
  refused(changed("/highlight/pow", -1), "highlight pow is not from 0 to 1e6");
  refused(changed("/highlight/pow", Json()), "highlight pow is not a number");
  refused(changed("/fresnel/rational", 1e300), "fresnel rational is not from 0 to 1e6");
  refused(changed("/highlight/lyon", Json::array({1, 2})), "is not a list of 7 numbers");
  refused(changed("/highlight/lyon/3", Json::object()), "highlight lyon is not a number");
  refused(changed("/fresnel/magic", 1), "a form that this version does not know");
  Json less = good;
  less["fresnel"].erase("schlick");
  refused(less.dump(), "lacks the cost of fresnel schlick");
  EXPECT_THROW(readCostFile("/no/such/costs.json"), InputError);
}

}  // namespace cost_file_test
}  // namespace glint
