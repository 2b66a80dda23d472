// The certificate of the page: made once, renewed when the addresses of the machine change, readable by its owner only.
#include "incognita/live/certificate.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::message_of;
using testing::Scratch;

unsigned mode_of(const std::filesystem::path& file) {
  struct stat status {};
  EXPECT_EQ(stat(file.c_str(), &status), 0);
  return status.st_mode & 0777u;
}

TEST(Certificate, IsMadeOnceAndUsedAgain) {
  const Scratch scratch;
  const Certificate made = certificate_in(scratch / "config", {"192.168.1.7"});
  EXPECT_TRUE(made.is_new);
  EXPECT_HAS(contents(made.file), "BEGIN CERTIFICATE");
  EXPECT_HAS(contents(made.key), "BEGIN PRIVATE KEY");
  EXPECT_EQ(mode_of(made.key), 0600u);
  const std::string before = contents(made.file);
  EXPECT_FALSE(certificate_in(scratch / "config", {"192.168.1.7"}).is_new);
  EXPECT_EQ(contents(made.file), before);
}

TEST(Certificate, IsMadeAnewForAnotherAddress) {
  const Scratch scratch;
  certificate_in(scratch / "c", {"192.168.1.7"});
  EXPECT_TRUE(certificate_in(scratch / "c", {"192.168.1.7", "10.0.0.2"}).is_new);
  EXPECT_FALSE(certificate_in(scratch / "c", {"10.0.0.2"}).is_new) << "it names more than are needed";
  EXPECT_TRUE(certificate_in(scratch / "c", {"10.0.0.3"}).is_new);
}

TEST(Certificate, IsMadeAnewIfItIsDamagedOrItsKeyIsNotThere) {
  const Scratch scratch;
  const Certificate made = certificate_in(scratch.folder(), {});
  testing::write(made.file, "-----BEGIN CERTIFICATE-----\ngarbage");
  EXPECT_TRUE(certificate_in(scratch.folder(), {}).is_new);
  std::filesystem::remove(made.key);
  EXPECT_TRUE(certificate_in(scratch.folder(), {}).is_new);
  const Scratch other;
  const Certificate foreign = certificate_in(other.folder(), {});
  testing::write(made.key, contents(foreign.key));
  EXPECT_TRUE(certificate_in(scratch.folder(), {}).is_new) << "the key of another certificate";
}

TEST(Certificate, SaysWhereItCannotBeWritten) {
  const Scratch scratch;
  scratch.write("file", "");
  EXPECT_HAS(message_of([&] { certificate_in(scratch / "file/config", {}); }),
             "set XDG_CONFIG_HOME to another");
}

TEST(OwnAddresses, AreNoneOfTheLoopback) {
  for (const std::string& address : own_addresses()) EXPECT_FALSE(address.starts_with("127.")) << address;
}

}  // namespace
}  // namespace incognita
