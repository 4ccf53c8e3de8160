#include "phone-gateway/web_stream/own_host.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>

namespace nao {

std::string own_host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::vector<std::string> own_host_names() {
  const std::string name = own_host_name();
  if (name.empty()) return {};
  return {name, name.substr(0, name.find('.'))};
}

std::vector<std::string> search_domains(std::istream& resolv_conf) {
  std::vector<std::string> domains;
  std::string line;
  while (std::getline(resolv_conf, line)) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || (word != "search" && word != "domain")) continue;
    domains.clear();
    while (words >> word) {
      if (word != ".") domains.push_back(word);
    }
  }
  return domains;
}

std::vector<std::string> own_search_domains() {
  std::ifstream file("/etc/resolv.conf");
  return search_domains(file);
}

}  // namespace nao
