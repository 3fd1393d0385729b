// Files that are either whole or not there.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/mesh/error.h"

namespace loopcheck::core {

/// The whole file as bytes.  Errors: CannotRead, with the system's reason; TooLarge for more than 4 GiB from
/// a pipe or device.
Result<std::string> read_file(const std::filesystem::path& path);

/// Writes `bytes` to a temporary file in the same folder, then renames it to `path`: a reader sees the old
/// file or the new one, never a part.  Symbolic links are followed, the permissions of an old file are kept,
/// and what is not a plain file (a pipe, /dev/stdout) is written to directly.
///
/// Errors   CannotWrite, with the system's reason; the temporary file is removed.
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace loopcheck::core
