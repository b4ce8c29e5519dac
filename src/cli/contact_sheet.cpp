#include "contact_sheet.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"
#include "interrupt.h"

namespace glint {
namespace {

constexpr int lineHeight = 12;  // of the font, in font pixels
constexpr int mostSteps = 1000;
constexpr int longestSide = 65535;

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw InputError("--sweep " + printablePath(text) + ": " + what);
}

const Parameter* lookNumber(const std::string& name) {
  for (const Parameter& p : lookParameters())
    if (p.kind == ParameterKind::number && (p.name == name || "--" + p.name == name)) return &p;
  return nullptr;
}

const MaterialParameter* materialNumber(const std::string& name) {
  for (const MaterialParameter& p : materialParameters())
    if (p.name == name) return &p;
  return nullptr;
}

std::string knownNames() {
  std::string names;
  for (const MaterialParameter& p : materialParameters()) names += std::string(p.name) + ", ";
  for (const Parameter& p : lookParameters())
    if (p.kind == ParameterKind::number) names += p.name + ", ";
  names.resize(names.size() - 2);
  return names;
}

bool readNumber(const std::string& text, double& value) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(value);
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// Calls put(x, y, width, height) for each block of the text, in the font's pixels.
template <class Put>
void forEachBlock(const std::string& text, Put put) {
  struct Vertex {
    float x, y, z;
    unsigned char color[4];
  };
  std::string printable = text;
  for (char& c : printable)
    if (c < 32 || c > 126) c = '?';
  std::vector<Vertex> vertices(printable.size() * 64 + 64);
  const int blocks = stb_easy_font_print(0, 0, printable.data(), nullptr, vertices.data(),
                                         int(vertices.size() * sizeof(Vertex)));
  for (int i = 0; i < blocks; ++i) {
    const Vertex& a = vertices[std::size_t(4 * i)];
    const Vertex& c = vertices[std::size_t(4 * i + 2)];
    put(int(a.x), int(a.y), int(c.x) - int(a.x), int(c.y) - int(a.y));
  }
}

int textWidth(const std::string& text) {
  int width = 0;
  forEachBlock(text, [&](int x, int, int w, int) { width = std::max(width, x + w); });
  return width;
}

void fill(Image& image, int x, int y, int width, int height, float value) {
  for (int row = std::max(y, 0); row < std::min(y + height, image.height); ++row)
    for (int column = std::max(x, 0); column < std::min(x + width, image.width); ++column) {
      float* const pixel = image.row(row) + 4 * std::ptrdiff_t(column);
      pixel[0] = pixel[1] = pixel[2] = value;
      pixel[3] = 1;
    }
}

}  // namespace

Sweep::Sweep(const std::string& text) : text_(text) {
  const std::size_t colon = text.starts_with('"') ? endOfMaterialKey(text) : std::string::npos;
  const auto equals = text.find('=', colon == std::string::npos ? 0 : colon);
  if (equals == std::string::npos) refuse(text, "give KEY=FROM:TO:STEPS");
  key_ = text.substr(0, equals);
  if (key_.starts_with("--")) key_.erase(0, 2);
  bool logarithmic = false;
  if (const Parameter* p = lookNumber(key_)) {
    logarithmic = p->slider.logarithmic;
  } else {
    const auto end = key_.rfind(':');
    if (end != std::string::npos) {
      material_ = key_.substr(0, end);
      key_.erase(0, end + 1);
    }
    const MaterialParameter* const m = materialNumber(key_);
    if (!m)
      refuse(text, "there is no numeric parameter '" + key_ + "': give one of " + knownNames());
    logarithmic = m->slider.logarithmic;
    ofMaterial_ = true;
  }
  const auto parts = split(text.substr(equals + 1));
  double from = 0, to = 0, steps = 0;
  if (parts.size() < 3 || parts.size() > 4 || !readNumber(parts[0], from) ||
      !readNumber(parts[1], to) || !readNumber(parts[2], steps))
    refuse(text, "give KEY=FROM:TO:STEPS, optionally followed by :log or :linear");
  if (steps != std::floor(steps) || steps < 2 || steps > mostSteps)
    refuse(text, "give from 2 to " + std::to_string(mostSteps) + " steps");
  if (parts.size() == 4) {
    if (parts[3] != "log" && parts[3] != "linear")
      refuse(text, "'" + parts[3] + "' is neither log nor linear");
    logarithmic = parts[3] == "log";
  }
  if (logarithmic && !(from > 0 && to > 0))
    refuse(text, "logarithmic steps need numbers above 0: give others, or use :linear");
  for (int i = 0; i < int(steps); ++i) {
    const double share = i / (steps - 1);
    values_.push_back(i == 0                ? from
                      : i + 1 == int(steps) ? to
                      : logarithmic         ? from * std::pow(to / from, share)
                                            : from + (to - from) * share);
  }
  for (int i = 0; i < int(steps); ++i) {  // throws for values out of range
    Look look;
    apply(look, i);
  }
}

