// `glint diff` as used in scripts: exit statuses, lines, reports, folders, baselines.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "glint/image/read_image.h"
#include "pictures.h"

namespace glint::test::diff_cli_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Json = nlohmann::json;

/// Writes a grey ramp whose pixels (0, 0) to (differing - 1, 0) are brighter by `more`.
void write(const std::string& path, int differing = 0, float more = 0.25f, int width = 24,
           const std::string& driver = "") {
  Image image{width, 16, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < width; ++x) {
      const float grey = 0.03f * float(x) + (y == 0 && x < differing ? more : 0);
      image.values.insert(image.values.end(), {grey, grey, grey, 1});
    }
  glint::PictureOptions options;
  if (!driver.empty()) options.text = {{"GL_RENDERER", driver}};
  writePicture(path, image, options);
}

/// The pictures that the tests compare, in a working folder of their own.
class Pictures : public Folder {
 public:
  explicit Pictures(const std::string& name) : Folder(name) {
    write(*this / "a.png");
    write(*this / "same.png");
    write(*this / "b.png", 3);
    write(*this / "slight.png", 1, 0.01f);
    write(*this / "wide.png", 0, 0, 25);
    write(*this / "a.exr");
    write(*this / "b.pfm", 3);
    write(*this / "infinite.pfm", 1, INFINITY);
    write(*this / "nan.pfm", 1, NAN);
    writeText(*this / "damaged.png", contents(*this / "a.png").substr(0, 60));
    writeText(*this / "text.png", "no picture\n");
  }
  Ran diff(const std::string& arguments) const { return runGlintIn(*this, "diff " + arguments); }
};

Json jsonOf(const std::string& path) { return Json::parse(contents(path)); }

