// A file is written completely or not at all.
#include "output/files.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "core/error.h"
#include "temp_dir.h"

using namespace phalanx;

TEST_CASE("files: what is written can be read, and nothing else is left behind") {
  const TempDir dir;
  const std::string bytes(100'000, '\0');
  write_file(dir / "a", bytes);
  write_file(dir / "a", bytes + "x");
  CHECK(read_file(dir / "a") == bytes + "x");
  CHECK(dir.list() == std::vector<std::string>{"a"});
}

TEST_CASE("files: a full device is an error with its reason") {
  REQUIRE(is_device("/dev/full"));
  try {
    write_file("/dev/full", "text");
    FAIL("/dev/full took it");
  } catch (const WriteError &error) {
    CHECK(std::string(error.what()).find("No space left") != std::string::npos);
  }
  write_file("/dev/null", "text");
}

TEST_CASE("files: a failure leaves the previous file and no temporary one") {
  const TempDir dir;
  put(dir / "a", "previous");
  std::filesystem::create_directory(dir / "d");
  CHECK_THROWS_AS(write_file(dir / "d", "text"), WriteError);  // rename fails at the very end
  CHECK_THROWS_AS(write_file(dir / "missing/a", "text"), WriteError);
  CHECK_THROWS_AS(write_file(dir / "a/b", "text"), WriteError);
  CHECK(read_file(dir / "a") == "previous");
  CHECK(dir.list() == std::vector<std::string>{"a", "d"});
}

TEST_CASE("files: a disk that fills up half-way leaves the previous file intact") {
  const TempDir dir;
  put(dir / "a", "previous");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {  // a limit on the size of files stands for the full disk
    const rlimit limit{1 << 16, 1 << 16};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
      write_file(dir / "a", std::string(1 << 20, 'x'));
    } catch (const WriteError &) {
      _exit(kExitCannotWrite);
    }
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == kExitCannotWrite);
  CHECK(read_file(dir / "a") == "previous");
  CHECK(dir.list() == std::vector<std::string>{"a"});
}

TEST_CASE("files: links are followed, permissions kept") {
  const TempDir dir;
  put(dir / "target", "previous");
  chmod((dir / "target").c_str(), 0640);
  std::filesystem::create_symlink("target", dir / "link");
  write_file(dir / "link", "new");
  CHECK(std::filesystem::is_symlink(dir / "link"));
  CHECK(read_file(dir / "target") == "new");
  struct stat info;
  REQUIRE(stat((dir / "target").c_str(), &info) == 0);
  CHECK((info.st_mode & 0777) == 0640);
}

TEST_CASE("files: output paths are checked without creating anything") {
  const TempDir dir;
  put(dir / "a", "previous");
  check_output_path(dir / "new");
  check_output_path(dir / "a");
  check_output_path("/dev/null");
  check_output_path("name-without-directory");
  CHECK_THROWS_AS(check_output_path(""), InputError);
  CHECK_THROWS_AS(check_output_path(dir.path()), WriteError);
  CHECK_THROWS_AS(check_output_path(dir / "missing/a"), WriteError);
  CHECK_THROWS_AS(check_output_path(dir / "a/b"), WriteError);
  if (geteuid() != 0) {  // root may write everywhere
    chmod(dir.path().c_str(), 0500);
    CHECK_THROWS_AS(check_output_path(dir / "new"), WriteError);
    chmod(dir.path().c_str(), 0700);
  }
  CHECK(dir.list() == std::vector<std::string>{"a"});
}

TEST_CASE("files: a missing file is the user's mistake") {
  CHECK_THROWS_AS(read_file("/nowhere/at/all"), InputError);
}

TEST_CASE("files: two names of one file are the same file") {
  const TempDir dir;
  put(dir / "a", "");
  put(dir / "b", "");
  std::filesystem::create_hard_link(dir / "a", dir / "hard");
  std::filesystem::create_symlink("a", dir / "soft");
  CHECK(is_same_file(dir / "a", dir / "hard"));
  CHECK(is_same_file(dir / "a", dir / "soft"));
  CHECK(is_same_file(dir / "a", dir.path() + "/./a"));
  CHECK_FALSE(is_same_file(dir / "a", dir / "b"));
  CHECK_FALSE(is_same_file(dir / "a", dir / "missing"));
}
