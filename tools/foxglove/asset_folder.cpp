#include "tools/foxglove/asset_folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

namespace nao::foxglove {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://robot/";
constexpr const char* kUrdfName = "robot.urdf";
// Largest file that is served, bytes, to bound memory. Chosen: a mesh has at most some 100 kB.
constexpr uintmax_t kMaxFileBytes = 16u << 20;

/** Whether each letter is one of file names, and no part begins with a point: neither ".." nor a
 * hidden file. */
bool is_plain_path(std::string_view path) {
  const bool has_plain_letters = std::all_of(path.begin(), path.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') ||
           std::string_view("_-./").find(letter) != std::string_view::npos;
  });
  return has_plain_letters && !path.empty() && path.front() != '.' && path.front() != '/' &&
         path.find("/.") == std::string_view::npos && path.find("//") == std::string_view::npos;
}

}  // namespace

AssetFolder::AssetFolder(const fs::path& folder, const fs::path& urdf_file)
    : folder_(fs::canonical(folder)), urdf_file_(urdf_file) {}

std::shared_ptr<const std::string> AssetFolder::read(std::string_view path) {
  if (const auto known = files_.find(path); known != files_.end()) return known->second;
  if (!is_plain_path(path)) return nullptr;
  std::error_code error;
  const fs::path file = path == kUrdfName ? urdf_file_ : fs::canonical(folder_ / path, error);
  if (error || !fs::is_regular_file(file, error)) return nullptr;
  // A symbolic link may lead out of the folder.
  const auto [end, rest] = std::mismatch(folder_.begin(), folder_.end(), file.begin(), file.end());
  if (path != kUrdfName && end != folder_.end()) return nullptr;
  if (fs::file_size(file, error) > kMaxFileBytes || error) return nullptr;
  std::ifstream stream(file, std::ios::binary);
  auto content = std::make_shared<const std::string>(std::istreambuf_iterator<char>(stream),
                                                     std::istreambuf_iterator<char>());
  if (!stream) return nullptr;
  files_.emplace(path, content);
  return content;
}

std::shared_ptr<const std::string> AssetFolder::read_uri(std::string_view uri) {
  return uri.starts_with(kPackage) ? read(uri.substr(kPackage.size())) : nullptr;
}

std::string content_type(std::string_view path) {
  if (path.ends_with(".urdf")) return "application/xml";
  if (path.ends_with(".glb")) return "model/gltf-binary";
  if (path.ends_with(".yaml")) return "application/yaml";
  return "application/octet-stream";
}

}  // namespace nao::foxglove
