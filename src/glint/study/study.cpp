#include "glint/study/study.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"
#include "glint/study/page_pictures.h"
#include "glint/study/series.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

/// A study in progress.
class Study {
 public:
  Study(const StudyScene& scene, const StudyOptions& options, const Stop& stop,
        const StudyProgress& progress)
      : scene_(scene),
        options_(options),
        stop_(stop),
        progress_(progress),
        gpu_(scene.scene, scene.images) {}

  StudyResult run() {
    prepare();
    if (!measureErrors()) return leave("errors of some variants");
    measureTimes();
    measureParts();
    if (options_.filter.isEmpty()) measureWays();
    if (options_.filter.isEmpty()) measureSeries();
    for (WholeTruth& truth : result_.wholeTruths) truth.picture = {};
    result_.complete = result_.missing.empty();
    return std::move(result_);
  }

 private:
  void tell(const std::string& what, double share) const {
    if (progress_) progress_(what, share);
  }

  bool stopped() const { return stop_ && stop_(); }
  StudyResult leave(const char* what) {
    result_.missing.emplace_back(what);
    std::erase_if(result_.variants, [](const VariantResult& v) { return v.errors.empty(); });
    return std::move(result_);
  }

  void prepare() {
    tell("pixels to compare", 0);
    result_.gl = glStrings();
    result_.clock = clockFor(options_.clock, result_.gl.renderer, elapsedTimer()->works());
    result_.spreadLimit = options_.spreadLimit;
    {
      Renderer renderer;  // the variants' programs must not be compiled before that is timed
      result_.mask = maskOf(renderer, gpu_, scene_, options_.look);
    }
    if (result_.mask.pixels.empty())
      throw InputError(
          scene_.scene.name +
          ": no pixel shows a lit surface away from edges: move the camera closer or use a larger "
          "--resolution");
    const DrawList list = makeDrawList(scene_.scene, scene_.bounds, options_.look);
    result_.draws = drawCalls(list.items).size();
    std::set<double> exponents;
    for (const DrawItem& item : list.items) {
      const Mesh& mesh = scene_.scene.meshes[std::size_t(item.mesh)];
      if (mesh.topology == Topology::triangles) result_.triangles += mesh.indices.size() / 3;
      if (item.variant.specular)
        exponents.insert(
            editedMaterial(scene_.scene.materials[std::size_t(item.material)], options_.look)
                .shading.exponent);
    }
    result_.exponents.assign(exponents.begin(), exponents.end());
    for (StudyVariant& v :
         studyVariants(scene_.scene, scene_.bounds, options_.look, options_.filter))
      result_.variants.emplace_back().variant = std::move(v);
    if (result_.variants.empty())
      throw InputError(
          "no variant is left to study: leave out --shading, --highlight or --fresnel, or give "
          "ones that this model's materials use");
  }

  const Radiances& truth(Shading program, bool atInputs = false) {
    auto [place, isNew] = (atInputs ? driverTruths_ : truths_).try_emplace(program);
    if (isNew) place->second = truthOf(scene_, options_.look, program, result_.mask, atInputs);
    return place->second;
  }

  /// False if it was stopped.
  bool measureErrors() {
    std::size_t number = 0;
    for (VariantResult& v : result_.variants) {
      if (stopped()) return false;
      tell("errors: " + v.variant.name, double(number++) / double(result_.variants.size()));
      DrawList list = makeDrawList(scene_.scene, scene_.bounds, v.variant.look);
      std::set<std::string> features;
      for (const DrawItem& item : list.items)
        for (const std::string& name : featureNames(item.variant))
          if (features.insert(name).second) v.features.push_back(name);
      pictures_.push_back(renderer_->begin(gpu_, std::move(list), v.variant.look));
      v.compile = pictures_.back().times().compile;
      v.firstFrame = timeOnce(pictures_.back());
      const Image picture = renderer_->draw(gpu_, pictures_.back().list(), v.variant.look);
      errorsOf(v, picture);
      if (options_.keepPictures) keepPictures(v, number - 1, picture);
    }
    return true;
  }

