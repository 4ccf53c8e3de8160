#include "phone-gateway/server/pairing/certificate.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "test/support/temporary_folder.h"

namespace nao::gateway {
namespace {

TEST(Certificate, IsCreatedOnceAndReused) {
  const TemporaryFolder folder;
  const CertificateNames names{{"robot", "localhost"}, {"192.168.1.5", "127.0.0.1"}};
  const CertificateFiles files = own_certificate(folder.path() / "new", names);
  const std::string first = certificate_fingerprint(files.certificate);
  EXPECT_EQ(first.size(), 32u * 3 - 1);
  own_certificate(folder.path() / "new", names);
  EXPECT_EQ(certificate_fingerprint(files.certificate), first);
}

TEST(Certificate, IsReplacedForANewAddress) {
  const TemporaryFolder folder;
  const CertificateFiles files = own_certificate(folder.path(), {{"robot"}, {"192.168.1.5"}});
  const std::string first = certificate_fingerprint(files.certificate);
  own_certificate(folder.path(), {{"robot"}, {"192.168.1.6"}});
  EXPECT_NE(certificate_fingerprint(files.certificate), first);
}

TEST(Certificate, HasAKeyThatOnlyItsOwnerCanRead) {
  const TemporaryFolder folder;
  const CertificateFiles files = own_certificate(folder.path(), {{"robot"}, {}});
  struct stat status = {};
  ASSERT_EQ(stat(files.key.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_NE(read_text(files.key).find("PRIVATE KEY"), std::string::npos);
}

TEST(Certificate, IsReplacedWhereItsKeyIsThatOfAnother) {
  const TemporaryFolder folder;
  const CertificateNames names{{"robot"}, {}};
  const CertificateFiles files = own_certificate(folder.path(), names);
  const std::string first = certificate_fingerprint(files.certificate);
  const CertificateFiles others = own_certificate(folder.path() / "other", names);
  std::filesystem::rename(others.key, files.key);
  own_certificate(folder.path(), names);
  EXPECT_NE(certificate_fingerprint(files.certificate), first);
}

}  // namespace
}  // namespace nao::gateway
