#include "painter.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "choice.h"
#include "coarse.h"
#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/picture_writer.h"

namespace glint::viewer {

namespace {

// A model in the pose drawn last, in the driver's memory.
struct PosedScene {
  std::shared_ptr<const Model> model;
  std::unique_ptr<GpuScene> scene;

  explicit operator bool() const { return scene != nullptr; }

  void begin(std::shared_ptr<const Model> with) {
    scene.reset();  // refers to the old model
    model = std::move(with);
    if (model) scene = std::make_unique<GpuScene>(model->scene, *model->images);
  }

  // Throws InputError for a pose that the file does not have.
  void pose(const Look& look) {
    const auto next = posed(model, glint::poseOf(look));
    if (next == model) return;
    scene->pose(next->scene, changedMeshes(*model, *next));
    model = next;
  }
};

// The coarse scene of a heavy model, drawn while something moves.
struct CoarseScene {
  std::shared_ptr<const Model> of;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<GpuScene> drawn;

  void begin(std::shared_ptr<const Model> with, Scene coarse, GpuScene& textures) {
    forget();
    of = std::move(with);
    scene = std::make_unique<Scene>(std::move(coarse));
    drawn = std::make_unique<GpuScene>(*scene, textures);
  }

  void forget() {
    drawn.reset();  // refers to the scene
    scene.reset();
    of.reset();
  }

  // The scene in this pose, or null if the vertices differ from those it was made of.
  GpuScene* inPose(const Model& posed) {
    if (!of || !changedMeshes(*of, posed).empty()) return nullptr;
    scene->instances = posed.scene.instances;
    return drawn.get();
  }
};

}  // namespace

struct Painter::Objects {
  std::unique_ptr<Renderer> renderer;
  PosedScene first;
  PosedScene second;   ///< for B, if it has a pose of its own
  CoarseScene coarse;  ///< uses the textures of `first`
  std::unique_ptr<OverlayDrawer> overlay;
  Chooser chooser;
  SharedPicture a, b, plain;
  Layer layer;
  Look layerLook;
  Overlay layerKind = Overlay::none;
  int layerMaterial = -1;
  bool layerCoarse = false;
};

Painter::Painter(const Window& window, const std::filesystem::path& glsl,
                 std::function<void()> wake)
    : context_(std::make_unique<OffscreenContext>(window)),
      wake_(std::move(wake)),
      objects_(std::make_unique<Objects>()) {
  GlslSources sources = glsl.empty() ? GlslSources() : GlslSources(glsl);
  worker_ = std::make_unique<Worker>([this] { context_->makeCurrent(); },
                                     [this] {
                                       *objects_ = {};
                                       context_->release();
                                     });
  worker_->queue([this, sources = std::move(sources)](const std::atomic<bool>&) {
    objects_->renderer = std::make_unique<Renderer>(sources);
  });
  coarsener_ = std::make_unique<Worker>([] { stepBack(3); });
}

Painter::~Painter() {
  coarsener_.reset();
  worker_.reset();
}

void Painter::setModel(std::shared_ptr<const Model> model) {
  int number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++model_;
    result_.reset();
    asked_.reset();
  }
  worker_->stopLatest();
  coarsener_->stopLatest();
  worker_->queue([this, model](const std::atomic<bool>&) {
    Objects& o = *objects_;
    // These pictures' driver objects refer to the old model's scene.
    o.a.reset();
    o.b.reset();
    o.plain.reset();
    o.layer.reset();
    o.chooser.forget();
    o.coarse.forget();
    o.second = {};
    o.first.begin(model);
  });
  if (model && primitivesDrawn(model->scene) > heavyTriangles)
    coarsener_->latest([this, model = std::move(model), number](const std::atomic<bool>& stop) {
      if (auto coarse = coarseScene(model->scene, coarseTriangles, stop))
        takeCoarse(model, std::move(*coarse), number);
    });
}

void Painter::takeCoarse(std::shared_ptr<const Model> model, Scene coarse, int number) {
  worker_->queue([this, model = std::move(model), number,
                  coarse = std::make_shared<Scene>(std::move(coarse))](const std::atomic<bool>&) {
    {
      const std::lock_guard lock(mutex_);
      if (number != model_) return;
    }
    objects_->coarse.begin(model, std::move(*coarse), *objects_->first.scene);
  });
}

void Painter::request(PaintRequest request) {
  int model = 0;
  {
    const std::lock_guard lock(mutex_);
    asked_ = request;
    model = model_;
  }
  worker_->latest([this, request = std::move(request), model](const std::atomic<bool>& stop) {
    paint(request, stop, model);
  });
}

