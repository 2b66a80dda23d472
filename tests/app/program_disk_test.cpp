// Runs that cannot be written, from the start or from some moment on.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <cstring>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Circumstances;
using testing::Ended;
using testing::Scratch;
using testing::Stream;
using testing::Words;

Words room_lasting(const std::string& seconds, const std::string& out) {
  return {"run", "room", "--duration", seconds, "--out", out, "--no-figures"};
}

TEST(ProgramDisk, AnUnwritableFolderLeavesNothing) {
  const Scratch scratch;
  scratch.write("file", "mine");
  for (const char* out : {"file", "file/run", "/proc/run", "/dev/null"}) {
    const Ended ended = testing::incognita(room_lasting("0.1", out), scratch.folder());
    EXPECT_EQ(ended.code, 1) << out;
    EXPECT_SAYS(ended.err, "cannot write ");
    EXPECT_SAYS(ended.err, out);
    EXPECT_SAYS(ended.err, "choose another folder with --out");
  }
  EXPECT_EQ(testing::everything_in(scratch.folder()), std::set<std::string>{"file"});
  EXPECT_EQ(testing::contents(scratch.folder() / "file"), "mine");
}

TEST(ProgramDisk, ADiskTooSmallToStartLeavesNothing) {
  const Scratch scratch;
  const Circumstances tight{scratch.folder(), Stream::kept, Stream::kept, 4096};
  const Ended ended = testing::incognita(room_lasting("1", "new/run"), tight);
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.err, "summary.json: File too large");
  EXPECT_SAYS(ended.err, "ulimit -f");
  EXPECT_EQ(testing::everything_in(scratch.folder()).size(), 0u);
}

/// Written files are complete, and the summary states the end and its reason.
void expect_cut_short(const Ended& ended, const std::filesystem::path& run, const std::string& why,
                      const std::string& remedy) {
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.err, why);
  const nlohmann::json summary = testing::summary_of(run);
  EXPECT_EQ(summary["status"], "failed");
  const std::string reason = summary["reason"];
  EXPECT_SAYS(reason, why);
  EXPECT_SAYS(reason, remedy);
  EXPECT_SAYS(reason, run.string());
  EXPECT_GT(summary["frames"], 10);
  EXPECT_LT(summary["frames"], 3000);
  EXPECT_GT(testing::lines(run / "series.csv").size(), 10u);
  testing::expect_whole_tables(run);
}

TEST(ProgramDisk, AFileSizeLimitEndsTheRun) {
  const Scratch scratch;
  const Circumstances tight{scratch.folder(), Stream::kept, Stream::kept, 100'000};
  const Ended ended = testing::incognita(room_lasting("100", "run"), tight);
  expect_cut_short(ended, scratch.folder() / "run", "File too large", "ulimit -f");
}

/// A small file system, visible to this process and its children only.
class SmallDisk {
 public:
  explicit SmallDisk(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directories(folder);
    const bool alone =
        ::unshare(CLONE_NEWNS) == 0 && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    if (alone && ::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=256k") == 0) return;
    refused_ = std::strerror(errno);
  }
  ~SmallDisk() {
    if (refused_.empty()) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  const std::string& refused() const { return refused_; }

 private:
  std::filesystem::path folder_;
  std::string refused_;
};

TEST(ProgramDisk, AFullDiskEndsTheRun) {
  const Scratch scratch;
  const SmallDisk disk(scratch.folder() / "disk");
  if (!disk.refused().empty()) GTEST_SKIP() << "no disk can be mounted here: " << disk.refused();
  const Ended ended = testing::incognita(room_lasting("100", "disk/run"), scratch.folder());
  expect_cut_short(ended, scratch.folder() / "disk/run", "No space left on device", "free some space");
}

TEST(ProgramDisk, ADiskFullBeforeTheStartLeavesNothing) {
  const Scratch scratch;
  const SmallDisk disk(scratch.folder() / "disk");
  if (!disk.refused().empty()) GTEST_SKIP() << "no disk can be mounted here: " << disk.refused();
  scratch.write("disk/filler", std::string(248'000, 'x'));
  const Ended ended = testing::incognita(room_lasting("1", "disk/run"), scratch.folder());
  EXPECT_EQ(ended.code, 1);
  EXPECT_SAYS(ended.err, "No space left on device; free some space");
  EXPECT_EQ(testing::everything_in(scratch.folder() / "disk"), std::set<std::string>{"filler"});
}

TEST(ProgramDisk, PicturesOnAFullDiskEndTheRun) {
  const Scratch scratch;
  const SmallDisk disk(scratch.folder() / "disk");
  if (!disk.refused().empty()) GTEST_SKIP() << "no disk can be mounted here: " << disk.refused();
  Words words = room_lasting("100", "disk/run");
  words.push_back("--save-frames");
  const Ended ended = testing::incognita(words, scratch.folder());
  EXPECT_EQ(ended.code, 1);
  const auto run = scratch.folder() / "disk/run";
  const nlohmann::json summary = testing::summary_of(run);
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_SAYS(summary["reason"].get<std::string>(), "frame-");
  for (const auto& picture : std::filesystem::directory_iterator(run / "frames"))
    EXPECT_SAYS(testing::contents(picture.path()), "IEND") << picture.path();
  testing::expect_whole_tables(run);
}

}  // namespace
}  // namespace incognita
