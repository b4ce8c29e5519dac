#include "model_list.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <system_error>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"
#include "interrupt.h"

namespace glint {
namespace {

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

ModelList::ModelList(std::vector<std::string> models) : models_(std::move(models)) {
  count_ = models_.size();
}

ModelList::ModelList(const std::string& path) : path_(path == "-" ? "standard input" : path) {
  file_ = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                      : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
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
  number_ = 0;
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
    while (entry.model.empty()) {
      if (!readLine(entry.model)) return {};
      if (!entry.model.empty() && entry.model.back() == '\r') entry.model.pop_back();
      // Editors that save "UTF-8 with BOM" put U+FEFF at the beginning of a file.
      if (number_ == 0 && entry.model.starts_with("\xEF\xBB\xBF")) entry.model.erase(0, 3);
    }
    if (const auto tab = entry.model.find('\t'); tab != std::string::npos) {
      entry.output = entry.model.substr(tab + 1);
      entry.model.erase(tab);
      if (entry.model.empty() || entry.output.empty() ||
          entry.output.find('\t') != std::string::npos)
        throw InputError("--from-list: " + printablePath(path_) + ": model " +
                         std::to_string(number_) +
                         ": give a model, or a model, a TAB and the name "
                         "of its picture");
    }
  }
  entry.number = number_++;
  return entry;
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