void Painter::paint(const PaintRequest& request, const std::atomic<bool>& stop, int model) {
  Objects& o = *objects_;
  if (!o.first) return;
  PaintResult result;
  result.request = request;
  const auto drawn = [&](SharedPicture& kept, const Look& look, PosedScene& posed) {
    const auto start = Clock::now();
    posed.pose(look);
    const Model& its = *posed.model;
    const auto choice =
        o.chooser.choose(its.scene, its.bounds, look, request.size, request.preview);
    const double choosing = since(start);
    GpuScene* const coarse = request.preview ? o.coarse.inPose(its) : nullptr;
    Look definite = withChoice(look, *choice);
    if (request.preview) definite = withFewerLights(its.scene, its.bounds, definite);
    const bool fewerLights = request.preview && definite.light != look.light;
    const auto fits = [&] {
      return kept && kept->asked == look && kept->choice == choice &&
             kept->coarse == (coarse != nullptr) && kept->fewerLights == fewerLights;
    };
    if (!fits()) {
      auto picture =
          drawPicture(*o.renderer, coarse ? *coarse : *posed.scene, its.bounds, definite, stop);
      if (picture) {
        picture->coarse = coarse != nullptr;
        picture->fewerLights = fewerLights;
        picture->asked = look;
        picture->look = withChoice(look, *choice);
        picture->choice = choice;
        picture->milliseconds += choosing;
        kept = std::make_shared<const DrawnPicture>(std::move(*picture));
      }
    }
    return !stop && fits() ? kept : nullptr;
  };
  try {
    if (!(result.a = drawn(o.a, request.a, o.first))) return;
    result.model = o.first.model;
    if (request.b) {
      const bool samePlace = samePose(glint::poseOf(*request.b), glint::poseOf(request.a));
      if (!samePlace && !o.second) o.second.begin(o.first.model);
      if (!(result.b = drawn(o.b, *request.b, samePlace ? o.first : o.second))) return;
    }
    if (request.plain && !(result.plain = drawn(o.plain, *request.plain, o.first))) return;
    const bool laid = request.overlay == Overlay::wireframe ||
                      request.overlay == Overlay::normals || request.overlay == Overlay::facing ||
                      request.overlay == Overlay::outline;
    if (laid) {
      GpuScene* const coarse = request.preview ? o.coarse.inPose(*o.first.model) : nullptr;
      if (!o.layer || o.layerKind != request.overlay || o.layerLook != request.a ||
          o.layerMaterial != request.outlined || o.layerCoarse != (coarse != nullptr)) {
        if (!o.overlay) o.overlay = std::make_unique<OverlayDrawer>();
        o.layer = std::make_shared<const std::vector<std::uint8_t>>(
            o.overlay->draw(coarse ? *coarse : *o.first.scene, result.a->list, request.overlay,
                            request.outlined, request.a.resolution));
        o.layerKind = request.overlay;
        o.layerLook = request.a;
        o.layerMaterial = request.outlined;
        o.layerCoarse = coarse != nullptr;
      }
      result.overlay = o.layer;
    }
  } catch (const std::exception& error) {
    result.error = error.what();
  }
  {
    const std::lock_guard lock(mutex_);
    if (stop || model != model_) return;
    result_ = std::move(result);
    if (asked_ && *asked_ == request) asked_.reset();
  }
  ready_.notify_all();
  wake_();
}

std::optional<PaintResult> Painter::take(double seconds) {
  std::unique_lock lock(mutex_);
  if (seconds > 0 && asked_)
    ready_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [&] { return result_.has_value(); });
  return std::exchange(result_, std::nullopt);
}

bool Painter::pending() const {
  const std::lock_guard lock(mutex_);
  return asked_.has_value();
}

void Painter::report(Done done, std::string error) {
  {
    const std::lock_guard lock(mutex_);
    reports_.emplace_back(std::move(done), std::move(error));
  }
  wake_();
}

bool Painter::poll() {
  std::vector<std::pair<Done, std::string>> reports;
  {
    const std::lock_guard lock(mutex_);
    reports.swap(reports_);
  }
  for (const auto& [done, error] : reports) done(error);
  return !reports.empty();
}

bool Painter::saving() const {
  const std::lock_guard lock(mutex_);
  return saves_ > 0;
}

void Painter::save(const Look& look, const std::string& path, Done done) {
  {
    const std::lock_guard lock(mutex_);
    ++saves_;
  }
  worker_->queue([this, look, path, done = std::move(done)](const std::atomic<bool>&) {
    std::string text;
    try {
      Objects& o = *objects_;
      PosedScene& posed = o.first;
      if (!posed) throw InputError("there is no picture to save: open a model");
      posed.pose(look);
      writePicture(*o.renderer, *posed.scene, posed.model->bounds, look, posed.model->path.string(),
                   path);
    } catch (const std::exception& error) {
      text = error.what();
    }
    {
      const std::lock_guard lock(mutex_);
      --saves_;
    }
    report(done, text);
  });
}

void Painter::reload(const std::filesystem::path& glsl, const Look& trial, Done done) {
  worker_->queue([this, glsl, trial, done = std::move(done)](const std::atomic<bool>& stop) {
    std::string text;
    try {
      Objects& o = *objects_;
      auto fresh = std::make_unique<Renderer>(GlslSources(glsl));
      if (o.first) {
        o.first.pose(trial);
        const Bounds& bounds = o.first.model->bounds;
        const Look look = resolveLook(o.first.model->scene, bounds, trial).look;
        (void)drawPicture(*fresh, *o.first.scene, bounds, look, stop);
      }
      o.renderer = std::move(fresh);
      o.a.reset();
      o.b.reset();
      o.plain.reset();
    } catch (const std::exception& error) {
      text = error.what();
    }
    report(done, text);
  });
}

}  // namespace glint::viewer