void Sweep::apply(Look& look, int step) const {
  const std::string value = numberText(values_[std::size_t(step)]);
  if (!ofMaterial_) return lookNumber(key_)->read(look, value);
  if (material_.empty())  // applies to every material, including those the look edits by name
    for (auto& [name, edit] : look.material) (edit.*materialNumber(key_)->edit).reset();
  setMaterialEdit(look, material_, key_, value);
}

std::string Sweep::label(int step) const {
  char number[32];
  std::snprintf(number, sizeof number, "%.4g", values_[std::size_t(step)]);
  return (material_.empty() ? "" : material_ + ":") + key_ + " " + number;
}

ContactSheet::ContactSheet(Stage& stage, const std::vector<Sweep>& sweeps, const Look& look)
    : stage_(stage), sweeps_(sweeps), look_(look) {
  const int first = sweeps[0].steps();
  columns_ = sweeps.size() > 1 ? first : first <= 6 ? first : int(std::ceil(std::sqrt(first)));
  rows_ = sweeps.size() > 1 ? sweeps[1].steps() : (first + columns_ - 1) / columns_;
  cells_ = sweeps.size() > 1 ? columns_ * rows_ : first;
  gap_ = std::max(2, look.resolution.x / 64);
  int widest = 1;
  for (const Sweep& sweep : sweeps)
    for (int i = 0; i < sweep.steps(); ++i) widest = std::max(widest, textWidth(sweep.label(i)));
  textScale_ = std::clamp(std::min(look.resolution.x / widest, look.resolution.x / 160), 1, 16);
  const double across = double(columns_) * (look.resolution.x + gap_) + gap_;
  const double down = double(rows_) * size().y / rows_;
  if (across > longestSide || down > longestSide)
    throw InputError("--sweep: a sheet of " + std::to_string(columns_) + " x " +
                     std::to_string(rows_) +
                     " pictures is too large: give fewer steps or a "
                     "smaller --resolution");
}

glm::ivec2 ContactSheet::size() const {
  const int text = int(sweeps_.size()) * lineHeight * textScale_;
  return {columns_ * (look_.resolution.x + gap_) + gap_,
          rows_ * (look_.resolution.y + text + 2 * gap_)};
}

bool ContactSheet::draw(Image& rows) {
  if (row_ == rows_) return false;
  rows.width = size().x;
  rows.height = size().y / rows_;
  rows.values.assign(std::size_t(4) * rows.width * rows.height, 0.0f);
  fill(rows, 0, 0, rows.width, rows.height, 0);
  for (int column = 0; column < columns_ && row_ * columns_ + column < cells_; ++column)
    if (Interrupt::signal() == 0) drawCell(column, rows);
  ++row_;
  return true;
}

void ContactSheet::drawCell(int column, Image& rows) {
  Look look = look_;
  std::vector<std::string> labels;
  const auto use = [&](const Sweep& sweep, int step) {
    sweep.apply(look, step);
    labels.push_back(sweep.label(step));
  };
  use(sweeps_[0], sweeps_.size() > 1 ? column : row_ * columns_ + column);
  if (sweeps_.size() > 1) use(sweeps_[1], row_);

  const int left = gap_ + column * (look_.resolution.x + gap_);
  last_ = stage_.picture(look);
  Image band;
  int y = gap_;
  while (last_->draw(band))
    for (int i = 0; i < band.height; ++i, ++y)
      std::memcpy(rows.row(y) + 4 * std::ptrdiff_t(left), band.row(i),
                  sizeof(float) * 4 * std::size_t(band.width));
  const RenderTimes times = last_->times();
  times_.compile += times.compile;
  times_.draw += times.draw;
  times_.read += times.read;
  // White after the exposure is applied.
  const float white = float(std::exp2(-look_.exposure));
  y += gap_ / 2 + textScale_;
  for (const std::string& label : labels) {
    forEachBlock(label, [&](int bx, int by, int width, int height) {
      fill(rows, left + bx * textScale_, y + by * textScale_, width * textScale_,
           height * textScale_, white);
    });
    y += lineHeight * textScale_;
  }
}

}  // namespace glint
