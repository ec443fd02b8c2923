// Runs the program as a shell would, and looks at what came out.
#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "../output/temp_dir.h"
#include "output/files.h"

namespace phalanx {

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// `cd DIR && phalanx ARGUMENTS`; `before` goes in front of the program (timeout, env).
inline Outcome phalanx_in(const TempDir &dir, const std::string &arguments,
                          const std::string &before = "") {
  const TempDir streams;
  const std::string command = "cd " + dir.path() + " && " + before + " '" PHALANX_PROGRAM "' " +
                              arguments + " > " + (streams / "out") + " 2> " + (streams / "err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(streams / "out"),
          read_file(streams / "err")};
}

/// A floor under a light, 16 x 12 pixels, 4 samples.
inline const char kSmallScene[] = R"({
  "version": 1,
  "camera": {"position": [0, 1, 4], "look_at": [0, 0.5, 0],
             "up": [0, 1, 0], "fov": 40},
  "film": {"width": 16, "height": 12},
  "sampler": {"spp": 4},
  "materials": [
    {"name": "white", "type": "diffuse", "reflectance": [0.7, 0.7, 0.7]},
    {"name": "lamp", "type": "black", "emission": [5, 5, 5]}
  ],
  "shapes": [
    {"type": "quad", "material": "white",
     "corner": [-2, 0, 2], "edge_u": [4, 0, 0], "edge_v": [0, 0, -4]},
    {"type": "quad", "material": "lamp",
     "corner": [-1, 2, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2]}
  ]
})";

}  // namespace phalanx
