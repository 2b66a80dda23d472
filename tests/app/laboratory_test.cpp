// The files of a results folder that the page may read, and those that it may not.
#include "incognita/app/view/laboratory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "incognita/messages/errors.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::message_of;
using testing::Scratch;

std::string refusal(const fs::path& folder) {
  return message_of([&] { Laboratory{folder}; });
}

TEST(Laboratory, RecognizesWhichCommandWroteTheFolder) {
  const Scratch claims, campaign;
  claims.write("claims.json", "[]");
  campaign.write("campaign.json", "{}");
  EXPECT_EQ(Laboratory(claims.folder()).kind(), Laboratory::Kind::claims);
  EXPECT_STREQ(Laboratory(claims.folder()).kind_name(), "claims");
  EXPECT_EQ(Laboratory(campaign.folder()).kind(), Laboratory::Kind::campaign);
  EXPECT_STREQ(Laboratory(campaign.folder()).kind_name(), "campaign");
}

TEST(Laboratory, RefusesOtherFoldersAndNamesWhatItLookedFor) {
  const Scratch other;
  EXPECT_HAS(refusal(other.folder()), other.folder().string() + " has neither claims.json");
  EXPECT_HAS(refusal(other.folder()), "nor campaign.json");
  other.write("claims.json", "[]");
  other.write("campaign.json", "{}");
  EXPECT_HAS(refusal(other.folder()), "has both claims.json");
  EXPECT_HAS(refusal(other / "claims.json"), "is not a folder");
  EXPECT_HAS(refusal(other / "absent"), "is not a folder: No such file");
}

TEST(Laboratory, AFolderNamedAsTheDocumentIsNotTheDocument) {
  const Scratch other;
  fs::create_directories(other / "claims.json");
  EXPECT_HAS(refusal(other.folder()), "neither");
}

TEST(Laboratory, ServesResultsAsTheyAre) {
  const Scratch folder;
  const std::string binary("<svg>\0\r\n", 8);
  folder.write("claims.json", "[]\n");
  folder.write("runs.csv", "variant,seed\n");
  folder.write("figures/fig-3.5.svg", binary);
  folder.write("figures/fig-3.5.csv", "t,x\n");
  const Laboratory laboratory(folder.folder());
  const auto served = [&](const std::string& name) { return laboratory.file(name).value_or(ServedFile{}); };
  EXPECT_EQ(served("claims.json").bytes, "[]\n");
  EXPECT_EQ(served("claims.json").content_type, "application/json");
  EXPECT_EQ(served("runs.csv").content_type, "text/csv; charset=utf-8");
  EXPECT_EQ(served("figures/fig-3.5.svg").bytes, binary);
  EXPECT_EQ(served("figures/fig-3.5.svg").content_type, "image/svg+xml");
  EXPECT_EQ(served("figures/fig-3.5.csv").bytes, "t,x\n");
  EXPECT_FALSE(laboratory.file("campaign.json"));
  EXPECT_FALSE(laboratory.file("figures/fig-3.6.svg"));
}

TEST(Laboratory, ServesNothingElse) {
  const Scratch outer;
  outer.write("secret.svg", "secret");
  outer.write("results/claims.json", "[]");
  for (const char* name : {"claims.md", ".lock", "figures/fig.gp", "figures/.svg", "figures/.hidden.svg",
                           "figures/deep/fig.svg", "runs/a/seed-1.json", "settings.json"})
    outer.write(std::string("results/") + name, "not for the page");
  const Laboratory laboratory(outer / "results");
  const std::string absolute = (outer / "secret.svg").string();
  for (const std::string& name : {std::string("claims.md"),
                                  std::string(".lock"),
                                  std::string("figures/fig.gp"),
                                  std::string("figures/.svg"),
                                  std::string("figures/.hidden.svg"),
                                  std::string("figures/deep/fig.svg"),
                                  std::string("runs/a/seed-1.json"),
                                  std::string("settings.json"),
                                  std::string(),
                                  std::string("."),
                                  std::string("figures"),
                                  std::string("figures/"),
                                  std::string("../secret.svg"),
                                  std::string("figures/../../secret.svg"),
                                  std::string("figures/../claims.json"),
                                  std::string("./claims.json"),
                                  std::string("/claims.json"),
                                  std::string("CLAIMS.JSON"),
                                  std::string("figures//fig.svg"),
                                  std::string("figures\\fig.svg"),
                                  std::string("claims.json\0", 12),
                                  std::string("figures/fig.gp\0.svg", 19),
                                  absolute,
                                  "figures/" + absolute})
    EXPECT_FALSE(laboratory.file(name)) << name;
}

TEST(Laboratory, FollowsNoLinkOutOfTheFolder) {
  const Scratch outer;
  outer.write("secret.svg", "secret");
  outer.write("elsewhere/fig-2.svg", "secret");
  outer.write("results/claims.json", "[]");
  outer.write("results/figures/fig-1.svg", "first");
  fs::create_symlink(outer / "secret.svg", outer / "results/figures/out.svg");
  fs::create_symlink("../../secret.svg", outer / "results/figures/relative.svg");
  fs::create_symlink("fig-1.svg", outer / "results/figures/within.svg");
  fs::create_symlink("nowhere.svg", outer / "results/figures/broken.svg");
  const Laboratory laboratory(outer / "results");
  EXPECT_FALSE(laboratory.file("figures/out.svg"));
  EXPECT_FALSE(laboratory.file("figures/relative.svg"));
  EXPECT_FALSE(laboratory.file("figures/broken.svg"));
  ASSERT_TRUE(laboratory.file("figures/within.svg"));
  EXPECT_EQ(laboratory.file("figures/within.svg")->bytes, "first");

  fs::remove_all(outer / "results/figures");
  fs::create_directory_symlink(outer / "elsewhere", outer / "results/figures");
  EXPECT_FALSE(laboratory.file("figures/fig-2.svg"));
}

TEST(Laboratory, AFolderWhoseNameBeginsAlikeIsOutside) {
  const Scratch outer;
  outer.write("results/claims.json", "[]");
  outer.write("results-of-others/fig.svg", "secret");
  fs::create_directory_symlink(outer / "results-of-others", outer / "results/figures");
  EXPECT_FALSE(Laboratory(outer / "results").file("figures/fig.svg"));
}

TEST(Laboratory, AFolderMayItselfBeALink) {
  const Scratch outer;
  outer.write("results/claims.json", "[]");
  fs::create_directory_symlink(outer / "results", outer / "latest");
  EXPECT_TRUE(Laboratory(outer / "latest").file("claims.json"));
}

TEST(Laboratory, BoundsTheSizeOfFiles) {
  const Scratch folder;
  folder.write("claims.json", std::string(100, ' '));
  EXPECT_TRUE(Laboratory(folder.folder(), 100).file("claims.json"));
  EXPECT_HAS(message_of([&] { Laboratory(folder.folder(), 99).file("claims.json"); }), "claims.json");
}

}  // namespace
}  // namespace incognita
