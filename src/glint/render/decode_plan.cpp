#include "glint/render/decode_plan.h"

#include <algorithm>

#include "glint/image/error.h"
#include "glint/render/decode.h"

namespace glint::detail {
namespace {

constexpr std::uint64_t mebibyte = std::uint64_t(1) << 20;

std::string sizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

std::string mebibytes(std::uint64_t bytes) {
  return std::to_string((bytes + mebibyte - 1) / mebibyte) + " MiB";
}

std::uint64_t sumOf(const std::vector<DecodeJob>& jobs) {
  std::uint64_t sum = 0;
  for (const DecodeJob& job : jobs) sum += job.kept();
  return sum;
}

[[noreturn]] void refuse(const DecodeJob& job, const std::string& what, std::uint64_t limit) {
  throw InputError("the image " + job.name + " of " +
                   sizeText(job.header.width, job.header.height) + ": " + what + " more than " +
                   mebibytes(limit) + ": make it smaller or raise --decode-limit");
}

}  // namespace

int DecodeJob::width() const { return std::max(1, header.width >> halvings); }
int DecodeJob::height() const { return std::max(1, header.height >> halvings); }

std::uint64_t DecodeJob::kept() const {
  const std::uint64_t bytes = std::uint64_t(4) * width() * height();
  return hasLevels ? bytes + bytes / 3 : bytes;
}

std::uint64_t DecodeJob::atWork() const {
  const std::uint64_t decoder = halvings > 0 ? header.reducedWork : header.work;
  // The first two smaller levels are held as floats: 16 bytes for a quarter and a sixteenth of the
  // pixels.
  const std::uint64_t levels = hasLevels ? std::uint64_t(5) * width() * height() : 0;
  return kept() + std::max(decoder, levels);
}

std::vector<std::string> planDecoding(std::vector<DecodeJob>& jobs, std::uint64_t limit,
                                      int useful) {
  std::vector<bool> tooLong(jobs.size(), false);
  for (std::size_t i = 0; i < jobs.size(); ++i)
    for (; std::max(jobs[i].width(), jobs[i].height()) > maxTextureSide; ++jobs[i].halvings)
      tooLong[i] = true;
  // A picture that is halved while it is read still takes the time of its full size.
  std::uint64_t full = 0;
  for (const DecodeJob& job : jobs) full += std::uint64_t(4) * job.header.width * job.header.height;
  if (full > 3 * limit)
    refuse(*std::ranges::max_element(jobs, {}, &DecodeJob::kept),
           "the model's textures have " + mebibytes(full) + " at full size,", 3 * limit);
  while (sumOf(jobs) > limit) {
    const auto largest = std::ranges::max_element(jobs, {}, [&](const DecodeJob& job) {
      return std::max(job.width(), job.height()) > useful ? job.kept() : 0;
    });
    if (std::max(largest->width(), largest->height()) <= useful)
      refuse(*std::ranges::max_element(jobs, {}, &DecodeJob::kept),
             "decoded, the model's textures take " + mebibytes(sumOf(jobs)) + ",", limit);
    ++largest->halvings;
  }
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const DecodeJob& job = jobs[i];
    if (job.atWork() > 3 * limit)
      refuse(job, "decoding it takes " + mebibytes(job.atWork()) + ",", 3 * limit);
    if (job.halvings == 0) continue;
    warnings.push_back("the image " + job.name + " of " +
                       sizeText(job.header.width, job.header.height) + " is reduced to " +
                       sizeText(job.width(), job.height()) +
                       (tooLong[i] ? ", since textures have at most " +
                                         std::to_string(maxTextureSide) + " pixels per side"
                                   : ", since all textures would take more than " +
                                         mebibytes(limit) + " (--decode-limit)"));
  }
  return warnings;
}

}  // namespace glint::detail
