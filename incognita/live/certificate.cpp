#include "incognita/live/certificate.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
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

constexpr const char* issuer_prefix = "incognita on ";
constexpr int least_security_bits = 128;  // those of P-256, which is made here
constexpr long valid_s = 820L * 24 * 3600, renewed_before_s = 7L * 24 * 3600;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(
      fmt::format("{}: {}; make the folder writable, or set XDG_CONFIG_HOME to another", file.string(), why));
}

std::string name_of_machine() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] ? name.data() : "localhost";
}

struct ServedNames {
  std::vector<std::string> hosts, addresses;  ///< addresses: numerical IPv4 or IPv6
};

ServedNames served_names(const std::vector<std::string>& addresses) {
  ServedNames names{{name_of_machine(), "localhost"}, {"127.0.0.1"}};
  names.addresses.insert(names.addresses.end(), addresses.begin(), addresses.end());
  return names;
}

/// "DNS:robot,DNS:localhost,IP:192.168.1.7"
std::string alternative_names(const ServedNames& names) {
  return fmt::format("DNS:{},IP:{}", fmt::join(names.hosts, ",DNS:"), fmt::join(names.addresses, ",IP:"));
}

/// "critical,permitted;DNS:robot,permitted;IP:192.168.1.7/255.255.255.255" (RFC 5280, 4.2.1.10). Phones trust the certificate as an
/// authority: without it, whoever reads the key could pass for any site.
std::string name_constraints(const ServedNames& names) {
  std::string text = fmt::format("critical,permitted;DNS:{}", fmt::join(names.hosts, ",permitted;DNS:"));
  for (const std::string& address : names.addresses) {
    const bool is_v6 = address.find(':') != std::string::npos;
    text += fmt::format(",permitted;IP:{}/{}", address,
                        is_v6 ? "ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff" : "255.255.255.255");
  }
  return text;
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
  const std::string common = issuer_prefix + name_of_machine();
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(common.substr(0, 64).c_str()), -1, -1, 0);
  const ServedNames names = served_names(addresses);
  const bool complete = X509_set_issuer_name(made.get(), name) == 1 &&
                        X509_set_pubkey(made.get(), &key) == 1 &&
                        add_extension(*made, NID_subject_alt_name, alternative_names(names)) &&
                        add_extension(*made, NID_basic_constraints, "critical,CA:TRUE") &&
                        add_extension(*made, NID_name_constraints, name_constraints(names)) &&
                        add_extension(*made, NID_key_usage, "critical,digitalSignature,keyCertSign") &&
                        add_extension(*made, NID_ext_key_usage, "serverAuth");
  if (!complete || X509_sign(made.get(), &key, EVP_sha256()) == 0) return nullptr;
  return made;
}

/// Null if there is no such file. One that cannot be opened may be anybody's, and must not be replaced.
File open_if_there(const fs::path& path) {
  File file(std::fopen(path.c_str(), "r"));
  if (!file && errno != ENOENT)
    refuse(path, "cannot be read: " + std::error_code(errno, std::generic_category()).message());
  return file;
}

X509Certificate read_certificate(const fs::path& path) {
  const File file = open_if_there(path);
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

/// Null if it cannot be read without a password.
Key read_key(const fs::path& path) {
  const File file = open_if_there(path);
  std::array<char, 1> no_password{};
  return Key(file ? PEM_read_PrivateKey(file.get(), nullptr, nullptr, no_password.data()) : nullptr);
}

bool is_our_own(const X509& certificate) {
  std::array<char, 256> issuer{};
  X509_NAME_get_text_by_NID(X509_get_issuer_name(&certificate), NID_commonName, issuer.data(),
                            static_cast<int>(issuer.size()));
  return std::string_view(issuer.data()).starts_with(issuer_prefix);
}

/// Earlier versions made certificates without.
bool is_constrained(const X509& certificate) {
  return X509_get_ext_by_NID(&certificate, NID_name_constraints, -1) >= 0;
}

bool can_serve(X509& certificate, EVP_PKEY* key, const std::vector<std::string>& addresses) {
  return is_valid_for_a_week(certificate) && names_all(certificate, addresses) && key &&
         X509_check_private_key(&certificate, key) == 1;
}

/// Not the key of an authority without constraints, which phones may still trust: without its key nobody can use it. A key of any
/// other kind is not from here, or is too weak.
bool can_sign(EVP_PKEY* key, const X509* old) {
  return (!old || is_constrained(*old)) && key && EVP_PKEY_is_a(key, "EC") &&
         EVP_PKEY_get_security_bits(key) >= least_security_bits;
}

[[noreturn]] void refuse_foreign(const Certificate& found, const std::vector<std::string>& addresses) {
  throw InputError(fmt::format(
      "{}: is not a certificate of this program, which leaves it as it is, but it cannot serve the page: it must be valid for a week, name "
      "the addresses of this machine ({}), and fit the key {}; renew it, or move both files away",
      found.file.string(), fmt::join(addresses, ", "), found.key.string()));
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
  const X509Certificate old = read_certificate(out.file);
  Key key = read_key(out.key);
  const bool is_foreign = old && !is_our_own(*old);
  if (old && can_serve(*old, key.get(), addresses) && (is_foreign || is_constrained(*old))) return out;
  if (is_foreign) refuse_foreign(out, addresses);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, error.message());
  const bool keeps_key = can_sign(key.get(), old.get());
  if (!keeps_key) key.reset(EVP_EC_gen("P-256"));
  const X509Certificate made = key ? certificate_for(*key, addresses) : nullptr;
  if (!made) throw std::runtime_error("OpenSSL could not make a certificate");
  if (!keeps_key)
    write_private(out.key, [&](std::FILE* file) {
      return PEM_write_PrivateKey(file, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
  write_private(out.file, [&](std::FILE* file) { return PEM_write_X509(file, made.get()); });
  out.is_new = true;
  return out;
}

}  // namespace incognita