  void keepPictures(const VariantResult& v, std::size_t number, const Image& picture) {
    const auto id = [](const char* kind, const std::string& which) {
      return std::string(kind) + "-" + which;
    };
    const auto keep = [&](std::string name, const Radiances* at) {
      result_.pictures.push_back(
          {std::move(name),
           pagePng(overBackground(picture, options_.look.backgroundColor, result_.mask, at),
                   std::exp2(options_.look.exposure))});
    };
    keep(id("picture", std::to_string(number)), nullptr);
    for (const VariantError& e : v.errors)
      result_.pictures.push_back(
          {id("error", std::to_string(number) + "-" + std::string(shadingName(e.against))),
           pageErrorPng(picture, result_.mask, truth(e.against))});
    // Outside the mask the truth shows the pixels of the model's first variant.
    const Shading model = modelOf(v.variant.program);
    const std::string name = id("truth", std::string(shadingName(model)));
    if (std::ranges::find(result_.pictures, name, &PagePicture::id) == result_.pictures.end())
      keep(name, &truth(model));
  }

  void errorsOf(VariantResult& v, const Image& picture) {
    const Look& look = options_.look;
    const double exposure = std::exp2(look.exposure);
    const Shading program = v.variant.program, model = modelOf(program);
    const Radiances drawn = radiancesOf(picture, result_.mask);
    const auto against = [&](Shading other) {
      const Radiances& exact = truth(other);
      v.errors.push_back({other, errorOf(exact, drawn, exposure),
                          flipOf(picture, result_.mask, exact, look.backgroundColor, exposure)});
    };
    against(model);
    if (program == Shading::blinnPhong) against(Shading::phong);
    const Radiances& given = truth(program, program == model);
    v.shading = errorOf(given, drawn, exposure);
    v.interpolation = errorOf(truth(model), given, exposure);
    if (const WholeTruth* whole = wholeTruth(model))
      v.whole = wholeErrorOf(*whole, picture, result_.mask, exposure);
  }

  /// Null if there is none, or it was stopped.
  const WholeTruth* wholeTruth(Shading model) {
    if (options_.truthSamples == 0) return nullptr;
    const auto found = std::ranges::find(result_.wholeTruths, model, &WholeTruth::model);
    if (found != result_.wholeTruths.end()) return &*found;
    WholeTruth truth =
        wholeTruthOf(scene_, options_.look, model, options_.truthSamples, result_.mask, stop_);
    if (truth.picture.values.empty()) return nullptr;
    return &result_.wholeTruths.emplace_back(std::move(truth));
  }

  /// Begins the pictures of the variants, if they are missing, and of floors and controls.
  void beginPictures(const std::vector<std::size_t>& controls) {
    if (pictures_.empty())
      for (const VariantResult& v : result_.variants)
        pictures_.push_back(renderer_->begin(
            gpu_, makeDrawList(scene_.scene, scene_.bounds, v.variant.look), v.variant.look));
    const Look exact = exactLook(options_.look, Shading::phong);
    const DrawList list = makeDrawList(scene_.scene, scene_.bounds, exact);
    pictures_.push_back(renderer_->begin(gpu_, emptied(list), exact));
    pictures_.push_back(renderer_->begin(gpu_, inOneColor(list), exact));
    renderer_->setProgramsAside();  // or a control would be drawn with its variant's program
    for (const std::size_t i : controls)
      pictures_.push_back(
          renderer_->begin(gpu_, pictures_[i].list(), result_.variants[i].variant.look));
  }

