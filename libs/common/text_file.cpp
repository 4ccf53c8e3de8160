#include "common/text_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "common/error.h"

namespace nao {

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error("cannot read " + file.string());
  return text.str();
}

uint64_t digest(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (char byte : text) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3u;
  }
  return hash;
}

uint64_t digest_files(const std::filesystem::path& folder, const std::filesystem::path& except) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if ((extension == ".yaml" || extension == ".urdf") && entry.path() != except) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::string all;
  for (const auto& file : files) all += file.filename().string() + "\n" + read_file(file);
  return digest(all);
}

}  // namespace nao