TEST(DiffStatus, Table) {
  const Pictures pictures("status");
  struct Case {
    std::string arguments;
    int status;
    std::string says;  // on stdout, or on stderr for 2 and more
  };
  const Case cases[] = {
      // The same, or within the limits.
      {"a.png a.png", 0, "a.png: same, equal in every pixel"},
      {"a.png same.png", 0, "same.png: same"},
      {"a.png b.png --metric max --threshold 0.6", 0, "same, max 0.5"},
      {"a.png b.png --metric psnr --threshold 20", 0, "psnr 2"},
      {"a.png b.png --max-pixels 3", 0, "pixels 3"},
      {"a.png b.png --max-pixels=1%", 0, "same"},
      {"a.png b.png --tolerance 1 --max-pixels 0", 0, "pixels 0"},
      {"a.png b.png --ignore 0,0-2,0", 0, "same"},
      {"a.png b.png --ignore 0,0-0,0 --ignore 2,0-1,0", 0, "same"},
      {"a.png a.exr --values encoded --metric max --threshold 0.002", 0, "same"},
      {"b.pfm b.pfm", 0, "same"},
      {"nan.pfm nan.pfm", 0, "same"},
      {"infinite.pfm infinite.pfm", 0, "same"},
      // Differences.
      {"a.png b.png", 1, "b.png: differs, max 0.5"},
      {"a.png slight.png", 1, "1 of 384 pixels differ"},
      {"a.png b.png --metric max --threshold 0.3", 1, "is above 0.3"},
      {"a.png b.png --metric ssim --threshold 0.999999", 1, "is below 0.999999"},
      {"a.png b.png --metric flip --threshold 1e-3", 1, "flip 0.0"},
      {"a.png b.png --metric max --threshold 1 --metric rmse --threshold 0.001 --max-pixels 2", 1,
       "rmse 0.0"},
      {"a.png b.png --metric flip", 1, "differs"},
      {"a.png b.png --max-pixels 2", 1, "3 pixels are over the tolerance of 0.1"},
      {"a.png b.png --max-pixels 0.7%", 1, "the limit is 2.688"},
      {"a.png b.png --ignore 0,0-23,15", 1, "no pixel is left to compare"},
      {"a.png wide.png", 1, "the sizes differ: 24 x 16 and 25 x 16 pixels"},
      {"nan.pfm nan.pfm --metric max --threshold 1", 1, "is not a number"},
      {"a.exr infinite.pfm --metric hdr-flip --threshold 1", 1, "1 pixel is inf"},
      {"a.exr nan.pfm", 1, "worst at 0,0"},
      // Wrong usage and unreadable files.
      {"", 2, "glint diff A B"},
      {"a.png", 2, "glint diff A B"},
      {"a.png b.png slight.png", 2, "slight.png"},
      {"a.png missing.png", 2, "missing.png: No such file or directory: check the path"},
      {"missing.png missing.png", 2, "missing.png: No such file"},
      {"a.png damaged.png", 2, "damaged.png: the PNG is damaged"},
      {"text.png a.png", 2, "text.png: neither PNG"},
      {"a.png .", 2, "one is a folder, the other a file"},
      {"a.png a.exr", 2, "a.png and a.exr: one is sRGB, the other linear light"},
      {"a.png b.png --metric maximum", 2, "unknown metric 'maximum'"},
      {"a.png b.png --threshold 1", 2, "give the metric before it"},
      {"a.png b.png --metric max --threshold x", 2, "give a number"},
      {"a.png b.png --metric max --threshold nan", 2, "give a number"},
      {"a.png b.png --metric flip --threshold -1", 2, "give 0 or more for flip"},
      {"a.png b.png --metric psnr --threshold -1", 0, "psnr"},
      {"a.png b.png --max-pixels -1", 2, "give a number of pixels"},
      {"a.png b.png --max-pixels 101%", 2, "0% to 100%"},
      {"a.png b.png --max-pixels %", 2, "give a number"},
      {"a.png b.png --tolerance 1.5", 2, "--tolerance: '1.5': give a number from 0 to 1"},
      {"a.png b.png --tolerance nan", 2, "--tolerance: 'nan': give a number from 0 to 1"},
      {"a.png b.png --scale nan", 2, "--scale: 'nan': give a number from 0 to 1"},
      {"a.png b.png --jobs 2.5", 2, "--jobs: '2.5': give a whole number from 1 to 256"},
      {"a.png b.png --alpha over:nan,0,0", 2, "r,g,b in linear light, 0 to 1e6"},
      {"a.png b.png --alpha over:-1,0,0", 2, "r,g,b in linear light, 0 to 1e6"},
      {"a.png b.png --screen -1,-1,1", 2, "distance,pixels,width"},
      {"a.png b.png --screen nan,1,1", 2, "distance,pixels,width"},
      {"a.png b.png --ignore 1,2,3,4", 2, "x1,y1-x2,y2"},
      {"a.png b.png --ignore 0.5,0-1,1", 2, "whole pixels"},
      {"a.png b.png --mask wide.png", 2, "a mask of their size"},
      {"a.png b.png --mask missing.png", 2, "missing.png"},
      {"a.png b.png --alpha under", 2, "straight, ignored or over:COLOUR"},
      {"a.png b.png --alpha over:#12345", 2, "#rrggbb"},
      {"a.png b.png --values srgb", 2, "stored, encoded or linear"},
      {"a.png b.png --layer diffuse", 2, "only OpenEXR has layers"},
      {"a.png b.png --pixels-per-degree 0", 2, "--pixels-per-degree"},
      {"a.png b.png --screen 1,2", 2, "distance,pixels,width"},
      {"a.png b.png --screen 0,0,0 --metric flip", 2, "pixels per degree"},
      {"a.png b.png --scale -1", 2, "--scale"},
      {"a.png b.png --jobs 0", 2, "--jobs"},
      {"a.png b.png --difference heat", 2, "flip, absolute or side-by-side"},
      {"a.png b.png -o a.png", 2, "would overwrite an input file"},
      {"a.png b.png -o x.gif", 2, "x.gif: the extension is not that of a known format"},
      {"a.png b.png --json - --junit -", 2, "already goes to stdout"},
      {"a.png b.png --json /proc/none/a.json", 2, "/proc/none"},
      // No baseline.
      {"missing.png a.png", 4, "missing.png: no baseline: look at a.png and accept it"},
  };
  for (const Case& c : cases) {
    const Ran ran = pictures.diff(c.arguments);
    EXPECT_EQ(ran.status, c.status) << c.arguments << "\n" << ran.out << ran.err;
    EXPECT_THAT(c.status < 2 ? ran.out : ran.err, HasSubstr(c.says)) << c.arguments;
    EXPECT_EQ(ran.errorLines().size(), c.status < 2 ? 0u : 1u) << c.arguments << ran.err;
    const auto lines = std::count(ran.out.begin(), ran.out.end(), '\n');
    EXPECT_EQ(lines, c.status < 2 ? 1 : 0) << c.arguments << ran.out;
  }
  EXPECT_THAT(pictures.names(), Not(testing::Contains("x.gif")));
}

