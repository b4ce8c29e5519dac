#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "glint/api/model_state.h"
#include "glint/budget/error_budget.h"
#include "glint/gl/context.h"
#include "glint/image/srgb.h"
#include "glint/options/parameters.h"
#include "glint/reference/renderer.h"
#include "glint/reference/terms.h"
#include "glint/render/picture_terms.h"
#include "glint/render/renderer.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

/// More programs than any one model needs.
constexpr std::size_t mostPrograms = 256;

/// Only one call at a time may use OpenGL: its functions are global and belong to the context that
/// was made current last.
std::mutex& glMutex() {
  static std::mutex mutex;
  return mutex;
}

/// The process that opened OpenGL; 0 if none has. Drivers keep threads, which fork() does not copy.
std::atomic<pid_t> glOwner = 0;

void checkFork() {
  const pid_t owner = glOwner;
  if (owner != 0 && owner != ::getpid())
    throw ContextError(
        "OpenGL was in use when this process was forked, so it does not work here: start processes "
        "before the first session (in Python: multiprocessing's \"spawn\"), or draw with the "
        "backend \"reference\"");
}

/// Keeps a context current for its lifetime.
class Current {
 public:
  explicit Current(Context& context) : context_(context) { context_.makeCurrent(); }
  ~Current() { context_.release(); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  Context& context_;
};

std::unique_ptr<Context> openedContext(const std::string& name) {
  const Backend backend = backendFromName(name, ", reference");
  auto context = openContext(backend);
  glOwner = ::getpid();
  return context;
}

}  // namespace

struct Session::State {
  /// A model in the driver's memory.
  struct Uploaded {
    std::weak_ptr<Model::State> model;
    GpuScene scene;
    int posed;
  };

  ~State() {
    if (!context) return;
    if (glOwner != ::getpid()) {  // belongs to the process that this one was forked from
      (void)context.release();
      (void)renderer.release();
      for (auto& [key, each] : uploaded) (void)each.release();
      return;
    }
    const std::lock_guard gl(glMutex());
    try {
      const Current current(*context);
      uploaded.clear();
      renderer.reset();
    } catch (const Error&) {
      // The driver is gone, and everything in it.
    }
    context.reset();
  }

  GpuScene& upload(const std::shared_ptr<Model::State>& model, const Look& look);
  /// draw(look, GpuScene*) with the posed model's GpuScene, or null without OpenGL.
  template <typename Draw>
  auto with(const std::shared_ptr<Model::State>& model, const Options& options, Draw draw);

  std::unique_ptr<Context> context;  ///< null: the reference
  std::unique_ptr<Renderer> renderer;
  std::map<Model::State*, std::unique_ptr<Uploaded>> uploaded;
  std::string description = "reference";
};

GpuScene& Session::State::upload(const std::shared_ptr<Model::State>& model, const Look& look) {
  std::erase_if(uploaded, [](const auto& each) { return each.second->model.expired(); });
  auto& own = uploaded[model.get()];
  const auto isThere = [&](int image, bool withNormalLengths) {
    return own && own->scene.hasImage(image, withNormalLengths);
  };
  if (own && own->posed != model->posed) {
    if (own->posed + 1 == model->posed)
      own->scene.pose(model->scene, model->changed);
    else
      own.reset();
  }
  DecodedImages images = decodeImages(model->scene, look, isThere);
  if (own)
    own->scene.addImages(std::move(images));
  else
    own.reset(new Uploaded{model, GpuScene(model->scene, std::move(images)), 0});
  own->posed = model->posed;
  return own->scene;
}

template <typename Draw>
auto Session::State::with(const std::shared_ptr<Model::State>& model, const Options& options,
                          Draw draw) {
  const Look look = lookFrom(options, context ? Look{} : referenceDefaults());
  if (!context) {
    checkReferenceAntiAliasing(look.antiAliasing);
  } else {
    checkFork();
  }
  std::unique_lock<std::mutex> gl;
  if (context) gl = std::unique_lock(glMutex());
  const std::lock_guard lock(model->mutex);
  model->pose(look);
  checkMaterialNames(model->scene, look);
  const Look resolved = withChoice(look, resolveLook(model->scene, model->bounds, look));
  if (!context) {
    const auto isThere = [&](int image, bool withNormalLengths) {
      const auto known = model->images.find(image);
      return known != model->images.end() && known->second.hasNormalLengths >= withNormalLengths;
    };
    for (auto& [image, decoded] : decodeImages(model->scene, resolved, isThere))
      model->images.insert_or_assign(image, std::move(decoded));
    return draw(resolved, nullptr);
  }
  const Current current(*context);
  renderer->limitPrograms(mostPrograms);
  return draw(resolved, &upload(model, resolved));
}

Session::Session(const std::string& backend) : state_(std::make_unique<State>()) {
  if (backend == "reference") return;
  checkFork();
  const std::lock_guard gl(glMutex());
  state_->context = openedContext(backend);
  const Current current(*state_->context);
  state_->renderer = std::make_unique<Renderer>();
  state_->description =
      std::string(backendName(state_->context->backend())) + ": " + glStrings().renderer;
}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

std::string Session::description() const { return state_->description; }

Image Session::draw(const Model& model, const Options& options) {
  Model::State& of = *model.state_;
  return state_->with(model.state_, options, [&](const Look& look, GpuScene* scene) {
    if (scene) return state_->renderer->draw(*scene, of.bounds, look);
    return ReferenceRenderer(of.scene, of.images, of.bounds, look).draw();
  });
}

Codes Session::drawCodes(const Model& model, const Options& options) {
  const Look look = lookFrom(options);
  const Image picture = draw(model, options);
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  Codes codes{picture.width, picture.height, std::vector<std::uint8_t>(4 * pixels)};
  const auto scale = float(std::exp2(look.exposure));
  if (look.noBackground) {
    encodeSrgb8(picture.values.data(), pixels, scale, codes.values.data());
    return codes;
  }
  std::uint8_t* const out = codes.values.data();
  encodeSrgb8Opaque(picture.values.data(), pixels, scale, out);
  for (std::size_t i = pixels; i-- > 0;) {  // from the end, so that nothing is overwritten
    std::copy_backward(out + 3 * i, out + 3 * i + 3, out + 4 * i + 3);
    out[4 * i + 3] = 255;
  }
  return codes;
}

std::map<std::string, Image> Session::layers(const Model& model, const Options& options,
                                             const std::vector<std::string>& names) {
  Model::State& of = *model.state_;
  return state_->with(model.state_, options, [&](const Look& look, GpuScene* scene) {
    const std::vector<PictureTerm> terms = termsOf(makeDrawList(of.scene, of.bounds, look), look);
    std::string known;
    for (const PictureTerm& term : terms) known += (known.empty() ? "" : ", ") + term.name;
    for (const std::string& name : names)
      if (std::ranges::none_of(terms, [&](const auto& each) { return each.name == name; }))
        throw InputError("layers: this look has no layer '" + name + "': there are " + known);
    std::map<std::string, Image> result;
    for (const PictureTerm& term : terms) {
      if (!names.empty() && std::ranges::find(names, term.name) == names.end()) continue;
      result[term.name] = scene ? drawTerm(*state_->renderer, *scene, of.bounds, look, term)
                                : drawReferenceTerm(of.scene, of.images, of.bounds, look, term);
    }
    return result;
  });
}

}  // namespace glint
