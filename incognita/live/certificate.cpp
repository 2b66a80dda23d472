#include "incognita/live/certificate.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;

template <auto release>
struct Release {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Release<EVP_PKEY_free>>;
using X509Certificate = std::unique_ptr<X509, Release<X509_free>>;
using File = std::unique_ptr<std::FILE, Release<std::fclose>>;

constexpr long valid_s = 820L * 24 * 3600, renewed_before_s = 7L * 24 * 3600;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(
      fmt::format("{}: {}; make the folder writable, or set XDG_CONFIG_HOME to another", file.string(), why));
}

std::string name_of_machine() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] ? name.data() : "localhost";
}

/// "DNS:robot,DNS:localhost,IP:192.168.1.7"
std::string alternative_names(const std::vector<std::string>& addresses) {
  std::string names = fmt::format("DNS:{},DNS:localhost,IP:127.0.0.1", name_of_machine());
  for (const std::string& address : addresses) names += ",IP:" + address;
  return names;
}

bool add_extension(X509& certificate, int nid, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &certificate, &certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, nid, value.c_str());
  if (!extension) return false;
  const bool added = X509_add_ext(&certificate, extension, -1) == 1;
  X509_EXTENSION_free(extension);
  return added;
}

bool set_serial_number(X509& certificate) {
  std::array<unsigned char, 8> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1) return false;
  std::uint64_t number = 0;
  std::memcpy(&number, random.data(), random.size());
  return ASN1_INTEGER_set_uint64(X509_get_serialNumber(&certificate), number >> 1) == 1;
}

/// Signed by itself; null if OpenSSL fails.
X509Certificate certificate_for(EVP_PKEY& key, const std::vector<std::string>& addresses) {
  X509Certificate made(X509_new());
  if (!made || X509_set_version(made.get(), 2) != 1 || !set_serial_number(*made)) return nullptr;
  X509_gmtime_adj(X509_getm_notBefore(made.get()), -3600);  // clocks differ
  X509_gmtime_adj(X509_getm_notAfter(made.get()), valid_s);
  X509_NAME* name = X509_get_subject_name(made.get());
  const std::string common = "incognita on " + name_of_machine();
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(common.substr(0, 64).c_str()), -1, -1, 0);
  const bool complete = X509_set_issuer_name(made.get(), name) == 1 &&
                        X509_set_pubkey(made.get(), &key) == 1 &&
                        add_extension(*made, NID_subject_alt_name, alternative_names(addresses)) &&
                        add_extension(*made, NID_basic_constraints, "critical,CA:TRUE") &&
                        add_extension(*made, NID_ext_key_usage, "serverAuth");
  if (!complete || X509_sign(made.get(), &key, EVP_sha256()) == 0) return nullptr;
  return made;
}

X509Certificate read_certificate(const fs::path& path) {
  const File file(std::fopen(path.c_str(), "r"));
  return X509Certificate(file ? PEM_read_X509(file.get(), nullptr, nullptr, nullptr) : nullptr);
}

bool is_valid_for_a_week(const X509& certificate) {
  std::time_t in_a_week = std::time(nullptr) + renewed_before_s;
  return X509_cmp_time(X509_get0_notAfter(&certificate), &in_a_week) > 0;
}

bool names_all(X509& certificate, const std::vector<std::string>& addresses) {
  for (const std::string& address : addresses)
    if (X509_check_ip_asc(&certificate, address.c_str(), 0) != 1) return false;
  return true;
}

bool matches_key(X509& certificate, const fs::path& path) {
  const File file(std::fopen(path.c_str(), "r"));
  const Key key(file ? PEM_read_PrivateKey(file.get(), nullptr, nullptr, nullptr) : nullptr);
  return key && X509_check_private_key(&certificate, key.get()) == 1;
}

/// `write` is a function of OpenSSL that writes to a file. Nobody else can read it, from its first byte on.
template <class Write>
void write_private(const fs::path& path, Write write) {
  const fs::path part = path.string() + ".part";
  const mode_t before = umask(077);
  File file(std::fopen(part.c_str(), "w"));
  umask(before);
  const bool written = file && write(file.get()) == 1 && std::fflush(file.get()) == 0;
  std::error_code error;
  if (written) fs::rename(part, path, error);
  if (!written || error) refuse(path, "cannot be written");
}

}  // namespace

std::vector<std::string> own_addresses() {
  ifaddrs* first = nullptr;
  std::vector<std::string> found;
  if (getifaddrs(&first) != 0) return found;
  for (const ifaddrs* one = first; one; one = one->ifa_next) {
    const bool is_usable = one->ifa_addr && one->ifa_addr->sa_family == AF_INET &&
                           (one->ifa_flags & IFF_UP) && !(one->ifa_flags & IFF_LOOPBACK);
    if (!is_usable) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size())) found.emplace_back(text.data());
  }
  freeifaddrs(first);
  return found;
}

fs::path certificate_folder() {
  const char *config = std::getenv("XDG_CONFIG_HOME"), *home = std::getenv("HOME");
  if (config && *config) return fs::path(config) / "incognita";
  if (home && *home) return fs::path(home) / ".config" / "incognita";
  throw InputError(
      "neither XDG_CONFIG_HOME nor HOME is set: set XDG_CONFIG_HOME to a folder for the certificate of the page");
}

Certificate certificate_in(const fs::path& folder, const std::vector<std::string>& addresses) {
  Certificate out{folder / "certificate.pem", folder / "certificate-key.pem"};
  if (const auto old = read_certificate(out.file);
      old && is_valid_for_a_week(*old) && names_all(*old, addresses) && matches_key(*old, out.key))
    return out;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, error.message());
  const Key key(EVP_EC_gen("P-256"));
  const X509Certificate made = key ? certificate_for(*key, addresses) : nullptr;
  if (!made) throw std::runtime_error("OpenSSL could not make a certificate");
  write_private(out.key, [&](std::FILE* file) {
    return PEM_write_PrivateKey(file, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  });
  write_private(out.file, [&](std::FILE* file) { return PEM_write_X509(file, made.get()); });
  out.is_new = true;
  return out;
}

}  // namespace incognita
