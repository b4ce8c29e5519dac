#include "glint/study/results.h"

#include <algorithm>
#include <cmath>

#include "glint/scene/look_text.h"
#include "glint/study/advice.h"
#include "glint/study/format.h"
#include "glint/study/report_words.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

/// The document being written.
class Results {
 public:
  Results(const StudyHead& head, const StudyResult& result) : head_(head), r_(result) {}

  std::string write(const std::string& command) {
    add("# Results\n\nMade by\n\n```sh\n" + command + "\n```\n\n");
    add(formatted(
        "of %s (%zu triangles, %d x %d pixels, %zu compared) on\n%s, %s. Times are of this "
        "machine: compare\nthem only with each other. They are %s; two count as different if "
        "they differ by more than the spread of\none program measured twice, %.1f %%, and each "
        "ratio is given with its 95 %% interval. [study.md](study.md)\ndescribes the "
        "measurements.\n",
        head_.model.c_str(), r_.triangles, head_.look.resolution.x, head_.look.resolution.y,
        r_.mask.pixels.size(), r_.gl.renderer.c_str(), r_.gl.version.c_str(),
        r_.clock == FrameClock::cpu   ? "CPU time, of all threads"
        : r_.clock == FrameClock::gpu ? "the GPU's time"
                                      : "wall time",
        100 * r_.spread()));
    if (!r_.complete) add("\n**Incomplete**: the study was ended early.\n");
    if (!r_.noFront.empty()) add("\n**" + r_.noFront + "**\n");
    lyon();
    blinn();
    gouraud();
    schlick();
    aliasing();
    specialisation();
    fronts();
    if (const std::string advice = adviceText(head_, r_); !advice.empty())
      add("\n## What to use\n\n" + wrapped(advice, 110) + "\n");
    return document_;
  }

 private:
  void add(const std::string& words) { document_ += words; }

  template <class Rows, class Name>
  static const auto* find(const Rows& rows, const std::string& name, Name nameOf) {
    const auto found = std::ranges::find(rows, name, nameOf);
    return found == rows.end() ? nullptr : &*found;
  }
  const VariantResult* variant(const std::string& name) const {
    return find(r_.variants, name, [](const VariantResult& v) { return v.variant.name; });
  }
  /// Null if it has no lines either.
  const StudySeries* series(const std::string& name) const {
    const StudySeries* const s = find(r_.series, name, &StudySeries::name);
    return s && !s->lines.empty() ? s : nullptr;
  }
  double median(const FrameTimes& times) const { return medianOf(times.by(r_.clock)); }
  /// "0.93 (0.91 to 0.95)": the time of a over that of b, with its 95 % interval.
  std::string ratio(const FrameTimes& a, const FrameTimes& b) const {
    return ratioText(timeRatio(a.by(r_.clock), b.by(r_.clock)));
  }
  bool faster(const FrameTimes& a, const FrameTimes& b) const {
    return isFaster(a.by(r_.clock), b.by(r_.clock), r_.spread());
  }
  /// "faster", "slower" or "the same", beyond the spread.
  std::string compared(const FrameTimes& a, const FrameTimes& b) const {
    if (!r_.noFront.empty()) return "undecided";
    if (faster(a, b)) return "faster beyond the spread";
    return faster(b, a) ? "slower beyond the spread" : "the same within the spread";
  }

