#include "vantage/core/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

void write_raw(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class AtomicFile : public testing::Test {
 protected:
  support::TemporaryDirectory directory;
};

TEST_F(AtomicFile, WhatIsThereIsNotReplacedUnasked) {
  EXPECT_NO_THROW(require_absent(directory / "f.txt", false));
  write_file(directory / "f.txt", "x");
  EXPECT_NO_THROW(require_absent(directory / "f.txt", true));
  EXPECT_NO_THROW(require_absent("", false));
  EXPECT_EQ(
      message_of([&] { require_absent(directory / "f.txt", false, "--write"); }),
      "--write " + (directory / "f.txt").string() + ": is there already; --overwrite replaces it");
}

TEST_F(AtomicFile, WritesTheWholeContentAndNothingElse) {
  const std::string content("a\0b\r\n\xff", 6);
  write_file(directory / "f.txt", content);
  EXPECT_EQ(read_file(directory / "f.txt"), content);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 1);
}

TEST_F(AtomicFile, ReplacesAnOldFile) {
  write_file(directory / "f", "a much longer old content");
  write_file(directory / "f", "new");
  EXPECT_EQ(read_file(directory / "f"), "new");
}

TEST_F(AtomicFile, MayBeEmpty) {
  write_file(directory / "f", "");
  EXPECT_EQ(read_file(directory / "f"), "");
}

TEST_F(AtomicFile, AMissingDirectoryIsAnOutputErrorNamingTheFile) {
  const fs::path path = directory / "missing" / "f.txt";
  EXPECT_THROW(write_file(path, "x"), OutputError);
  EXPECT_NE(message_of([&] { write_file(path, "x"); }).find(path.string()), std::string::npos);
  EXPECT_TRUE(directory.is_empty());
}

TEST_F(AtomicFile, ADirectoryInTheWayIsAnOutputErrorAndLeavesNothing) {
  fs::create_directories(directory / "f" / "inside");
  EXPECT_THROW(write_file(directory / "f", "x"), OutputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 1);
}

TEST_F(AtomicFile, ReadErrorsAreInputErrors) {
  EXPECT_THROW(read_file(directory / "missing"), InputError);
  EXPECT_THROW(read_file(directory.path()), InputError);
  EXPECT_THROW(read_file(directory / std::string(5000, 'x')), InputError);
  EXPECT_NE(message_of([&] { read_file(directory / "missing"); }).find("missing: cannot read"),
            std::string::npos);
}

TEST_F(AtomicFile, ForeignWriterGetsATemporaryNameOfTheSameExtension) {
  fs::path given;
  write_file_with(directory / "map.bt", [&](const fs::path& part) {
    given = part;
    write_raw(part, "tree");
    return true;
  });
  EXPECT_NE(given, directory / "map.bt");
  EXPECT_EQ(given.parent_path(), directory.path());
  EXPECT_EQ(given.extension(), ".bt");
  EXPECT_EQ(read_file(directory / "map.bt"), "tree");
  EXPECT_FALSE(fs::exists(given));
}

TEST_F(AtomicFile, ForeignWriterThatFailsLeavesNothing) {
  const auto fails = [](const fs::path& part) {
    write_raw(part, "half");
    return false;
  };
  EXPECT_THROW(write_file_with(directory / "f", fails), OutputError);
  const auto throws = [](const fs::path& part) -> bool {
    write_raw(part, "half");
    throw std::runtime_error("library error");
  };
  EXPECT_THROW(write_file_with(directory / "f", throws), std::runtime_error);
  const auto lies = [](const fs::path&) { return true; };
  EXPECT_THROW(write_file_with(directory / "f", lies), OutputError);
  const auto writes_nothing = [](const fs::path& part) {
    write_raw(part, "");
    return true;
  };
  EXPECT_THROW(write_file_with(directory / "f", writes_nothing), OutputError);
  EXPECT_TRUE(directory.is_empty());
}

TEST_F(AtomicFile, ForeignWriterThatFailsKeepsTheOldFile) {
  write_file(directory / "f", "old");
  EXPECT_THROW(write_file_with(directory / "f", [](const fs::path&) { return false; }),
               OutputError);
  EXPECT_EQ(read_file(directory / "f"), "old");
}

