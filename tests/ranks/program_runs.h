// Runs the program under mpirun, in the background, and stops it in all ways.
#pragma once
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "../cli/program.h"
#include "output/image_file.h"

namespace phalanx {

/// True if this build has MPI and the machine an mpirun; says why not.
inline bool can_run_ranks() {
#ifdef PHALANX_TEST_MPI
  static const bool has_mpirun = std::system("command -v mpirun > /dev/null 2>&1") == 0;
  if (!has_mpirun) MESSAGE("skipped: there is no mpirun");
  return has_mpirun;
#else
  MESSAGE("skipped: built without MPI");
  return false;
#endif
}

/// In front of the program. Root, more ranks than cores and a missing ssh are fine; hwloc does not look for
/// an X server, which takes 5 s a rank where the name localhost is not known.
inline std::string mpirun(int ranks, const std::string &options = "") {
  return "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_plm_rsh_agent=sh HWLOC_COMPONENTS=-gl "
         "mpirun --oversubscribe --bind-to none " + options + " -n " + std::to_string(ranks);
}

inline bool same_pictures(const std::string &a, const std::string &b) {
  const Image x = read_image(a), y = read_image(b);
  bool same = x.width == y.width && x.height == y.height && x.channels.size() == y.channels.size();
  for (std::size_t c = 0; same && c < x.channels.size(); ++c)
    same = x.channels[c].name == y.channels[c].name &&
           x.channels[c].values.size() == y.channels[c].values.size() &&
           std::memcmp(x.channels[c].values.data(), y.channels[c].values.data(),
                       x.channels[c].values.size() * sizeof(float)) == 0;
  return same;
}

/// `cd DIR && BEFORE phalanx ARGUMENTS &`, its own process group; killed when this goes.
class Background {
 public:
  Background(const TempDir &dir, const std::string &arguments, const std::string &before = "") {
    const std::string command = "cd " + dir.path() + " && exec " + before + " '" PHALANX_PROGRAM "' " +
                                arguments + " > out.txt 2> err.txt";
    pid_ = fork();
    if (pid_ == 0) {
      setpgid(0, 0);
      execl("/bin/bash", "bash", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  ~Background() {
    if (pid_ > 0) {
      ::kill(-pid_, SIGKILL);
      wait();
    }
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// The exit code, or 128 + the signal that ended it. After `limit_s` -1.
  int wait(double limit_s = 60) {
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > limit_s)
        return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  pid_t pid() const { return pid_; }

  /// The process of a rank, once it has been started.
  pid_t rank(int number) const {
    for (int tries = 0; tries < 400; ++tries, pause(0.01))
      for (const auto &entry : std::filesystem::directory_iterator("/proc")) {
        const pid_t pid = std::atoi(entry.path().filename().c_str());
        if (pid <= 0 || !is_below(pid)) continue;
        std::ifstream file(entry.path() / "environ", std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(number) + '\0';
        if (text.find(wanted) != std::string::npos) return pid;
      }
    return -1;
  }
  static void pause(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }

 private:
  bool is_below(pid_t pid) const {
    while (pid > 1 && pid != pid_) {
      std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
      std::string text((std::istreambuf_iterator<char>(stat)), {});
      const std::size_t end = text.rfind(')');
      if (end == std::string::npos || end + 4 >= text.size()) return false;
      pid = std::atoi(text.c_str() + end + 4);
    }
    return pid == pid_;
  }
  pid_t pid_ = -1;
};

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Waits until a file is there.
inline bool appears(const std::string &path, double limit_s = 20) {
  const auto start = std::chrono::steady_clock::now();
  while (!std::filesystem::exists(path)) {
    if (seconds_since(start) > limit_s) return false;
    Background::pause(0.005);
  }
  return true;
}

}  // namespace phalanx
