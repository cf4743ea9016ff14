#include "vantage/core/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
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

}  // namespace
}  // namespace vantage