TEST_F(AtomicFile, GrowingFileAppearsOnCommit) {
  GrowingFile file(directory / "steps.csv");
  file.write("a\n");
  file.write("b\n");
  EXPECT_FALSE(fs::exists(directory / "steps.csv"));
  file.commit();
  EXPECT_EQ(read_file(directory / "steps.csv"), "a\nb\n");
}

TEST_F(AtomicFile, GrowingFileWithoutCommitLeavesNothing) {
  {
    GrowingFile file(directory / "steps.csv");
    file.write("a\n");
    GrowingFile moved = std::move(file);
    moved.write("b\n");
  }
  EXPECT_TRUE(directory.is_empty());
}

TEST_F(AtomicFile, GrowingFileCannotGrowAfterCommit) {
  GrowingFile file(directory / "f");
  file.commit();
  EXPECT_THROW(file.write("late"), OutputError);
}

TEST_F(AtomicFile, MakesWritableDirectories) {
  make_writable_directory(directory / "a" / "b");
  EXPECT_TRUE(fs::is_directory(directory / "a" / "b"));
  EXPECT_TRUE(fs::is_empty(directory / "a" / "b"));
  make_writable_directory(directory / "a" / "b");
}

TEST_F(AtomicFile, AFileInTheWayOfADirectoryIsAnOutputError) {
  write_raw(directory / "file", "x");
  EXPECT_THROW(make_writable_directory(directory / "file"), OutputError);
  EXPECT_THROW(make_writable_directory(directory / "file" / "below"), OutputError);
}

