#include "recovery.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/json_text.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"

namespace glint::viewer {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

fs::path lockOf(fs::path file) { return file.replace_extension(".lock"); }

// The lock's file descriptor, or -1 if another process holds it.
int tryLock(const fs::path& path, int flags) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC | flags, 0600);
  if (file < 0) return -1;
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  close(file);
  return -1;
}

std::optional<Recovered> read(const fs::path& path) {
  try {
    const auto bytes = readFile(path.string(), Noted::no);
    const auto json = parsedJson<Json>({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    Recovered found;
    found.file = path;
    found.model = json.at("model").get<std::string>();
    readLook(found.look, json.at("look").dump(), path.string());
    found.time = fs::last_write_time(path);
    return found;
  } catch (const std::exception&) {
    return {};  // damaged, or of another version: nothing to offer
  }
}

}  // namespace

Recovery::Recovery(fs::path folder) : folder_(std::move(folder)) {}

Recovery::~Recovery() {
  if (lock_ < 0) return;
  if (!written_) {
    std::error_code error;
    fs::remove(lockOf(file_), error);
  }
  close(lock_);
}

void Recovery::lock() {
  std::error_code error;
  fs::create_directories(folder_, error);
  // A name is in use as long as its lock or its file exists.
  for (int n = 0; n < 1000 && lock_ < 0; ++n) {
    file_ = folder_ / (std::to_string(getpid()) + "-" + std::to_string(n) + ".json");
    if (!fs::exists(file_, error)) lock_ = tryLock(lockOf(file_), O_CREAT | O_EXCL);
  }
}

void Recovery::keep(const Look& look, bool unsaved, const fs::path& model) {
  waiting_ = false;
  if (folder_.empty()) return;
  if (!unsaved) return clear();
  if (written_ && look == last_) return;
  const auto now = std::chrono::steady_clock::now();
  if (written_ && std::chrono::duration<double>(now - lastTime_).count() < leastSeconds) {
    waiting_ = true;
    return;
  }
  lastTime_ = now;
  try {
    if (lock_ < 0) lock();
    if (lock_ < 0) return;
    std::error_code error;
    Json json;
    json["glint-recovery"] = 1;
    json["model"] = model.empty() ? "" : fs::weakly_canonical(model, error).string();
    json["look"] = parsedJson<Json>(saveLook(look));
    writeText(file_.string(), json.dump(2) + "\n");
    written_ = true;
    last_ = look;
  } catch (const InputError&) {
    // A full disk or a read-only home: retried with the next edit.
  }
}

void Recovery::clear() {
  if (!written_) return;
  std::error_code error;
  fs::remove(file_, error);
  written_ = false;
}

std::vector<Recovered> Recovery::left(const fs::path& model) const {
  std::vector<Recovered> all;
  std::error_code error;
  const fs::path wanted = model.empty() ? model : fs::weakly_canonical(model, error);
  for (const auto& each : fs::directory_iterator(folder_, error)) {
    if (each.path().extension() != ".json" || each.path() == file_) continue;
    const fs::path lockFile = lockOf(each.path());
    if (fs::exists(lockFile, error)) {
      const int held = tryLock(lockFile, 0);
      if (held < 0) continue;  // belongs to an open window
      close(held);
    }
    const auto found = read(each.path());
    if (found && (wanted.empty() || found->model == wanted)) all.push_back(*found);
  }
  std::ranges::sort(all, std::greater{}, &Recovered::time);
  return all;
}

void Recovery::discard(const Recovered& recovered) {
  std::error_code error;
  fs::remove(recovered.file, error);
  fs::remove(lockOf(recovered.file), error);
}

}  // namespace glint::viewer