TEST(DiffReports, JsonHasTheMetrics) {
  const Pictures pictures("json");
  const Ran ran =
      pictures.diff("a.png b.png --json - --metric flip --threshold 0.5 --max-pixels 1");
  EXPECT_EQ(ran.status, 1);
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["status"], 1);
  EXPECT_EQ(json["same"], false);
  EXPECT_EQ(json["values"], "encoded");
  EXPECT_EQ(json["differing"], 3);
  for (const char* name :
       {"max", "mean", "rmse", "relative-rmse", "psnr", "pixels", "ssim", "flip"})
    EXPECT_TRUE(json["metrics"][name]["value"].is_number()) << name;
  EXPECT_EQ(json["metrics"]["flip"]["mean"], json["metrics"]["flip"]["value"]);
  EXPECT_EQ(json["metrics"]["flip"]["threshold"], 0.5);
  EXPECT_NEAR(json["metrics"]["flip"]["pixelsPerDegree"], 67.0206, 1e-4);
  EXPECT_EQ(json["metrics"]["pixels"]["value"], 3);
  EXPECT_FALSE(json["metrics"].contains("hdr-flip"));
  EXPECT_EQ(json["worst"].size(), 3u);
  EXPECT_EQ(json["worst"][0]["x"], 0);
  const Ran screen = pictures.diff("a.exr b.pfm --json - --screen 0.7,3840,0.7");
  EXPECT_NEAR(Json::parse(screen.out)["metrics"]["hdr-flip"]["pixelsPerDegree"], 67.0206, 1e-4);
  EXPECT_TRUE(Json::parse(screen.out)["metrics"]["hdr-flip"]["mean"].is_number());
  const Json equal = Json::parse(pictures.diff("a.png a.png --json -").out);
  EXPECT_TRUE(equal["metrics"]["psnr"]["value"].is_null());  // infinite
}

TEST(DiffReports, JUnit) {
  const Pictures pictures("junit");
  write(pictures / "x/one.png");
  write(pictures / "y/one.png");
  write(pictures / "x/two & <three>.png");
  write(pictures / "y/two & <three>.png", 3);
  write(pictures / "x/gone.png");
  write(pictures / "x/caf\xe9.png");
  EXPECT_EQ(pictures.diff("x y --junit r.xml").status, 2);
  const std::string xml = contents(pictures / "r.xml");
  EXPECT_THAT(xml, HasSubstr("<testsuites tests=\"4\" failures=\"1\" errors=\"2\""));
  EXPECT_THAT(xml, HasSubstr("name=\"caf\xef\xbf\xbd.png\""));  // invalid UTF-8: replaced
  EXPECT_THAT(xml, HasSubstr("name=\"one.png\""));
  EXPECT_THAT(xml, HasSubstr("name=\"two &amp; &lt;three&gt;.png\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"3 pixels differ\">"));
  EXPECT_THAT(xml, HasSubstr("(0, 0): "));
  EXPECT_THAT(xml, HasSubstr("<error message=\"missing: there is a baseline but no picture\">"));
}

