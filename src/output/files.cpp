// Atomic replacement: write a temporary file, fsync, rename, fsync the directory.
#include "files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "../core/error.h"

namespace phalanx {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const std::string &path, const std::string &what, int error) {
  throw WriteError(fmt::format("{}: {}: {}", path, what, std::strerror(error)));
}

/// A file descriptor that is closed on every way out; close() reports what the destructor cannot.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor &) = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  int get() const { return fd_; }
  bool is_open() const { return fd_ >= 0; }
  int close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd);
  }

 private:
  int fd_;
};

void write_all(int fd, const std::string &bytes, const std::string &path) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "cannot write", errno);
    done += static_cast<std::size_t>(n);
  }
}

void write_device(const std::string &path, const std::string &bytes) {
  Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!device.is_open()) fail(path, "cannot open", errno);
  write_all(device.get(), bytes, path);
  if (device.close() != 0) fail(path, "cannot close", errno);
}

/// Removes the temporary file unless it has become the real one.
struct Temporary {
  std::string path;
  bool renamed = false;
  ~Temporary() {
    if (!renamed && !path.empty()) ::unlink(path.c_str());
  }
};

fs::path directory_of(const fs::path &path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A new file beside `target`; its name is short so that it fits wherever the target's does.
int create_beside(const fs::path &target, Temporary &temporary) {
  for (int attempt = 0; attempt < 1000; attempt++) {
    const auto path = directory_of(target) / fmt::format(".phalanx-{}-{}", ::getpid(), attempt);
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) {
      temporary.path = path;
      return fd;
    }
    if (errno != EEXIST) break;
  }
  fail(target, "cannot create a file in its directory", errno);
}

/// The name that a chain of symbolic links ends at, so that renaming replaces the file and not the
/// link. A dangling link cannot be resolved and is replaced.
fs::path follow_links(const std::string &path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::canonical(path, error);
  return error ? fs::path(path) : target;
}

void sync_directory(const fs::path &file, const std::string &path) {
  Descriptor directory(::open(directory_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!directory.is_open()) return;  // a directory that one may write to but not read
  if (::fsync(directory.get()) != 0 && errno != EINVAL)  // EINVAL: the file system cannot
    fail(path, "cannot flush its directory", errno);
}

}  // namespace

bool is_device(const std::string &path) {
  struct stat info;
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

bool is_same_file(const std::string &a, const std::string &b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

std::string read_file(const std::string &path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) throw InputError(fmt::format("{}: {}", path, std::strerror(errno)));
  std::string bytes;
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = ::read(file.get(), buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw InputError(fmt::format("{}: {}", path, std::strerror(errno)));
    if (n == 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(n));
  }
}

void write_file(const std::string &path, const std::string &bytes) {
  if (is_device(path)) return write_device(path, bytes);

  const fs::path target = follow_links(path);
  Temporary temporary;
  Descriptor file(create_beside(target, temporary));
  struct stat previous;
  if (::stat(target.c_str(), &previous) == 0) ::fchmod(file.get(), previous.st_mode & 07777);
  write_all(file.get(), bytes, path);
  if (::fsync(file.get()) != 0) fail(path, "cannot flush", errno);
  if (file.close() != 0) fail(path, "cannot close", errno);
  if (::rename(temporary.path.c_str(), target.c_str()) != 0) fail(path, "cannot replace", errno);
  temporary.renamed = true;
  sync_directory(target, path);
}

void check_output_path(const std::string &path) {
  if (path.empty()) throw InputError("an output needs a file name");
  const fs::path target = follow_links(path);
  struct stat info;
  if (::stat(target.c_str(), &info) == 0) {
    if (S_ISDIR(info.st_mode)) fail(path, "cannot write", EISDIR);
    if (::access(target.c_str(), W_OK) != 0) fail(path, "cannot write", errno);
    if (!S_ISREG(info.st_mode)) return;
  } else if (errno != ENOENT) {
    fail(path, "cannot write", errno);
  }
  const fs::path directory = directory_of(target);
  if (::stat(directory.c_str(), &info) != 0) fail(path, "cannot write into its directory", errno);
  if (!S_ISDIR(info.st_mode)) fail(path, "cannot write into its directory", ENOTDIR);
  if (::access(directory.c_str(), W_OK | X_OK) != 0)
    fail(path, "cannot write into its directory", errno);
}

}  // namespace phalanx
