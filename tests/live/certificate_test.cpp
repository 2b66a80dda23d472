// The certificate of the page: made once, renewed when the addresses of the machine change, readable by its owner only.
#include "incognita/live/certificate.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

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

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
using Key = std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)>;
using X509Pointer = std::unique_ptr<X509, void (*)(X509*)>;

File open_file(const std::filesystem::path& path, const char* mode) {
  return {std::fopen(path.c_str(), mode), &std::fclose};
}

/// As another program reads it.
struct Pair {
  explicit Pair(const Certificate& made)
      : certificate(PEM_read_X509(open_file(made.file, "r").get(), nullptr, nullptr, nullptr), &X509_free),
        key(PEM_read_PrivateKey(open_file(made.key, "r").get(), nullptr, nullptr, nullptr), &EVP_PKEY_free) {}
  X509Pointer certificate;
  Key key;
};

/// A certificate for `names` ("DNS:a,IP:b"), signed with the key, and valid for 30 days.
X509Pointer signed_for(const std::string& names, const std::string& subject, const X509_NAME* issuer,
                       EVP_PKEY* key) {
  X509Pointer made(X509_new(), &X509_free);
  X509_set_version(made.get(), 2);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), -60);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), 30L * 24 * 3600);
  X509_NAME* name = X509_get_subject_name(made.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(subject.c_str()), -1, -1, 0);
  X509_set_issuer_name(made.get(), issuer ? issuer : name);
  X509_set_pubkey(made.get(), key);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, names.c_str());
  EXPECT_TRUE(extension && X509_add_ext(made.get(), extension, -1) == 1);
  X509_EXTENSION_free(extension);
  EXPECT_GT(X509_sign(made.get(), key, EVP_sha256()), 0);
  return made;
}

void write_foreign(const Certificate& place, const std::string& names,
                   const std::string& subject = "My own authority") {
  const Key key(EVP_EC_gen("P-256"), &EVP_PKEY_free);
  const X509Pointer made = signed_for(names, subject, nullptr, key.get());
  ASSERT_EQ(
      PEM_write_PrivateKey(open_file(place.key, "w").get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr),
      1);
  ASSERT_EQ(PEM_write_X509(open_file(place.file, "w").get(), made.get()), 1);
}