  void lyon() {
    add("\n## Does Lyon's squaring still beat `pow`, and at which error?\n");
    for (const char* program : {"phong", "blinn-phong"}) {
      const VariantResult* pow = variant(std::string(program) + " pow");
      if (!pow || pow->times.wall.empty()) continue;
      Lyons lyons;
      std::string table;
      for (const VariantResult& v : r_.variants) {
        if (shadingName(v.variant.program) != program || v.times.wall.empty() || v.variant.bound)
          continue;
        const PictureError& e = v.errors[0].whole;
        if (v.variant.highlight.starts_with("lyon")) {
          ++lyons.count;
          if (faster(v.times, pow->times)) lyons.add(v, median(v.times));
        }
        table +=
            formatted("| `%s` | %.3f | %s | %.1e | %.1e | %.2f %% |\n", v.variant.highlight.c_str(),
                      median(v.times), &v == pow ? "1" : ratio(v.times, pow->times).c_str(), e.max,
                      e.rmse, 100 * e.offByMore);
      }
      add(std::string("\n**") + program + ".** " + lyonWords(lyons, *pow, program) +
          "\n\n| form | ms | time / `pow` | largest error | RMSE | codes off by > 1 |\n"
          "|---|---|---|---|---|---|\n" +
          table);
    }
    if (largestErrors("exponent", "the exponent α, `phong`")) {
      add("\nTimes do not depend on α, except that `integer` needs more multiplications for "
          "larger ones. Errors do; the\nsentences above hold for the exponents that they name.\n");
    }
  }

  /// The forms of Lyon's squaring that are faster than `pow`.
  struct Lyons {
    int count = 0, faster = 0;
    const VariantResult *best = nullptr, *fastest = nullptr;
    double least = 0;
    void add(const VariantResult& v, double milliseconds) {
      ++faster;
      if (!best || v.errors[0].whole.rmse < best->errors[0].whole.rmse) best = &v;
      if (!fastest || milliseconds < least) fastest = &v, least = milliseconds;
    }
  };

  /// "at α = 40", for the program's lobe.
  std::string atExponents(const char* program) const {
    std::string words;
    for (const double alpha : r_.exponents)
      words +=
          (words.empty() ? "at α = " : ", ") +
          formatted("%g", std::string(program) == "phong" ? alpha : alpha * head_.look.blinnFactor);
    return r_.exponents.size() <= 4
               ? words
               : formatted("at the exponents of its %zu materials", r_.exponents.size());
  }

  std::string lyonWords(const Lyons& lyons, const VariantResult& pow, const char* program) const {
    if (lyons.count == 0) return "None of Lyon's forms was measured.";
    if (!r_.noFront.empty()) return "Undecided: see above.";
    const std::string where = atExponents(program);
    if (lyons.faster == 0)
      return formatted(
          "No: %s none of %d forms of Lyon's squaring is faster than `pow` beyond the "
          "spread.",
          where.c_str(), lyons.count);
    std::string words = formatted(
        "Yes, %s: %d of %d forms of Lyon's squaring are faster than `pow` beyond the spread. The "
        "most accurate of them, `%s`, takes %s of its time, with an RMSE of %.1e and a largest "
        "error of %.1e.",
        where.c_str(), lyons.faster, lyons.count, lyons.best->variant.highlight.c_str(),
        ratio(lyons.best->times, pow.times).c_str(), lyons.best->errors[0].whole.rmse,
        lyons.best->errors[0].whole.max);
    const VariantResult* integer = variant(std::string(program) + " integer");
    if (!integer || integer->times.wall.empty())
      return words +
             " `integer` does not have this exponent (only whole ones from 1 to 128); where it "
             "applies, it is exact and takes about the same time.";
    return words + formatted(
                       " But the exponent is whole, and `integer` is exact: it takes %s of "
                       "the time of the fastest of Lyon's forms, `%s`: %s.",
                       ratio(integer->times, lyons.fastest->times).c_str(),
                       lyons.fastest->variant.highlight.c_str(),
                       compared(integer->times, lyons.fastest->times).c_str());
  }

  /// A row for each line, a column for each point; false if the series is not there.
  /// `withTimes`: also the first point's time, in ms.
  bool largestErrors(const char* name, const char* over, bool withTimes = false) {
    const StudySeries* const s = series(name);
    if (!s) return false;
    const std::vector<SeriesPoint>& points = s->lines[0].points;
    add(formatted("\nThe largest error over %s:\n\n| form |", over));
    for (const SeriesPoint& p : points) add(formatted(" %g |", p.x));
    if (withTimes) add(formatted(" ms at %g |", points[0].x));
    add("\n|---|");
    for (std::size_t i = 0; i < points.size() + withTimes; ++i) add("---|");
    for (const SeriesLine& l : s->lines) {
      add("\n| `" + l.name + "` |");
      for (const SeriesPoint& p : l.points) add(formatted(" %.1e |", p.max));
      if (withTimes) add(formatted(" %.2f |", l.points[0].milliseconds));
    }
    add("\n");
    return true;
  }