/// Runs `action` in a child whose files may not grow beyond `limit` bytes, as on a full disk.
/// @return 0 if it threw OutputError, 1 if it threw nothing, 2 for anything else.
int outcome_on_full_disk(rlim_t limit, const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{limit, limit};
    ::setrlimit(RLIMIT_FSIZE, &small);
    int outcome = 1;
    try {
      action();
    } catch (const OutputError&) {
      outcome = 0;
    } catch (...) {
      outcome = 2;
    }
    ::_exit(outcome);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(AtomicFile, AFullDiskIsAnOutputErrorAndLeavesNothing) {
  const std::string large(100000, 'x');
  const auto path = directory / "f";
  EXPECT_EQ(outcome_on_full_disk(1000, [&] { write_file(path, large); }), 0);
  EXPECT_TRUE(directory.is_empty());
  const auto small_writes = [&] {
    GrowingFile file(path);
    for (int i = 0; i < 200; ++i) file.write("0123456789");
    file.commit();
  };
  EXPECT_EQ(outcome_on_full_disk(1000, small_writes), 0);
  EXPECT_TRUE(directory.is_empty());
}

TEST_F(AtomicFile, EnoughRoomIsEnough) {
  const auto path = directory / "f";
  EXPECT_EQ(outcome_on_full_disk(1000, [&] { write_file(path, std::string(1000, 'x')); }), 1);
  EXPECT_EQ(fs::file_size(path), 1000U);
}

TEST_F(AtomicFile, ADiskTooFullForTheProbeIsAnOutputError) {
  const auto path = directory / "run";
  EXPECT_EQ(outcome_on_full_disk(0, [&] { make_writable_directory(path); }), 0);
}

TEST_F(AtomicFile, IsReadWholeWhateverItsSize) {
  for (const std::size_t size : {65535U, 65536U, 65537U, 200001U}) {
    std::string content;
    for (std::size_t i = 0; i < size; ++i) content += static_cast<char>(i % 251);
    write_file(directory / "f", content);
    EXPECT_TRUE(read_file(directory / "f") == content) << size;
  }
}

TEST_F(AtomicFile, ErrorsSayWhyTheSystemRefuses) {
  EXPECT_EQ(message_of([&] { read_file(directory / "missing"); }),
            (directory / "missing").string() + ": cannot read: No such file or directory");
  const fs::path path = directory / "missing" / "f.txt";
  EXPECT_EQ(message_of([&] { write_file(path, "x"); }),
            path.string() + ": cannot write: No such file or directory");
}

/// What another call has left in errno is no reason.
TEST_F(AtomicFile, ErrorsWithoutAReasonOfTheSystemSaySo) {
  const std::string refused = (directory / "f").string() + ": cannot write: write failed";
  GrowingFile file(directory / "f");
  file.commit();
  errno = EACCES;
  EXPECT_EQ(message_of([&] { file.write("late"); }), refused);
  errno = EACCES;
  EXPECT_EQ(message_of([&] { file.commit(); }), refused);
  const auto fails = [](const fs::path&) { return false; };
  errno = EACCES;
  EXPECT_EQ(message_of([&] { write_file_with(directory / "f", fails); }), refused);
}

TEST_F(AtomicFile, GrowingFileWithoutItsDirectoryDoesNotBegin) {
  EXPECT_THROW(GrowingFile(directory / "missing" / "f"), OutputError);
}

/// No process has memory at address 0.
TEST_F(AtomicFile, AReadThatFailsOnTheWayIsAnInputError) {
  EXPECT_THROW(read_file("/proc/self/mem"), InputError);
}

TEST_F(AtomicFile, GrowingFileThatIsDoneLeavesTheNextOfItsNameAlone) {
  auto first = std::make_unique<GrowingFile>(directory / "f");
  first->write("old");
  first->commit();
  GrowingFile second(directory / "f");
  second.write("new");
  first.reset();
  second.commit();
  EXPECT_EQ(read_file(directory / "f"), "new");
}

bool writes_x(const fs::path& part) {
  write_raw(part, "x");
  return true;
}

TEST_F(AtomicFile, LeavesNoFileOpen) {
  const auto open_now = [] { return std::distance(fs::directory_iterator("/proc/self/fd"), {}); };
  const auto before = open_now();
  write_file(directory / "f", "x");
  write_file_with(directory / "g", writes_x);
  EXPECT_EQ(open_now(), before);
}

/// Its number, 0, is then that of the next file.
TEST_F(AtomicFile, StandardInputMayBeClosed) {
  const auto action = [&] {
    ::close(STDIN_FILENO);
    write_file_with(directory / "f", writes_x);
  };
  EXPECT_EQ(outcome_on_full_disk(RLIM_INFINITY, action), 1);
  EXPECT_EQ(read_file(directory / "f"), "x");
}

/// Where no more files can be opened, nothing can be told to be on the disk.
TEST_F(AtomicFile, WhatMayNotBeOnTheDiskIsNotPublished) {
  const auto open_no_more = [] {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_NOFILE, &none);
  };
  const auto foreign = [&] {
    write_file_with(directory / "f", [&](const fs::path& part) {
      write_raw(part, "x");
      open_no_more();
      return true;
    });
  };
  EXPECT_EQ(outcome_on_full_disk(RLIM_INFINITY, foreign), 0);
  const auto growing = [&] {
    GrowingFile file(directory / "f");
    file.write("x");
    open_no_more();
    file.commit();
  };
  EXPECT_EQ(outcome_on_full_disk(RLIM_INFINITY, growing), 0);
  EXPECT_TRUE(directory.is_empty());
}

TEST(TemporaryPlace, IsTheFolderThatTheVariableNames) {
  const support::TemporaryDirectory folder;
  const char* set = std::getenv("TMPDIR");
  const auto before = set != nullptr ? std::optional<std::string>(set) : std::nullopt;
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  EXPECT_EQ(message_of([] { (void)temporary_place(); }), "");
  const fs::path place = temporary_place();
  const std::string none = (folder / "none").string();
  ::setenv("TMPDIR", none.c_str(), 1);
  const std::string refusal = message_of([] { (void)temporary_place(); });
  if (before) {
    ::setenv("TMPDIR", before->c_str(), 1);
  } else {
    ::unsetenv("TMPDIR");
  }
  EXPECT_EQ(place, folder.path());
  EXPECT_EQ(refusal.find("TMPDIR: " + none + ": "), 0U) << refusal;
}

}  // namespace
}  // namespace vantage
