#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nao::gateway {

/** A certificate and its key, PEM files. */
struct CertificateFiles {
  std::filesystem::path certificate;
  std::filesystem::path key;
};

/** The names that a certificate is valid for. */
struct CertificateNames {
  /** DNS names, the first also as its common name. */
  std::vector<std::string> host_names;
  /** IP addresses, as text. */
  std::vector<std::string> addresses;
};

/** The gateway's own certificate: created at the first start, and again when it expires within a
 * week or lacks one of the names. Self-signed (P-256, 800 days), so that a browser asks its user
 * once. The key is readable by its owner only.
 * @param folder  Folder of the files; created if it does not exist.
 * @throws Error  if they cannot be written, or OpenSSL fails. */
CertificateFiles own_certificate(const std::filesystem::path& folder,
                                 const CertificateNames& names);

/** SHA-256 fingerprint of a certificate as browsers show it, "AB:CD:...".
 * @throws Error  if the file is not a certificate. */
std::string certificate_fingerprint(const std::filesystem::path& certificate);

}  // namespace nao::gateway
