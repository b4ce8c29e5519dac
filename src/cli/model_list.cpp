#include "model_list.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <queue>
#include <system_error>
#include <utility>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/json_text.h"
#include "glint/image/read_files.h"
#include "interrupt.h"
#include "stdin_model.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longestLine = std::size_t(1) << 16;

}  // namespace

Shard parseShard(const std::string& text) {
  Shard shard;
  const char *begin = text.data(), *end = begin + text.size();
  const auto part = std::from_chars(begin, end, shard.part);
  const bool slash = part.ec == std::errc() && part.ptr != end && *part.ptr == '/';
  const auto of = slash ? std::from_chars(part.ptr + 1, end, shard.of) : part;
  if (!slash || of.ec != std::errc() || of.ptr != end || shard.part < 1 || shard.part > shard.of)
    throw InputError("--shard: '" + printablePath(text) +
                     "' is not K/N with whole numbers, K from 1 to N");
  return shard;
}

std::vector<bool> membersOf(const Shard& shard, const std::vector<double>& costs) {
  std::vector<bool> members(costs.size());
  double sum = 0, largest = 0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    members[i] = shard.has(i);
    sum += costs[i];
    largest = std::max(largest, costs[i]);
  }
  if (largest * double(costs.size()) <= 2 * sum) return members;
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return costs[i]; });
  using Load = std::pair<double, std::size_t>;  // the load and the shard's number
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::size_t k = 0; k < std::min(shard.of, costs.size()); ++k) loads.emplace(0, k);
  for (const std::size_t i : order) {
    const auto [load, number] = loads.top();
    loads.pop();
    loads.emplace(load + costs[i], number);
    members[i] = number + 1 == shard.part;
  }
  return members;
}

ModelList::ModelList(std::vector<std::string> models) : models_(std::move(models)) {
  count_ = models_.size();
}

ModelList::ModelList(const std::string& path) : path_(path == "-" ? "standard input" : path) {
  // O_NONBLOCK: opening a FIFO must not wait for its writer; fill() does, and a signal ends that.
  file_ = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                      : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status {};
  if (file_ < 0 || ::fstat(file_, &status) != 0)
    throw InputError("--from-list: " + printablePath(path_) + ": " +
                     std::generic_category().message(errno) + ": check the path");
  if (S_ISDIR(status.st_mode))
    throw InputError("--from-list: " + printablePath(path_) +
                     ": Is a directory: give a file with a model on each line");
  seekable_ = S_ISREG(status.st_mode);
  noteReadFile(file_, path);
  if (seekable_) begin_ = ::lseek(file_, 0, SEEK_CUR);
}

ModelList::~ModelList() {
  if (file_ >= 0) ::close(file_);
}

void ModelList::lookThrough(const std::function<void(const ModelEntry&)>& visit) {
  if (file_ >= 0 && !seekable_) return;
  while (const auto entry = next()) visit(*entry);
  count_ = number_;
  number_ = line_ = 0;
  if (file_ < 0) return;
  ::lseek(file_, begin_, SEEK_SET);
  buffer_.clear();
  at_ = 0;
  ended_ = false;
}

std::optional<ModelEntry> ModelList::next() {
  ModelEntry entry;
  if (file_ < 0) {
    if (number_ == models_.size() || Interrupt::signal() != 0) return {};
    entry.model = models_[number_];
  } else {
    std::string line;
    while (line.empty()) {
      if (!readLine(line)) return {};
      if (!line.empty() && line.back() == '\r') line.pop_back();
      // Editors that save "UTF-8 with BOM" put U+FEFF at the beginning of a file.
      if (line_++ == 0 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    }
    try {
      readEntry(line, entry);
    } catch (const InputError& error) {
      entry.error = "--from-list: " + printablePath(path_) + ": line " + std::to_string(line_) +
                    ": " + error.what();
    }
  }
  entry.model = localPath(entry.model);
  entry.number = number_++;
  return entry;
}

void ModelList::readEntry(const std::string& line, ModelEntry& entry) const {
  if (!line.starts_with('{')) {
    const auto tab = line.find('\t');
    entry.model = line.substr(0, tab);
    if (tab == std::string::npos) return;
    entry.output = line.substr(tab + 1);
    if (entry.model.empty() || entry.output.empty() || entry.output.find('\t') != std::string::npos)
      throw InputError("give a model, or a model, a TAB and the name of its picture");
    return;
  }
  std::string fault;
  const std::optional<Json> json = parseJsonText<Json>(line, fault);
  if (!json) throw InputError(fault + ": write a path that begins with { as ./{");
  const auto text = [](const std::string& key, const Json& value) {
    if (!value.is_string() || value.get<std::string>().empty())
      throw InputError("\"" + key + "\": give a string that is not empty");
    return value.get<std::string>();
  };
  for (const auto& [key, value] : json->items()) {
    if (key == "model")
      entry.model = text(key, value);
    else if (key == "output")
      entry.output = text(key, value);
    else if (key == "look" && value.is_object())
      entry.look = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    else if (key == "look" && value.is_string())
      entry.lookFile = text(key, value);
    else if (key == "look")
      throw InputError("\"look\": give an object with keys of a look, or the name of a look file");
    else
      throw InputError("unknown key \"" + key + "\": give model, output and look");
  }
  if (entry.model.empty()) throw InputError("no \"model\": give the path of a model");
}

bool ModelList::readLine(std::string& line) {
  line.clear();
  for (;;) {
    for (; at_ < buffer_.size(); ++at_) {
      if (buffer_[at_] == '\n') {
        ++at_;
        return true;
      }
      line += buffer_[at_];
    }
    if (line.size() > longestLine)
      throw InputError("--from-list: " + printablePath(path_) +
                       ": a line too long for a path: give a text file with a model on each line");
    if (!fill()) return !line.empty() && Interrupt::signal() == 0;
  }
}

bool ModelList::fill() {
  buffer_.clear();
  at_ = 0;
  while (!ended_ && Interrupt::signal() == 0) {
    pollfd ready[2] = {{file_, POLLIN, 0}, {Interrupt::descriptor(), POLLIN, 0}};
    if (::poll(ready, 2, -1) < 0 && errno != EINTR) break;
    if (ready[1].revents != 0 || ready[0].revents == 0) continue;
    buffer_.resize(std::size_t(1) << 16);
    const ssize_t count = ::read(file_, buffer_.data(), buffer_.size());
    buffer_.resize(count > 0 ? std::size_t(count) : 0);
    if (count > 0) return true;
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0)
      throw InputError("--from-list: " + printablePath(path_) + ": " +
                       std::generic_category().message(errno) + ": check the list");
    ended_ = true;
  }
  return false;
}

}  // namespace glint