  void blinn() {
    add("\n## What does Blinn cost or save compared with Phong computed from D, and how far off "
        "is 4α?\n");
    const VariantResult *phong = variant("phong exact"), *half = variant("blinn-phong exact");
    if (phong && half && !phong->times.wall.empty()) {
      const VariantError* distance = errorAgainst(*half, Shading::phong);
      add("\nA frame of `blinn-phong` takes " + ratio(half->times, phong->times) +
          " of one of `phong`, both in the exact form: " + compared(half->times, phong->times) +
          ".");
      if (distance)
        add(
            formatted(" On this scene its picture differs from Phong's by at most %.1e, RMSE "
                      "%.1e.",
                      distance->whole.max, distance->whole.rmse));
      add("\n");
    }
    const StudySeries* s = series("incidence");
    if (!s) return;
    const auto line = [&](const char* name) { return find(s->lines, name, &SeriesLine::name); };
    const SeriesLine *four = line("blinn-phong 4α"), *cosine = line("blinn-phong 4α cos θ"),
                     *exact = line("phong");
    if (!four || !cosine || !exact) return;
    add("\n" + s->note +
        ":\n\n| θ | largest error of 4α | relative RMSE | largest error of "
        "4α cos θ | relative RMSE | ms `phong` | ms `blinn-phong` "
        "|\n|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < four->points.size(); ++i)
      add(formatted("| %g° | %.4f | %.4f | %.4f | %.4f | %.2f | %.2f |\n", four->points[i].x,
                    four->points[i].max, four->points[i].relativeRmse, cosine->points[i].max,
                    cosine->points[i].relativeRmse, exact->points[i].milliseconds,
                    four->points[i].milliseconds));
  }

  void gouraud() {
    const StudySeries* s = series("fineness");
    if (!s) return;
    add("\n## On how fine a mesh is Gouraud enough for a given error?\n\n" + s->note +
        ".\nThe largest h, edge over radius, (and number of triangles) for which the largest "
        "error is within E:\n\n| E |");
    std::vector<const SeriesLine*> lines;
    for (const SeriesLine& l : s->lines) lines.push_back(&l);
    for (const SeriesLine* l : lines) add(" " + l->name + " |");
    add("\n|---|");
    for (std::size_t i = 0; i < lines.size(); ++i) add("---|");
    for (const double bound : {0.1, 0.05, 0.02, 0.01, 0.005, 0.001}) {
      add(formatted("\n| %g |", bound));
      for (const SeriesLine* l : lines) {
        std::string cell = " not reached |";
        for (std::size_t i = 0; i < l->points.size(); ++i)
          if (std::all_of(l->points.begin() + std::ptrdiff_t(i), l->points.end(),
                          [&](const SeriesPoint& p) { return p.max <= bound; })) {
            cell = formatted(" %.3f (%d) |", l->points[i].x, 20 << 2 * (i + 1));
            break;
          }
        add(cell);
      }
    }
    add("\n\nOrders of convergence of the last step, for RMSE and largest error (1, 2 and 2 are "
        "expected for `flat`, `gouraud` and per pixel):");
    for (const SeriesLine* l : lines)
      add(formatted("%s %s %.2f and %.2f", l == lines[0] ? "" : ";", l->name.c_str(), l->orderRmse,
                    l->orderMax));
    add(".\nThe largest error is about (2/3) m_s α h², so Gouraud is enough for h up to √(1.5 E "
        "/ (m_s α)).\n");
  }

  void schlick() {
    add("\n## Is Schlick ever on the front when the rational form exists?\n\n");
    std::string on;
    bool any = false;
    for (const StudyFront& front : r_.fronts) {
      if (front.model != Shading::environment) continue;
      any = true;
      for (std::size_t i = 0; i < front.variants.size(); ++i)
        if (front.places[i].onFront &&
            r_.variants[std::size_t(front.variants[i])].variant.fresnel == "schlick")
          on += (on.empty() ? "" : ", ") + front.metric;
    }
    if (!any) {
      add(r_.noFront.empty() ? "The environment was not measured.\n" : "Undecided: see above.\n");
      return;
    }
    add(variant("environment rational") ? "" : "(There is no rational form here.) ");
    const VariantResult *approximate = variant("environment schlick"),
                        *rational = variant("environment rational");
    add(on.empty() ? "No, for no metric" : "Yes, for the metrics " + on);
    if (approximate && rational && !approximate->times.wall.empty())
      add(": it takes " + ratio(approximate->times, rational->times) +
          " of the time of `rational`, " + compared(approximate->times, rational->times));
    add(".\n");
    add("\n| form | ms | time / exact | largest error | RMSE | FLIP "
        "|\n|---|---|---|---|---|---|\n");
    const VariantResult* exact = variant("environment exact");
    for (const VariantResult& v : r_.variants)
      if (v.variant.program == Shading::environment && exact && !v.times.wall.empty() &&
          !v.variant.bound)
        add(formatted("| `%s` | %.3f | %s | %.1e | %.1e | %.1e |\n", v.variant.fresnel.c_str(),
                      median(v.times), &v == exact ? "1" : ratio(v.times, exact->times).c_str(),
                      v.errors[0].whole.max, v.errors[0].whole.rmse, v.errors[0].flip));
    largestErrors("ior", "the index n");
  }

  const StudyWay* way(const std::string& name) const {
    for (const StudyWay& each : r_.ways)
      if (each.name == name && !each.times.wall.empty()) return &each;
    return nullptr;
  }

  void aliasing() {
    if (r_.ways.empty()) return;
    add("\n## What does aliasing add, and what reduces it?\n\nThe whole error, from form, "
        "interpolation, driver and aliasing, compared with the exact form supersampled "
        "in\ndouble: inside, where a surface covers all of a pixel, and for the whole picture. "
        "`kaplanyan` and `toksvig` are\nvalues of `--specular-antialiasing`. The RMSE of the "
        "truth itself is below");
    for (const WholeTruth& truth : r_.wholeTruths)
      add(formatted("%s %.1e (%s, %d x %d samples)", &truth == &r_.wholeTruths[0] ? "" : ",",
                    truth.own.rmse, std::string(shadingName(truth.model)).c_str(), truth.samples,
                    truth.samples));
    add(".\n");
    for (const char* program : {"phong", "blinn-phong"}) {
      const std::string exact = std::string(program) + " exact";
      const VariantResult* single = variant(exact);
      const StudyWay *plain = way(exact),
                     *filtered = way(std::string(program) + " gaussian kaplanyan");
      if (!single || !plain || !filtered) continue;
      add(
          formatted("\n**%s.** Inside, one exact sample a pixel is off by %.1e at most, RMSE %.1e: "
                    "%.0f times what the driver and rounding add.\n`gaussian kaplanyan` is off by "
                    "%.1e, RMSE %.1e",
                    program, plain->error.inside.max, plain->error.inside.rmse,
                    plain->error.inside.rmse / std::max(single->errors[0].whole.rmse, 1e-12),
                    filtered->error.inside.max, filtered->error.inside.rmse));
      add(r_.noFront.empty()
              ? ", and takes " + ratio(filtered->times, plain->times) +
                    " of the time: " + compared(filtered->times, plain->times) + ".\n"
              : std::string(".\n"));
    }
    add("\n| way | ms | time / exact | largest inside | RMSE inside | RMSE of the picture "
        "|\n|---|---|---|---|---|---|\n");
    for (const StudyWay& each : r_.ways) {
      const StudyWay* exact = way(std::string(shadingName(each.model)) + " exact");
      if (!exact || each.times.wall.empty()) continue;
      add(formatted("| `%s` | %.3f | %s | %.1e | %.1e | %.1e |\n", each.name.c_str(),
                    median(each.times),
                    &each == exact ? "1" : ratio(each.times, exact->times).c_str(),
                    each.error.inside.max, each.error.inside.rmse, each.error.picture.rmse));
    }
    largestErrors("aliasing",
                  "the exponent α, `phong`, 128 pixels wide, compared with 16 x 16 samples");
    largestErrors("distance", "the width of the model in pixels as it moves away, likewise", true);
    largestErrors("motion",
                  "the exponent α, for the change when the model moves by 0.5 and 0.25 pixels");
    largestErrors("bumps", "the width in pixels of a sphere with a normal map of small bumps",
                  true);
    largestErrors("bumps-motion", "the exponent α, for the change when that sphere moves likewise");
  }

  void specialisation() {
    if (r_.specialisations.empty()) return;
    add("\n## What does \"only what the scene needs\" save?\n\nThe same picture by a shader with "
        "every feature of the program: textures, vertex colours, emission, alpha,\nlights of each "
        "kind, both sides, normals renormalised everywhere.\n\n| program | compile, ms | first "
        "frame, ms | a frame, ms | frame: needed / everything | pictures differ by |\n"
        "|---|---|---|---|---|---|\n");
    for (const Specialisation& s : r_.specialisations)
      add(formatted("| %s | %.1f of %.1f | %.1f of %.1f | %.2f of %.2f | %s | %.1e |\n",
                    s.program.c_str(), s.compile, s.generalCompile, s.first, s.generalFirst,
                    median(s.times), median(s.generalTimes), ratio(s.times, s.generalTimes).c_str(),
                    s.difference));
  }

  void fronts() {
    if (r_.fronts.empty()) return;
    add("\n## The fronts\n\nFrom the most accurate to the fastest, the variants that are "
        "certainly on the front: faster, beyond the spread,\nthan all that are as accurate. Each "
        "is given with its time relative to the one before it, and the 95 % interval\nof that "
        "ratio. Then the number of undecided ones: they are not certainly on the front, and no "
        "other that is as\naccurate is certainly faster. All others are certainly dominated.\n\n");
    for (const StudyFront& front : r_.fronts) {
      if (front.metric != "rmse" && front.metric != "max") continue;
      std::vector<std::pair<double, const VariantResult*>> members;
      int open = 0;
      for (std::size_t i = 0; i < front.variants.size(); ++i) {
        const FrontPlace& place = front.places[i];
        open += !place.onFront && !place.isSlower;
        if (!place.onFront) continue;
        const VariantResult& v = r_.variants[std::size_t(front.variants[i])];
        members.emplace_back(metricOf(*errorAgainst(v, front.model), front.metric), &v);
      }
      std::sort(members.begin(), members.end());
      add("* " + std::string(shadingName(front.model)) + ", " +
          (front.metric == "max" ? "largest error" : "RMSE") + ": ");
      for (std::size_t i = 0; i < members.size(); ++i) {
        const auto& [error, v] = members[i];
        add((i == 0 ? "" : ", ") +
            formatted("%s (%.1e, %.2f ms", v->variant.name.c_str(), error, median(v->times)));
        add(i == 0 ? ")" : "; " + ratio(v->times, members[i - 1].second->times) + ")");
      }
      add(formatted("%s%d of %d undecided\n", members.empty() ? "" : "; ", open,
                    int(front.variants.size())));
    }
  }

  const StudyHead& head_;
  const StudyResult& r_;
  std::string document_;
};

}  // namespace

std::string studyResults(const StudyHead& head, const StudyResult& result,
                         const std::string& command) {
  return Results(head, result).write(command);
}

}  // namespace glint