TEST(DiffPicture, Kinds) {
  const Pictures pictures("kinds");
  EXPECT_EQ(pictures.diff("a.png b.png -o flip.png").status, 1);
  EXPECT_EQ(pictures.diff("a.png b.png -o absolute.png --difference absolute --scale 1.5").status,
            1);
  EXPECT_EQ(pictures.diff("a.png b.png -o beside.png --difference side-by-side").status, 1);
  const Image flip = glint::readImage(pictures / "flip.png");
  EXPECT_EQ(flip.width, 24);
  EXPECT_GT(flip.row(0)[0], 0.1f);          // Magma's red for a visible difference
  EXPECT_LT(flip.row(15)[4 * 23], 0.001f);  // and black for none
  const Image absolute = glint::readImage(pictures / "absolute.png");
  const Image a = glint::readImage(pictures / "a.png"), b = glint::readImage(pictures / "b.png");
  // (0, 0): 0 against the code of 0.25, 137; 1.5 times that is 206 (to half a code).
  EXPECT_NEAR(absolute.row(0)[0], 0.6172, 0.01);
  EXPECT_EQ(absolute.row(15)[0], 0);
  const Image beside = glint::readImage(pictures / "beside.png");
  EXPECT_EQ(beside.width, 72);
  EXPECT_EQ(beside.row(0)[4 * 2], a.row(0)[4 * 2]);
  EXPECT_EQ(beside.row(0)[4 * 26], b.row(0)[4 * 2]);
}

TEST(DiffFolders, MissingExtraAndSummary) {
  const Pictures pictures("folders");
  for (const char* name : {"one.png", "sub/two.png", "gone.png"})
    write(pictures / ("x/" + std::string(name)));
  for (const char* name : {"one.png", "extra.png"}) write(pictures / ("y/" + std::string(name)));
  write(pictures / "y/sub/two.png", 3);
  writeText(pictures / "y/notes.txt", "no picture");
  const Ran ran = pictures.diff("x y --json r.json --jobs 3");
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.out, HasSubstr("extra.png: no baseline: accept it with --update\n"));
  EXPECT_THAT(ran.out, HasSubstr("gone.png: missing: there is a baseline but no picture\n"));
  EXPECT_THAT(ran.out, HasSubstr("sub/two.png: differs"));
  EXPECT_THAT(ran.out, HasSubstr("4 pairs: 1 same, 1 differ, 1 missing, 1 without baseline, 0 "
                                 "unreadable\n"));
  const Json json = jsonOf(pictures / "r.json");
  EXPECT_EQ(json["pairs"].size(), 4u);
  EXPECT_EQ(json["summary"]["missing"], 1);
  EXPECT_EQ(json["pairs"][3]["name"], "sub/two.png");
  EXPECT_NEAR(json["pairs"][3]["metrics"]["max"]["value"], 0.54, 0.01);
  // The most severe status wins: missing, differing, without baseline.
  std::filesystem::remove(pictures / "x/gone.png");
  EXPECT_EQ(pictures.diff("x y").status, 1);
  EXPECT_EQ(pictures.diff("x y --max-pixels 3").status, 4);
  std::filesystem::remove(pictures / "y/extra.png");
  EXPECT_EQ(pictures.diff("x y --max-pixels 3").status, 0);
  EXPECT_EQ(pictures.diff("nowhere x").status, 4);
  EXPECT_EQ(pictures.diff("x nowhere").status, 2);
  std::filesystem::create_directories(pictures / "empty");
  EXPECT_THAT(pictures.diff("empty empty").err, HasSubstr("no pictures in them"));
  EXPECT_THAT(pictures.diff("x y -o d.png").err, HasSubstr("use --html"));
}

