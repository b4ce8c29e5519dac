#include "glint/gltf/animation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

#include "glint/gltf/accessor.h"

namespace glint::gltf {
namespace {

constexpr std::size_t rotationWidth = 4;

/// All numbers of an accessor; integers are scaled if it is normalised or `normalize` is set.
std::vector<double> readNumbers(const Document& document, int accessor, bool normalize,
                                const std::string& label, Budget& budget,
                                const Messages& messages) {
  const AccessorView view = openAccessor(document, accessor, label, budget, messages);
  const auto width = static_cast<std::size_t>(view.components);
  budget.read(view.count * width);
  return readFlat(view, normalize);
}

/// The time of the last key of a sampler's input, without reading the others.
double lastTime(const Document& document, int accessor, const std::string& label, Budget& budget,
                const Messages& messages) {
  if (document.absentBufferOf(accessor) >= 0) return 0;
  const AccessorView view = openAccessor(document, accessor, label, budget, messages);
  if (view.count == 0 || view.components != 1 || view.componentType != 5126) return 0;
  float last = 0;
  std::memcpy(&last, view.data + (view.count - 1) * view.stride, sizeof last);
  return std::isfinite(last) && last > 0 ? double(last) : 0;
}

std::optional<AnimatedPath> pathOf(const std::string& text) {
  if (text == "translation") return AnimatedPath::translation;
  if (text == "rotation") return AnimatedPath::rotation;
  if (text == "scale") return AnimatedPath::scale;
  if (text == "weights") return AnimatedPath::weights;
  return std::nullopt;
}

Interpolation interpolationOf(Cursor sampler, Messages& messages) {
  const std::string text = sampler.member("interpolation").text("LINEAR");
  if (text == "STEP") return Interpolation::step;
  if (text == "CUBICSPLINE") return Interpolation::cubic;
  if (text != "LINEAR") {
    messages.warn(sampler.path() + " has the unknown interpolation \"" + printable(text, 20) +
                  "\", played as LINEAR");
  }
  return Interpolation::linear;
}

class Reader {
 public:
  Reader(Document& document, std::size_t index, Budget& budget, Messages& messages)
      : document_(document),
        budget_(budget),
        messages_(messages),
        root_(document.json, messages),
        from_(root_.member("animations").item(index)) {}

  Animation read() {
    for (const Cursor channel : from_.required("channels")) readChannel(channel);
    return std::move(animation_);
  }

 private:
  /// A sampler and whether its integers are fractions, as for rotations and weights.
  using Use = std::pair<std::size_t, bool>;

  void readChannel(Cursor channel) {
    const Cursor target = channel.required("target");
    const int node = target.member("node").index(document_.model.nodes.size());
    const std::string pathName = target.required("path").text();
    const std::optional<AnimatedPath> path = pathOf(pathName);
    const Cursor samplers = from_.required("samplers");
    const auto sampler =
        static_cast<std::size_t>(channel.required("sampler").index(samplers.size()));
    if (!path) {
      return leaveOut(channel, "moves \"" + printable(pathName, 40) + "\", which is not known");
    }
    if (node < 0) return;  // standard: for extensions, otherwise ignored
    Channel result;
    result.node = static_cast<std::size_t>(node);
    result.path = *path;
    const tinygltf::Node& moved = document_.model.nodes[result.node];
    if (*path == AnimatedPath::weights) {
      result.width = targetsOf(moved);
      if (result.width == 0) return leaveOut(channel, "moves the weights of a node that has none");
    } else {
      result.width = *path == AnimatedPath::rotation ? rotationWidth : 3;
      if (moved.matrix.size() == 16) {
        return leaveOut(channel, "moves nodes[" + std::to_string(node) + "], which has a matrix");
      }
    }
    const bool fraction = *path == AnimatedPath::rotation || *path == AnimatedPath::weights;
    const auto [known, isNew] = known_.try_emplace({sampler, fraction}, animation_.keys.size());
    if (isNew) animation_.keys.push_back(readKeys(samplers.item(sampler), fraction));
    result.keys = known->second;
    const Keys& keys = animation_.keys[result.keys];
    const std::size_t each = result.width * (keys.interpolation == Interpolation::cubic ? 3 : 1);
    if (keys.times.empty()) return leaveOut(channel, "has no keys that can be played");
    if (keys.values.size() != keys.times.size() * each) {
      return leaveOut(channel, "has " + std::to_string(keys.values.size()) + " numbers for " +
                                   std::to_string(keys.times.size()) + " keys of " +
                                   std::to_string(each));
    }
    animation_.channels.push_back(result);
  }