  /// Measures floors and controls among the variants. All programs are rebuilt several times, since
  /// where a driver puts a program may change how fast it is, for as long as it stays there.
  void measureTimes() {
    const std::size_t count = pictures_.size();
    const std::vector<std::size_t> controls = controlled(count);
    std::vector<FrameTimes> times(count + 2 + controls.size());
    const int builds = std::clamp(options_.builds, 1, options_.rounds);
    // The first frames fill the driver's and the machine's caches; later builds need fewer.
    const auto warmUpOf = [&](int build) {
      return build == 0 ? options_.warmUp : std::min(options_.warmUp, 3);
    };
    int whole = options_.rounds, past = 0;
    for (int build = 0; build < builds; ++build) whole += warmUpOf(build);
    for (int build = 0; build < builds && !stopped(); ++build) {
      if (build > 0) {
        pictures_.clear();
        renderer_.emplace();
      }
      beginPictures(controls);
      std::vector<Renderer::Picture*> pictures;
      for (Renderer::Picture& picture : pictures_) pictures.push_back(&picture);
      const int rounds = options_.rounds * (build + 1) / builds - options_.rounds * build / builds;
      const auto part =
          timeInTurn(pictures, {warmUpOf(build), rounds, result_.clock == FrameClock::gpu, stop_,
                                [&](int) { tell("frame times", double(++past) / whole); }});
      for (std::size_t i = 0; i < times.size(); ++i) {
        for (const auto clock : {&FrameTimes::wall, &FrameTimes::cpu, &FrameTimes::query}) {
          const std::vector<double>& more = part[i].*clock;
          (times[i].*clock).insert((times[i].*clock).end(), more.begin(), more.end());
        }
        times[i].batch = std::max(times[i].batch, part[i].batch);
      }
    }
    if (times[0].wall.size() < std::size_t(options_.rounds))
      result_.missing.emplace_back("frame times after " + std::to_string(times[0].wall.size()) +
                                   " of " + std::to_string(options_.rounds) + " rounds");
    for (const std::size_t i : controls)
      result_.controls.push_back(result_.variants[i].variant.name);
    for (std::size_t c = 0; c < frameClocks; ++c) {
      if (FrameClock(c) == FrameClock::gpu && drawsOnCpu(result_.gl.renderer)) continue;
      ClockNoise& noise = result_.noise[c];
      for (std::size_t k = 0; k < controls.size(); ++k)
        noise.ratios.push_back(timeRatio(times[count + 2 + k].by(FrameClock(c)),
                                         times[controls[k]].by(FrameClock(c))));
      noise.spread = spreadOfControls(noise.ratios);
    }
    for (std::size_t i = 0; i < count; ++i) result_.variants[i].times = std::move(times[i]);
    result_.floors = {{"empty", std::move(times[count])},
                      {"constant", std::move(times[count + 1])}};
    if (result_.variants[0].times.wall.empty()) return;
    result_.noFront = whyNoFront(result_.noise, result_.clock, options_.spreadLimit);
    if (result_.noFront.empty()) makeFronts();
  }

  /// Three variants, spread from the first to the last, which are of different programs.
  static std::vector<std::size_t> controlled(std::size_t count) {
    std::set<std::size_t> chosen{0, count / 2, count - 1};
    return {chosen.begin(), chosen.end()};
  }

  void makeFronts() {
    std::vector<QuartileSamples> samples;
    for (const VariantResult& v : result_.variants)
      samples.push_back(quartileSamples(v.times.by(result_.clock)));
    const auto faster = [&](int a, int b) {
      return isFaster(samples[std::size_t(a)], samples[std::size_t(b)], result_.spread());
    };
    for (const Shading model : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
      for (const std::string& metric : errorMetrics()) {
        StudyFront front{model, metric, {}, {}};
        std::vector<double> errors;
        for (std::size_t i = 0; i < result_.variants.size(); ++i) {
          const VariantError* error = errorAgainst(result_.variants[i], model);
          if (!error) continue;
          front.variants.push_back(int(i));
          errors.push_back(metricOf(*error, metric));
        }
        if (errors.empty()) continue;
        const auto variant = [&](int i) { return front.variants[std::size_t(i)]; };
        // What --max-error chooses repeats another variant, and is no rival.
        front.places = paretoFront(
            errors, [&](int a, int b) { return faster(variant(a), variant(b)); },
            [&](int i) { return !result_.variants[std::size_t(variant(i))].variant.bound; });
        result_.fronts.push_back(std::move(front));
      }
    }
  }

  void measureParts() {
    if (stopped()) return result_.missing.push_back("parts of a frame");
    tell("parts of a frame", 0);
    const int rounds = std::min(options_.rounds, options_.quick ? 20 : 40);
    result_.parts =
        frameParts(scene_, gpu_, options_.look, modelOf(programOf(options_.look)), result_.clock,
                   {3, rounds, result_.clock == FrameClock::gpu, stop_, {}});
    if (result_.parts.empty()) result_.missing.emplace_back("parts of a frame");
  }

