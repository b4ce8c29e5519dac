#include "glint/image/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "files.h"
#include "glint/image/error.h"

namespace glint::test::image_file_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A folder for each test and each way of staging.
class File : public ::testing::TestWithParam<OutputFile::Staging> {
 protected:
  std::string in(const std::string& name) const { return folder_ / name; }
  std::size_t entries() const { return folder_.names().size(); }
  void put(const std::string& name, const std::string& text) const { writeText(in(name), text); }

  const Folder folder_{"file"};
};

INSTANTIATE_TEST_SUITE_P(Staging, File,
                         ::testing::Values(OutputFile::Staging::unnamed,
                                           OutputFile::Staging::named));

TEST_P(File, AppearsOnlyWhenCommitted) {
  const std::string large(300000, 'x');
  OutputFile file(in("a"), GetParam());
  file.write(bytesOf("begin "));
  file.write(bytesOf(large));
  file.write(bytesOf(" end"));
  EXPECT_FALSE(fs::exists(in("a")));
  file.commit();
  EXPECT_EQ(textOf(glint::readFile(in("a"))), "begin " + large + " end");
  EXPECT_EQ(entries(), 1u);
}

TEST_P(File, WithoutCommitNothingIsLeft) {
  put("old", "old");
  {
    OutputFile fresh(in("new"), GetParam());
    fresh.write(bytesOf("new"));
    OutputFile replacement(in("old"), GetParam());
    replacement.write(bytesOf("new"));
  }
  EXPECT_EQ(textOf(glint::readFile(in("old"))), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_P(File, ReplacesAnOlderFile) {
  put("a", "an older and longer text");
  OutputFile file(in("a"), GetParam());
  file.write(bytesOf("new"));
  file.commit();
  EXPECT_EQ(textOf(glint::readFile(in("a"))), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_P(File, WritesAtOffsetsInAnyOrder) {
  OutputFile file(in("a"), GetParam());
  file.writeAt(4, bytesOf("cd"));
  file.writeAt(0, bytesOf("ab"));
  file.commit();
  EXPECT_EQ(textOf(glint::readFile(in("a"))), std::string("ab\0\0cd", 6));
}

TEST_P(File, FollowsLinksAndLeavesThem) {
  fs::create_directory(in("sub"));
  put("sub/target", "old");
  fs::create_symlink("sub/target", in("link"));
  fs::create_symlink("link", in("chain"));
  fs::create_symlink("sub/none", in("dangling"));
  for (const char* name : {"chain", "dangling"}) {
    OutputFile file(in(name), GetParam());
    file.write(bytesOf("new"));
    file.commit();
    EXPECT_TRUE(fs::is_symlink(in(name)));
  }
  EXPECT_TRUE(fs::is_symlink(in("link")));
  EXPECT_EQ(textOf(glint::readFile(in("sub/target"))), "new");
  EXPECT_EQ(textOf(glint::readFile(in("sub/none"))), "new");
}

TEST_P(File, HasThePermissionsThatTheUmaskLeaves) {
  const mode_t old = ::umask(027);
  OutputFile file(in("a"), GetParam());
  file.commit();
  ::umask(old);
  struct stat status {};
  ASSERT_EQ(::stat(in("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST_P(File, NamesWithoutAFolderAreOfTheCurrentOne) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  OutputFile file("plain", GetParam());
  file.write(bytesOf("x"));
  file.commit();
  fs::current_path(before);
  EXPECT_EQ(textOf(glint::readFile(in("plain"))), "x");
}

TEST_P(File, FoldersAreMadeAndStayWithWhatIsInThem) {
  { OutputFile file(in("new/deep/a"), GetParam()); }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  {
    OutputFile kept(in("new/deep/a"), GetParam());
    kept.write(bytesOf("x"));
    kept.commit();
    OutputFile dropped(in("new/other/a"), GetParam());
  }
  EXPECT_EQ(textOf(glint::readFile(in("new/deep/a"))), "x");
  EXPECT_FALSE(fs::exists(in("new/other")));
  OutputFile first(in("shared/a"), GetParam());
  fs::remove_all(in("shared"));  // as by another process that made it and failed
  if (GetParam() == OutputFile::Staging::unnamed) {
    first.commit();
    EXPECT_TRUE(fs::exists(in("shared/a")));
  }
}

TEST_P(File, FilesInPlaceOfFoldersAndFoldersAreRefused) {
  std::ofstream(in("file")) << "x";
  EXPECT_EQ(messageOf([&] { OutputFile file(in("file/a"), GetParam()); }),
            in("file/a") + ": Not a directory: a part of its path is a file: write elsewhere");
  EXPECT_EQ(messageOf([&] { OutputFile file(folder_.path(), GetParam()); }),
            folder_.path() + ": Is a directory: give the name of a file");
  EXPECT_THAT(messageOf([&] { OutputFile file("", GetParam()); }), HasSubstr("No such file"));
}

// Root may write everywhere: while this lives, root acts as the user nobody, who owns the given
// files. Other users are unaffected.
class AsNobody {
 public:
  explicit AsNobody(const std::vector<std::string>& files) : user_(::geteuid()) {
    if (user_ != 0) return;
    for (const std::string& file : files) EXPECT_EQ(::chown(file.c_str(), nobody, nobody), 0);
    EXPECT_EQ(::seteuid(nobody), 0);
  }
  ~AsNobody() { EXPECT_EQ(::seteuid(user_), 0); }

 private:
  static constexpr uid_t nobody = 65534;
  uid_t user_;
};

TEST_P(File, ProtectedFileAndFolderAreRefused) {
  put("a", "kept");
  const AsNobody nobody({folder_.path(), in("a")});
  fs::permissions(in("a"), fs::perms::owner_read);
  EXPECT_THAT(messageOf([&] { OutputFile file(in("a"), GetParam()); }),
              HasSubstr("Permission denied"));
  fs::create_directory(in("sub"));
  fs::permissions(in("sub"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(messageOf([&] { OutputFile file(in("sub/a"), GetParam()); }),
              HasSubstr("Permission denied"));
}

TEST_P(File, FullDiskIsReportedOnWritingOrCommitting) {
  const auto fill = [&](std::size_t size) {
    OutputFile file("/dev/full", GetParam());
    file.write(bytesOf(std::string(size, 'x')));
    file.commit();
  };
  const std::string line = "/dev/full: No space left on device: free some space or write elsewhere";
  EXPECT_EQ(messageOf([&] { fill(3); }), line);
  EXPECT_EQ(messageOf([&] { fill(1 << 20); }), line);
}

TEST_P(File, DevicesAreWrittenDirectly) {
  OutputFile file("/dev/null", GetParam());
  file.write(bytesOf("x"));
  file.commit();
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

TEST_P(File, ReadingRefusesWhatIsNotARegularFile) {
  ASSERT_EQ(::mkfifo(in("fifo").c_str(), 0600), 0);
  EXPECT_EQ(messageOf([&] { glint::readFile(in("fifo")); }),
            in("fifo") + ": not a regular file: save it to a file first");
  EXPECT_THAT(messageOf([&] { glint::readFile("/dev/zero"); }), HasSubstr("not a regular file"));
  EXPECT_THAT(messageOf([&] { glint::readFile(folder_.path()); }), HasSubstr("Is a directory"));
  EXPECT_EQ(messageOf([&] { glint::readFile(in("none")); }),
            in("none") + ": No such file or directory: check the path");
}

TEST_P(File, ReadsEmptyFilesAndFilesOfUnknownLength) {
  put("empty", "");
  EXPECT_TRUE(glint::readFile(in("empty")).empty());
  EXPECT_THAT(textOf(glint::readFile("/proc/self/status")), HasSubstr("Name:"));
}

TEST_P(File, MessagesStayOneLine) {
  EXPECT_THAT(messageOf([&] { glint::readFile(in("a\nb\x1b[1m")); }),
              ::testing::AllOf(HasSubstr("a\\nb\\x1b[1m"), Not(HasSubstr("\n"))));
}

}  // namespace glint::test::image_file_test