  std::size_t targetsOf(const tinygltf::Node& node) const {
    if (node.mesh < 0) return 0;
    std::size_t count = 0;
    for (const auto& p : document_.model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      count = std::max(count, p.targets.size());
    return count;
  }

  /// Without times if the keys cannot be played.
  Keys readKeys(Cursor sampler, bool fraction) {
    const std::size_t accessors = document_.model.accessors.size();
    const int input = sampler.required("input").index(accessors);
    const int output = sampler.required("output").index(accessors);
    Keys keys;
    keys.interpolation = interpolationOf(sampler, messages_);
    const auto& times = document_.model.accessors[static_cast<std::size_t>(input)];
    if (times.type != TINYGLTF_TYPE_SCALAR || times.componentType != 5126) return keys;
    if (document_.absentBufferOf(input) >= 0 || document_.absentBufferOf(output) >= 0) return keys;
    keys.times =
        readNumbers(document_, input, false, sampler.path() + ".input", budget_, messages_);
    keys.values =
        readNumbers(document_, output, fraction, sampler.path() + ".output", budget_, messages_);
    const auto finite = [](double x) { return std::isfinite(x); };
    const bool ascending = std::ranges::is_sorted(keys.times);
    if (!ascending || !std::ranges::all_of(keys.times, finite)) {
      messages_.warn(sampler.path() + " has times that decrease or are not finite");
      return {};
    }
    if (std::ranges::adjacent_find(keys.times) != keys.times.end()) {
      messages_.warn(sampler.path() + " has repeated times: the last key of each counts");
    }
    if (!std::ranges::all_of(keys.values, finite)) {
      messages_.warn(sampler.path() + " has values that are not finite");
      return {};
    }
    return keys;
  }

  void leaveOut(Cursor channel, const std::string& why) {
    messages_.warn(channel.path() + " " + why + ", left out");
  }

  Document& document_;
  Budget& budget_;
  Messages& messages_;
  Cursor root_, from_;
  Animation animation_;
  std::map<std::pair<std::size_t, bool>, std::size_t> known_;  ///< by sampler and `fraction`
};

std::vector<double> normalised(std::vector<double> q) {
  double square = 0;
  for (const double x : q) square += x * x;
  if (square > 0) {
    for (double& x : q) x /= std::sqrt(square);
  }
  return q;
}

std::vector<double> slerp(const std::vector<double>& a, std::vector<double> b, double t) {
  double cosine = 0;
  for (std::size_t i = 0; i < rotationWidth; ++i) cosine += a[i] * b[i];
  if (cosine < 0) {  // -b is the same rotation, and nearer
    for (double& x : b) x = -x;
    cosine = -cosine;
  }
  double shareA = 1 - t, shareB = t;
  if (cosine < 1 - 1e-9) {  // otherwise the sines lose all digits, and the chord equals the arc
    const double angle = std::acos(cosine), sine = std::sin(angle);
    shareA = std::sin((1 - t) * angle) / sine;
    shareB = std::sin(t * angle) / sine;
  }
  std::vector<double> mean(rotationWidth);
  for (std::size_t i = 0; i < rotationWidth; ++i) mean[i] = shareA * a[i] + shareB * b[i];
  return normalised(std::move(mean));
}

}  // namespace

std::vector<FileAnimation> listAnimations(Document& document, Budget& budget,
                                          const Messages& messages) {
  const Json* list = nullptr;
  if (const auto found = document.json.find("animations");
      found != document.json.end() && found->is_array()) {
    list = &*found;
  }
  std::vector<FileAnimation> result;
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const Json& animation = (*list)[i];
    FileAnimation& entry = result.emplace_back();
    if (!animation.is_object()) continue;
    if (const auto name = animation.find("name"); name != animation.end() && name->is_string())
      entry.name = printable(name->get<std::string>());
    const auto samplers = animation.find("samplers");
    if (samplers == animation.end() || !samplers->is_array()) continue;
    for (const Json& sampler : *samplers) {
      if (!sampler.is_object() || !sampler.contains("input")) continue;
      const Json& input = sampler["input"];
      if (!input.is_number_unsigned() || input >= document.model.accessors.size()) continue;
      const double last = lastTime(document, input.get<int>(),
                                   "animations[" + std::to_string(i) + "]", budget, messages);
      entry.duration = std::max(entry.duration, last);
    }
  }
  return result;
}

Animation readAnimation(Document& document, std::size_t index, Budget& budget, Messages& messages) {
  return Reader(document, index, budget, messages).read();
}

std::vector<double> valueAt(const Keys& keys, std::size_t width, bool rotation, double seconds) {
  const bool cubic = keys.interpolation == Interpolation::cubic;
  // Part k of a cubic key: in-tangent, value, out-tangent.
  const auto part = [&](std::size_t key, std::size_t k) {
    const auto first =
        keys.values.begin() + static_cast<std::ptrdiff_t>((cubic ? 3 * key + k : key) * width);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(width));
  };
  const auto value = [&](std::size_t key) {
    return rotation && !cubic ? normalised(part(key, 1)) : part(key, 1);
  };
  const auto finish = [&](const std::vector<double>& v) { return rotation ? normalised(v) : v; };
  const std::size_t next = static_cast<std::size_t>(
      std::upper_bound(keys.times.begin(), keys.times.end(), seconds) - keys.times.begin());
  if (next == 0) return finish(value(0));
  if (next == keys.times.size() || keys.interpolation == Interpolation::step) {
    return finish(value(next - 1));
  }
  const double span = keys.times[next] - keys.times[next - 1];
  const double t = (seconds - keys.times[next - 1]) / span;
  const std::vector<double> a = value(next - 1), b = value(next);
  if (!cubic && rotation) return slerp(a, b, t);
  std::vector<double> result(width);
  if (!cubic) {
    for (std::size_t i = 0; i < width; ++i) result[i] = (1 - t) * a[i] + t * b[i];
    return result;
  }
  const std::vector<double> out = part(next - 1, 2), in = part(next, 0);
  const double t2 = t * t, t3 = t2 * t;
  for (std::size_t i = 0; i < width; ++i) {
    result[i] = (2 * t3 - 3 * t2 + 1) * a[i] + span * (t3 - 2 * t2 + t) * out[i] +
                (3 * t2 - 2 * t3) * b[i] + span * (t3 - t2) * in[i];
  }
  return finish(result);
}

}  // namespace glint::gltf
