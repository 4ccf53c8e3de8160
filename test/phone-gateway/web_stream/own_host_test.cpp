#include "phone-gateway/web_stream/own_host.h"

#include <gmock/gmock.h>

#include <sstream>

namespace nao {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> domains_of(const std::string& text) {
  std::istringstream file(text);
  return search_domains(file);
}

TEST(OwnHost, IsInTheDomainsOfTheLastSearchLine) {
  EXPECT_THAT(domains_of("# search a.example\nnameserver 127.0.0.53\ndomain old.example\n"
                         "search fritz.box uni-x.de\noptions edns0\n"),
              ElementsAre("fritz.box", "uni-x.de"));
}

TEST(OwnHost, IsInNoDomainWithoutOne) {
  EXPECT_THAT(domains_of(""), IsEmpty());
  EXPECT_THAT(domains_of("nameserver 10.0.0.1\nsearch .\n"), IsEmpty());
}

}  // namespace
}  // namespace nao