/// The verdict of OpenSSL on a certificate for `names` that who has the key of `authority` made: an X509_V_ERR_..., or X509_V_OK.
int why_not_trusted(const Pair& authority, const std::string& names) {
  const X509Pointer site =
      signed_for(names, "site", X509_get_subject_name(authority.certificate.get()), authority.key.get());
  const std::unique_ptr<X509_STORE, void (*)(X509_STORE*)> store(X509_STORE_new(), &X509_STORE_free);
  X509_STORE_add_cert(store.get(), authority.certificate.get());
  const std::unique_ptr<X509_STORE_CTX, void (*)(X509_STORE_CTX*)> check(X509_STORE_CTX_new(),
                                                                         &X509_STORE_CTX_free);
  X509_STORE_CTX_init(check.get(), store.get(), site.get(), nullptr);
  X509_verify_cert(check.get());
  return X509_STORE_CTX_get_error(check.get());
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

TEST(Certificate, KeepsTheKeyForOtherAddresses) {
  const Scratch scratch;
  const Certificate made = certificate_in(scratch.folder(), {"192.168.1.7"});
  const std::string key = contents(made.key), before = contents(made.file);
  EXPECT_TRUE(certificate_in(scratch.folder(), {"10.0.0.3"}).is_new);
  EXPECT_EQ(contents(made.key), key);
  EXPECT_NE(contents(made.file), before);
}

TEST(Certificate, IsConstrainedToItsNames) {
  const Scratch scratch;
  const Pair made(certificate_in(scratch.folder(), {"192.168.1.7", "fd00::7"}));
  EXPECT_EQ(X509_get_key_usage(made.certificate.get()),
            static_cast<unsigned>(KU_DIGITAL_SIGNATURE | KU_KEY_CERT_SIGN));
  int is_critical = 0;
  const std::unique_ptr<NAME_CONSTRAINTS, decltype(&NAME_CONSTRAINTS_free)> constraints(
      static_cast<NAME_CONSTRAINTS*>(
          X509_get_ext_d2i(made.certificate.get(), NID_name_constraints, &is_critical, nullptr)),
      &NAME_CONSTRAINTS_free);
  ASSERT_TRUE(constraints);
  EXPECT_EQ(is_critical, 1);
  EXPECT_EQ(constraints->excludedSubtrees, nullptr);
  EXPECT_EQ(sk_GENERAL_SUBTREE_num(constraints->permittedSubtrees), 5)
      << "the machine, localhost, 127.0.0.1 and both addresses";
}

TEST(Certificate, IsNoAuthorityForOtherSites) {
  const Scratch scratch;
  const Pair authority(certificate_in(scratch.folder(), {"192.168.1.7"}));
  EXPECT_EQ(why_not_trusted(authority, "IP:192.168.1.7"), X509_V_OK);
  EXPECT_EQ(why_not_trusted(authority, "DNS:localhost"), X509_V_OK);
  for (const char* other :
       {"IP:192.168.1.8", "DNS:bank.example", "IP:fd00::7", "DNS:localhost,DNS:bank.example"})
    EXPECT_EQ(why_not_trusted(authority, other), X509_V_ERR_PERMITTED_VIOLATION) << other;
}

TEST(Certificate, OfAnotherIssuerIsUsedButNeverReplaced) {
  const Scratch scratch;
  const Certificate place{scratch / "certificate.pem", scratch / "certificate-key.pem"};
  write_foreign(place, "IP:192.168.1.7");
  const std::string certificate = contents(place.file), key = contents(place.key);
  EXPECT_FALSE(certificate_in(scratch.folder(), {"192.168.1.7"}).is_new);
  const std::string why = message_of([&] { certificate_in(scratch.folder(), {"192.168.1.7", "10.0.0.2"}); });
  EXPECT_HAS(why, place.file.string() + ": is not a certificate of this program");
  EXPECT_HAS(why, "192.168.1.7, 10.0.0.2");
  std::filesystem::remove(place.key);
  EXPECT_HAS(message_of([&] { certificate_in(scratch.folder(), {"192.168.1.7"}); }),
             "is not a certificate of this program");
  EXPECT_FALSE(std::filesystem::exists(place.key));
  EXPECT_EQ(contents(place.file), certificate);
}

TEST(Certificate, ThatCannotBeOpenedIsNotReplaced) {
  for (const char* name : {"certificate.pem", "certificate-key.pem"}) {
    const Scratch scratch;
    std::filesystem::create_symlink(name, scratch / name);  // to itself
    EXPECT_HAS(message_of([&] { certificate_in(scratch.folder(), {}); }),
               std::string(name) + ": cannot be read: ");
    EXPECT_TRUE(std::filesystem::is_symlink(scratch / name));
  }
}

TEST(Certificate, WithoutConstraintsIsMadeAnewWithAnotherKey) {
  const Scratch scratch;
  const Certificate place{scratch / "certificate.pem", scratch / "certificate-key.pem"};
  write_foreign(place, "IP:192.168.1.7", "incognita on robot");
  const std::string key = contents(place.key);
  EXPECT_TRUE(certificate_in(scratch.folder(), {"192.168.1.7"}).is_new);
  EXPECT_NE(contents(place.key), key) << "phones may still trust the earlier one";
  EXPECT_EQ(why_not_trusted(Pair(place), "DNS:bank.example"), X509_V_ERR_PERMITTED_VIOLATION);
}

TEST(Certificate, SaysWhereItCannotBeWritten) {
  const Scratch scratch;
  scratch.write("file", "");
  EXPECT_HAS(message_of([&] { certificate_in(scratch / "file/config", {}); }),
             "set XDG_CONFIG_HOME to another");
}

/// Of interfaces that are up, without the loopback, by another question to the kernel than own_addresses() asks.
std::set<std::string> addresses_by_ioctl() {
  const int any = socket(AF_INET, SOCK_DGRAM, 0);
  std::array<ifreq, 64> requests{};
  ifconf all{};
  all.ifc_len = sizeof requests;
  all.ifc_req = requests.data();
  EXPECT_EQ(ioctl(any, SIOCGIFCONF, &all), 0);
  std::set<std::string> found;
  for (std::size_t i = 0; i < static_cast<std::size_t>(all.ifc_len) / sizeof(ifreq); ++i) {
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(&requests[i].ifr_addr);
    inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    EXPECT_EQ(ioctl(any, SIOCGIFFLAGS, &requests[i]), 0);
    if ((requests[i].ifr_flags & IFF_UP) && !(requests[i].ifr_flags & IFF_LOOPBACK))
      found.insert(text.data());
  }
  close(any);
  return found;
}

TEST(OwnAddresses, AreThoseOfTheInterfacesButTheLoopback) {
  const std::set<std::string> expected = addresses_by_ioctl();
  const std::vector<std::string> found = own_addresses();
  EXPECT_EQ(std::set(found.begin(), found.end()), expected);
  EXPECT_FALSE(expected.contains("127.0.0.1"));
  if (expected.empty()) GTEST_SKIP() << "this machine has no network: there is no address to find";
}

}  // namespace
}  // namespace incognita
