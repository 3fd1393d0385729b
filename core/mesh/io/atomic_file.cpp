#include "core/mesh/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/mesh/io/number.h"

namespace loopcheck::core {
namespace {

namespace fs = std::filesystem;

/// Most that is read from what has no size, such as a pipe: a device may never end.
constexpr std::size_t kMostFromPipe = std::size_t{1} << 32;

/// An open file descriptor.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    int number() const { return number_; }
    bool is_open() const { return number_ >= 0; }
    /// False, with errno set, where the last of the data could not be stored.
    bool close() { return ::close(std::exchange(number_, -1)) == 0; }

  private:
    int number_;
};

/// "The file x cannot be written: No space left on device."
tl::unexpected<Error> fail_with(ErrorCode code, std::string_view verb, const fs::path& path, int reason) {
    return fail(code, fmt::format("The file {} cannot be {}: {}.", path.string(), verb,
                                  std::generic_category().message(reason)));
}
tl::unexpected<Error> fail_to_write(const fs::path& path, int reason) {
    return fail_with(ErrorCode::CannotWrite, "written", path, reason);
}

/// Writes all bytes; false with errno set where that fails.
bool write_all(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) return false;
        bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    return true;
}

/// True for a file by the number this process has it open under, which is where /dev/stdout leads.
bool is_descriptor(const fs::path& path) {
    const fs::path folder = path.parent_path();
    return folder == "/proc/self/fd" || folder == "/dev/fd";
}

/// The file a path leads to through symbolic links, whether it is there or not; nothing for a circle of
/// links. Descriptors of this process are links too, but end here: a rename would not reach what is open.
std::optional<fs::path> follow_links(fs::path path) {
    constexpr int kMostLinks = 40;
    for (int links = 0; links < kMostLinks; ++links) {
        std::error_code error;
        if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
        if (is_descriptor(path)) return path;
        const fs::path target = fs::read_symlink(path, error);
        if (error) return path;
        path = path.parent_path() / target;
    }
    return std::nullopt;
}

/// Opens what cannot be replaced: a device, a pipe or a descriptor.
Descriptor open_in_place(const fs::path& path) {
    const auto number = is_descriptor(path) ? parse_integer(path.filename().string()) : std::nullopt;
    return Descriptor(number ? ::dup(static_cast<int>(*number)) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC));
}

Result<void> write_in_place(const fs::path& path, std::string_view bytes) {
    Descriptor file = open_in_place(path);
    if (!file.is_open() || !write_all(file, bytes) || !file.close()) return fail_to_write(path, errno);
    return {};
}

/// A name in `folder` that no other running process and no other call has.
fs::path temporary_name(const fs::path& folder) {
    static std::atomic<unsigned> calls{0};
    return folder / fmt::format(".loopcheck-{}-{}.tmp", ::getpid(), calls++);
}

/// Calls make(name) with temporary names in `folder` until it succeeds or fails for another reason than that
/// the name is taken, by what a process of the same number once left behind; the result of the last call.
template <class Make>
int with_temporary_name(const fs::path& folder, fs::path& name, Make make) {
    constexpr int kMostTries = 1000;
    int result = -1;
    for (int tries = 0; tries < kMostTries && result < 0; ++tries) {
        name = temporary_name(folder);
        result = make(name.c_str());
        if (result < 0 && errno != EEXIST) break;
    }
    return result;
}

/// A new file in `folder`, with the permissions that the umask leaves.  It has no name where the file system
/// can do that, so that nothing stays behind when the process is killed; else `name` becomes its name.
int create_temporary(const fs::path& folder, fs::path& name) {
    const int nameless = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (nameless >= 0) return nameless;
    return with_temporary_name(folder, name, [](const char* path) {
        return ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    });
}

/// Gives a file without a name the name that it is renamed from.
bool give_name(const Descriptor& file, const fs::path& folder, fs::path& name) {
    if (!name.empty()) return true;
    const std::string itself = fmt::format("/proc/self/fd/{}", file.number());
    return with_temporary_name(folder, name, [&](const char* path) {
               return ::linkat(AT_FDCWD, itself.c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW);
           }) == 0;
}

/// Writes a temporary file in the folder of `path` and renames it to `path`.  `mode` is that of the file it
/// replaces; a new file gets what the umask leaves.
Result<void> write_and_rename(const fs::path& path, std::string_view bytes, std::optional<mode_t> mode) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    fs::path name;
    Descriptor file(create_temporary(folder, name));
    if (!file.is_open()) return fail_to_write(path, errno);
    if (write_all(file, bytes) && (!mode || ::fchmod(file.number(), *mode) == 0) &&
        give_name(file, folder, name) && file.close() && ::rename(name.c_str(), path.c_str()) == 0)
        return {};
    const int reason = errno;
    if (!name.empty()) ::unlink(name.c_str());
    return fail_to_write(path, reason);
}

}  // namespace

Result<std::string> read_file(const fs::path& path) {
    const auto failed = [&] { return fail_with(ErrorCode::CannotRead, "read", path, errno); };
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open()) return failed();
    struct stat status {};
    std::string bytes;
    const bool is_plain = ::fstat(file.number(), &status) == 0 && S_ISREG(status.st_mode);
    if (is_plain) bytes.reserve(static_cast<std::size_t>(status.st_size));
    std::array<char, 1 << 16> block;
    while (true) {
        const ssize_t count = ::read(file.number(), block.data(), block.size());
        if (count == 0) return bytes;
        if (count < 0 && errno != EINTR) return failed();
        if (!is_plain && bytes.size() > kMostFromPipe)
            return fail(ErrorCode::TooLarge, fmt::format("The pipe or device {} gives more than {} bytes.",
                                                         path.string(), kMostFromPipe));
        bytes.append(block.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
}

Result<void> write_file(const fs::path& path, std::string_view bytes) {
    const auto target = follow_links(path);
    if (!target) return fail_to_write(path, ELOOP);
    struct stat status {};
    if (::stat(target->c_str(), &status) == 0) {
        if (!S_ISREG(status.st_mode) || is_descriptor(*target)) return write_in_place(*target, bytes);
        if (::access(target->c_str(), W_OK) != 0) return fail_to_write(path, errno);
        return write_and_rename(*target, bytes, status.st_mode & 07777);
    }
    const fs::path folder = target->has_parent_path() ? target->parent_path() : ".";
    std::error_code error;
    if (!fs::exists(folder, error))
        return fail(ErrorCode::CannotWrite,
                    fmt::format("The file {} cannot be written: there is no folder {}.", path.string(),
                                folder.string()));
    return write_and_rename(*target, bytes, std::nullopt);
}

}  // namespace loopcheck::core