  /// The ways to treat aliasing: each kind of anti-aliasing has its own target and renderer.
  void measureWays() {
    pictures_.clear();
    renderer_.emplace();
    const double exposure = std::exp2(options_.look.exposure);
    std::map<std::string, Renderer> renderers;
    std::deque<Renderer::Picture> pictures;
    std::vector<Renderer::Picture*> all;
    std::vector<StudyWay> ways = studyWays(scene_, options_.look);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      StudyWay& way = ways[i];
      tell("whole pictures", 0.5 * double(i) / double(ways.size()));
      const WholeTruth* truth = stopped() ? nullptr : wholeTruth(way.model);
      if (!truth) return result_.missing.push_back("whole pictures");
      Renderer& renderer = renderers[antiAliasingText(way.look.antiAliasing)];
      const auto list = [&] { return makeDrawList(scene_.scene, scene_.bounds, way.look); };
      try {
        const Image picture = renderer.draw(gpu_, list(), way.look);
        way.error = wholeErrorOf(*truth, picture, result_.mask, exposure);
      } catch (const InputError&) {
        continue;  // the driver has fewer samples or pixels
      }
      pictures.push_back(renderer.begin(gpu_, list(), way.look));
      all.push_back(&pictures.back());
      result_.ways.push_back(std::move(way));
    }
    const int rounds = std::min(options_.rounds, options_.quick ? 12 : 30);
    auto times = timeInTurn(
        all, {3, rounds, result_.clock == FrameClock::gpu, stop_, [&](int round) {
                tell("whole pictures", 0.5 + 0.5 * double(round + 4) / double(rounds + 3));
              }});
    for (std::size_t i = 0; i < times.size(); ++i) result_.ways[i].times = std::move(times[i]);
    if (!result_.ways.empty() && !result_.ways[0].times.wall.empty() && result_.noFront.empty())
      makeWayFronts();
  }

  void makeWayFronts() {
    for (const Shading model : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
      StudyFront front{model, "rmse", {}, {}};
      std::vector<FrontCandidate> candidates;
      for (std::size_t i = 0; i < result_.ways.size(); ++i) {
        const StudyWay& way = result_.ways[i];
        if (way.model != model) continue;
        front.variants.push_back(int(i));
        candidates.push_back({way.error.picture.rmse, way.times.by(result_.clock)});
      }
      if (candidates.empty()) continue;
      front.places = paretoFront(candidates, result_.spread());
      result_.wayFronts.push_back(std::move(front));
    }
  }

  void measureSeries() {
    pictures_.clear();
    Renderer renderer;  // for pictures of another size
    SeriesTools tools{scene_, gpu_,  renderer, options_.look, options_.quick, 3,
                      30,     stop_, {},       result_.clock};
    tools.look.resolution = glm::max(glm::ivec2(1), options_.look.resolution / 2);
    tools.rounds = std::min(options_.rounds, options_.quick ? 10 : 30);
    using Make = std::optional<StudySeries> (*)(const SeriesTools&);
    const std::pair<const char*, Make> all[] = {{"exponent", exponentSeries},
                                                {"aliasing", aliasingSeries},
                                                {"distance", distanceSeries},
                                                {"motion", motionSeries},
                                                {"bumps", bumpsSeries},
                                                {"bumps-motion", bumpsMotionSeries},
                                                {"ior", iorSeries},
                                                {"incidence", incidenceSeries},
                                                {"fineness", finenessSeries},
                                                {"lights", lightSeries},
                                                {"resolution", resolutionSeries}};
    const auto begin = [&](const std::string& what) {
      tools.progress = [this, what](double share) { tell(what, share); };
      if (!tools.stopped()) return true;
      result_.missing.push_back(what);
      return false;
    };
    for (const auto& [name, make] : all) {
      if (!begin(std::string("series ") + name)) continue;
      if (auto series = make(tools)) result_.series.push_back(std::move(*series));
      if (tools.stopped()) result_.missing.push_back(std::string("part of series ") + name);
    }
    if (begin("specialisation")) result_.specialisations = specialisations(tools);
  }

  const StudyScene& scene_;
  const StudyOptions& options_;
  const Stop& stop_;
  const StudyProgress& progress_;
  GpuScene gpu_;
  std::optional<Renderer> renderer_{std::in_place};
  StudyResult result_;
  std::deque<Renderer::Picture> pictures_;  ///< of the variants, then floors and controls
  std::map<Shading, Radiances> truths_, driverTruths_;
};

}  // namespace

double exactFrame(const StudyScene& scene, const Look& given) {
  GpuScene gpu(scene.scene, scene.images);
  Renderer renderer;
  const Look look = exactLook(given, Shading::phong);
  Renderer::Picture picture =
      renderer.begin(gpu, makeDrawList(scene.scene, scene.bounds, look), look);
  timeOnce(picture);
  return std::min({timeOnce(picture), timeOnce(picture), timeOnce(picture)});
}

StudyResult study(const StudyScene& scene, const StudyOptions& options, const Stop& stop,
                  const StudyProgress& progress) {
  return Study(scene, options, stop, progress).run();
}

}  // namespace glint
