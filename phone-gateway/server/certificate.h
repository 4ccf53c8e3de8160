#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nao {

/** A certificate and its key, PEM files. */
struct CertificateFiles {
  std::filesystem::path certificate;
  std::filesystem::path key;
};

/** What a certificate shall be good for. */
struct CertificateNames {
  /** DNS names, the first also as its common name. */
  std::vector<std::string> host_names;
  /** IP addresses, as text. */
  std::vector<std::string> addresses;
};

/** The gateway's own certificate: made at the first start, and anew when it has less than a week
 * left or lacks one of the names. Self-signed (P-256, 800 days: Apple's phones take at most 825),
 * so that a browser asks its user once. The key is readable by its owner only.
 * @param folder  Where the files are kept; made if it is not there.
 * @throws Error  if they cannot be written, or OpenSSL fails. */
CertificateFiles own_certificate(const std::filesystem::path& folder,
                                 const CertificateNames& names);

/** SHA-256 of a certificate as browsers show it, "AB:CD:...", so that a user can compare.
 * @throws Error  if the file is no certificate. */
std::string certificate_fingerprint(const std::filesystem::path& certificate);

/** Folder for what programs keep between runs: XDG_STATE_HOME/nao-remote, usually
 * ~/.local/state/nao-remote. */
std::filesystem::path state_folder();

}  // namespace nao
