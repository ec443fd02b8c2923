// Whole files in and out. A file is written completely or not at all.
#pragma once
#include <string>

namespace phalanx {

/// Everything in the file. Throws InputError when it cannot be read.
std::string read_file(const std::string &path);

/// Replaces `path` by `bytes`: a temporary file in the same directory is written, flushed to the
/// device and renamed, so that there is never a moment without a complete file. Devices and pipes
/// (/dev/stdout) are written directly; a symbolic link is followed. Throws WriteError with the
/// reason; then the temporary file is gone and the previous file is intact.
void write_file(const std::string &path, const std::string &bytes);

/// Throws WriteError if write_file(path) is bound to fail: no such directory, no permission, a
/// directory of that name. Nothing is created.
void check_output_path(const std::string &path);

/// True for an existing path that is neither a regular file nor a directory: a device or a pipe.
bool is_device(const std::string &path);

/// True if both paths lead to one existing file, by whatever links.
bool is_same_file(const std::string &a, const std::string &b);

}  // namespace phalanx
