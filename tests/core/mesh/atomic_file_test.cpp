#include "core/mesh/io/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::core {
namespace {

namespace fs = std::filesystem;
using tests::contains;
using tests::error_of;
using tests::TemporaryFolder;
using tests::value_of;

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

mode_t mode_of(const fs::path& path) {
    struct stat status {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return status.st_mode & 07777;
}

TEST(WriteFile, WritesWhatReadFileReads) {
    const TemporaryFolder folder;
    std::string bytes = "a\r\nb";
    bytes += '\0';
    bytes.append(1 << 20, 'x');
    ASSERT_TRUE(write_file(folder / "file", bytes));
    EXPECT_EQ(value_of(read_file(folder / "file")), bytes);
    EXPECT_EQ(entries(folder.path()), 1u) << "the temporary file is gone";
}

TEST(WriteFile, ReplacesAFileAndKeepsItsPermissions) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "file", "old"));
    ASSERT_EQ(::chmod((folder / "file").c_str(), 0640), 0);
    ASSERT_TRUE(write_file(folder / "file", "new"));
    EXPECT_EQ(value_of(read_file(folder / "file")), "new");
    EXPECT_EQ(mode_of(folder / "file"), 0640u);
}

TEST(WriteFile, GivesANewFileThePermissionsThatTheUmaskLeaves) {
    const TemporaryFolder folder;
    const mode_t before = ::umask(027);
    EXPECT_TRUE(write_file(folder / "file", "new"));
    ::umask(before);
    EXPECT_EQ(mode_of(folder / "file"), 0640u);
}

// Nothing is protected from root, so a process of its own writes, as nobody where the tests run as root.
TEST(WriteFile, DoesNotReplaceAWriteProtectedFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "file", "old"));
    ASSERT_EQ(::chmod((folder / "file").c_str(), 0444), 0);
    constexpr uid_t kNobody = 65534;
    const bool is_root = ::geteuid() == 0;
    if (is_root) {
        ASSERT_EQ(::chown(folder.path().c_str(), kNobody, kNobody), 0);
    }
    const pid_t child = ::fork();
    if (child == 0) {
        if (is_root && ::setuid(kNobody) != 0) ::_exit(2);
        const auto written = write_file(folder / "file", "new");
        ::_exit(!written && written.error().code == ErrorCode::CannotWrite ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    EXPECT_EQ(value_of(read_file(folder / "file")), "old");
}

TEST(WriteFile, FollowsASymbolicLink) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "inner");
    fs::create_symlink("inner/file", folder / "link");
    ASSERT_TRUE(write_file(folder / "link", "first")) << "the file is not there yet";
    ASSERT_TRUE(write_file(folder / "link", "second"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(value_of(read_file(folder / "inner" / "file")), "second");
}

TEST(WriteFile, RefusesACircleOfSymbolicLinks) {
    const TemporaryFolder folder;
    fs::create_symlink("a", folder / "b");
    fs::create_symlink("b", folder / "a");
    EXPECT_EQ(error_of(write_file(folder / "a", "x")).code, ErrorCode::CannotWrite);
}

TEST(WriteFile, SaysThatTheFolderIsMissing) {
    const TemporaryFolder folder;
    const Error error = error_of(write_file(folder / "no" / "file", "x"));
    EXPECT_EQ(error.code, ErrorCode::CannotWrite);
    EXPECT_TRUE(contains(error.sentence, "there is no folder " + (folder / "no").string())) << error.sentence;
}

TEST(WriteFile, LeavesNothingBehindWhereItFails) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "folder");
    const Error error = error_of(write_file(folder / "folder", "x"));
    EXPECT_EQ(error.code, ErrorCode::CannotWrite);
    EXPECT_TRUE(contains(error.sentence, "Is a directory")) << error.sentence;
    EXPECT_FALSE(write_file(folder / std::string(300, 'x'), "x"));
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(WriteFile, SaysWhyADeviceTakesNoMore) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    const Error error = error_of(write_file("/dev/full", "x"));
    EXPECT_EQ(error.code, ErrorCode::CannotWrite);
    EXPECT_TRUE(contains(error.sentence, "No space left on device")) << error.sentence;
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(WriteFile, WritesIntoAPipe) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const std::string bytes(1 << 20, 'y');
    std::string received;
    std::thread reader([&] { received = value_of(read_file(folder / "pipe")); });
    EXPECT_TRUE(write_file(folder / "pipe", bytes));
    reader.join();
    EXPECT_EQ(received, bytes);
    EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(WriteFile, ContinuesAFileThatIsOpenUnderADescriptor) {
    const TemporaryFolder folder;
    const int number = ::open((folder / "output").c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(number, 0);
    ASSERT_EQ(::write(number, "before ", 7), 7);
    EXPECT_TRUE(write_file("/dev/fd/" + std::to_string(number), "file"));
    ASSERT_EQ(::write(number, " after", 6), 6);
    ::close(number);
    EXPECT_EQ(value_of(read_file(folder / "output")), "before file after");
}

TEST(WriteFile, LetsManyThreadsWriteOneFile) {
    const TemporaryFolder folder;
    std::vector<std::thread> threads;
    for (char c = 'a'; c < 'e'; ++c)
        threads.emplace_back([&, c] {
            for (int i = 0; i < 20; ++i) EXPECT_TRUE(write_file(folder / "file", std::string(10000, c)));
        });
    for (std::thread& thread : threads) thread.join();
    const std::string bytes = value_of(read_file(folder / "file"));
    EXPECT_EQ(bytes, std::string(10000, bytes.at(0))) << "one of them, whole";
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(ReadFile, SaysWhyItCannotRead) {
    const TemporaryFolder folder;
    const Error missing = error_of(read_file(folder / "missing"));
    EXPECT_EQ(missing.code, ErrorCode::CannotRead);
    EXPECT_TRUE(contains(missing.sentence, "No such file or directory")) << missing.sentence;
    const Error is_folder = error_of(read_file(folder.path()));
    EXPECT_EQ(is_folder.code, ErrorCode::CannotRead);
    EXPECT_TRUE(contains(is_folder.sentence, "Is a directory")) << is_folder.sentence;
}

}  // namespace
}  // namespace loopcheck::core