TEST(DiffUpdate, NeverSilent) {
  const Pictures pictures("update");
  write(pictures / "x/one.png");
  write(pictures / "y/one.png", 3);
  write(pictures / "x/two.png");
  write(pictures / "y/two.png", 2);
  write(pictures / "y/three.png");
  write(pictures / "x/same.png");
  write(pictures / "y/same.png");
  Ran ran = pictures.diff("x y --update four.png");
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.err, HasSubstr("--update four.png: no such pair"));
  ran = pictures.diff("x y --update one.png");
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(ran.err, "glint: replaced the baseline x/one.png\n");
  EXPECT_EQ(contents(pictures / "x/one.png"), contents(pictures / "y/one.png"));
  EXPECT_NE(contents(pictures / "x/two.png"), contents(pictures / "y/two.png"));
  // Names before the folders, all names, and no message for pairs that were the same.
  ran = pictures.diff("--update x y");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.err,
            "glint: made the baseline x/three.png\nglint: replaced the baseline x/two.png\n");
  EXPECT_THAT(ran.out, HasSubstr("4 pairs: 4 same"));
  EXPECT_THAT(ran.out, HasSubstr("2 baselines updated"));
  EXPECT_EQ(pictures.diff("x y").status, 0);
  // A file; one of another size; one that could not be read; a new folder.
  ran = pictures.diff("new/a.png a.png --update");
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.err, "glint: made the baseline new/a.png\n");
  EXPECT_EQ(pictures.diff("new/a.png wide.png --update").status, 0);
  EXPECT_EQ(pictures.diff("damaged.png a.png --update").status, 0);
  EXPECT_EQ(contents(pictures / "damaged.png"), contents(pictures / "a.png"));
  EXPECT_EQ(pictures.diff("z y --update").status, 0);
  EXPECT_EQ(pictures.diff("z y").status, 0);
  // Neither an unreadable file nor one of another format becomes a baseline.
  EXPECT_EQ(pictures.diff("new/t.png text.png --update").status, 2);
  EXPECT_THAT(pictures.diff("new/t.png a.exr --update").err,
              HasSubstr("has a different format from"));
  EXPECT_FALSE(std::filesystem::exists(pictures / "new/t.png"));
}

TEST(DiffDrivers, AreTold) {
  const Pictures pictures("drivers");
  write(pictures / "x/one.png", 0, 0, 24, "softpipe");
  write(pictures / "y/one.png", 3, 0.25f, 24, "llvmpipe (LLVM 15)");
  Ran ran = pictures.diff("x/one.png y/one.png");
  EXPECT_THAT(ran.out, HasSubstr("compared across drivers: softpipe and llvmpipe (LLVM 15)"));
  ran = pictures.diff("x y");
  EXPECT_THAT(ran.out, HasSubstr("1 compared across drivers"));
  // A baseline for this driver is made in its own folder, and preferred.
  ran = pictures.diff("x y --baselines-per-driver --update");
  EXPECT_EQ(ran.err, "glint: made the baseline x/driver-llvmpipe-llvm-15/one.png\n");
  ran = pictures.diff("x y --baselines-per-driver");
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.out, Not(HasSubstr("across")));
  EXPECT_EQ(pictures.diff("x y").status, 1);
  // Likewise for single pictures.
  EXPECT_EQ(pictures.diff("x/one.png y/one.png --baselines-per-driver").status, 0);
  ran = pictures.diff("a.png y/one.png --baselines-per-driver --update");
  EXPECT_EQ(ran.err, "glint: made the baseline ./driver-llvmpipe-llvm-15/a.png\n");
  EXPECT_EQ(pictures.diff("a.png y/one.png --baselines-per-driver").status, 0);
}

TEST(DiffJobs, DoNotChangeTheResult) {
  const Pictures pictures("jobs");
  for (int i = 0; i < 12; ++i) {
    write(pictures / ("x/" + std::to_string(i) + ".png"));
    write(pictures / ("y/" + std::to_string(i) + ".png"), i);
  }
  std::vector<Json> results;
  std::vector<std::string> pages;
  for (const std::string jobs : {"1", "5"}) {
    EXPECT_EQ(pictures.diff("x y --json r.json --html r.html --jobs " + jobs).status, 1);
    Json json = jsonOf(pictures / "r.json");
    for (Json& pair : json["pairs"]) pair.erase("ms");
    results.push_back(json);
    // Everything except the times.
    std::string page = contents(pictures / "r.html");
    for (std::size_t at = 0; (at = page.find("\"ms\":", at)) != std::string::npos; ++at)
      page.erase(at + 5, page.find_first_of(",}", at) - at - 5);
    pages.push_back(page);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(pages[0], pages[1]);
  EXPECT_THAT(pages[0], Not(HasSubstr("https:")));
}

}  // namespace glint::test::diff_cli_test
