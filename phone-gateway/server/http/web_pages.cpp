#include "phone-gateway/server/http/web_pages.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "phone-gateway/server/http/gzip.h"

namespace nao::gateway {
namespace {

namespace fs = std::filesystem;

/** Largest file that is served, to bound memory. Chosen: files of the app and of robots are far
 * smaller. */
constexpr uintmax_t kMaxFileBytes = 64u << 20;

struct FileType {
  const char* extension;
  const char* mime;
  bool is_compressible;
};

constexpr std::array<FileType, 20> kFileTypes{{
    {".html", "text/html; charset=utf-8", true},
    {".js", "text/javascript; charset=utf-8", true},
    {".mjs", "text/javascript; charset=utf-8", true},
    {".css", "text/css; charset=utf-8", true},
    {".json", "application/json", true},
    {".webmanifest", "application/manifest+json", true},
    {".map", "application/json", true},
    {".urdf", "application/xml", true},
    {".xml", "application/xml", true},
    {".yaml", "application/yaml", true},
    {".txt", "text/plain; charset=utf-8", true},
    {".svg", "image/svg+xml", true},
    {".glb", "model/gltf-binary", true},
    {".wasm", "application/wasm", true},
    {".ico", "image/x-icon", true},
    {".ttf", "font/ttf", true},
    {".png", "image/png", false},
    {".jpg", "image/jpeg", false},
    {".webp", "image/webp", false},
    {".woff2", "font/woff2", false},
}};

const FileType* find_type(const fs::path& file) {
  const std::string extension = file.extension().string();
  const auto found = std::find_if(kFileTypes.begin(), kFileTypes.end(), [&](const FileType& type) {
    return extension == type.extension;
  });
  return found == kFileTypes.end() ? nullptr : &*found;
}

// @return -1 if it is not a hexadecimal digit.
int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// RFC 3986, 2.1. nullopt if a '%' is not followed by two digits.
std::optional<std::string> decode_percent(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded.push_back(text[i]);
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hex_value(text[i + 1]);
    const int low = hex_value(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    decoded.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  return decoded;
}

/** ETag of a file: its FNV-1a hash, 64 bits (http://www.isthe.com/chongo/tech/comp/fnv). Detects
 * changes; not cryptographic. */
std::string content_tag(std::string_view bytes) {
  uint64_t hash = 14695981039346656037u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  std::ostringstream tag;
  tag << '"' << std::hex << hash << '"';
  return tag.str();
}

/** Whether an Accept-Encoding header contains gzip without ";q=0". */
bool accepts_gzip(const std::string& accept_encoding) {
  std::istringstream encodings(accept_encoding);
  for (std::string encoding; std::getline(encodings, encoding, ',');) {
    encoding.erase(std::remove(encoding.begin(), encoding.end(), ' '), encoding.end());
    if (encoding == "gzip" || encoding == "*") return true;
    if (encoding.rfind("gzip;q=", 0) == 0) {
      return encoding.find_first_of("123456789", encoding.find('=')) != std::string::npos;
    }
  }
  return false;
}

PageResponse plain_response(int status, const std::string& text) {
  PageResponse response;
  response.status = status;
  response.headers = {{"Content-Type", "text/plain; charset=utf-8"}, {"Cache-Control", "no-store"}};
  response.body = std::make_shared<const std::string>(text + "\n");
  return response;
}

/** The build puts a hash of the content into the names of these files: a browser may cache them for
 * ever. */
bool is_named_after_content(const std::string& path) {
  return path.rfind("/assets/", 0) == 0;
}

}  // namespace

std::string mime_type(const fs::path& file) {
  const FileType* type = find_type(file);
  return type == nullptr ? "application/octet-stream" : type->mime;
}

std::optional<std::string> clean_path(std::string_view target) {
  // Query and fragment name no file.
  auto path = decode_percent(target.substr(0, target.find_first_of("?#")));
  if (!path || path->empty() || path->front() != '/') return std::nullopt;
  for (const char c : *path) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f' || c == '\\') return std::nullopt;
  }
  // Refuses "..", hidden files, and "//etc", which std::filesystem takes for an absolute path.
  if (path->find("/.") != std::string::npos || path->find("//") != std::string::npos) {
    return std::nullopt;
  }
  return path;
}

PageResponse WebPages::respond(const PageRequest& request) {
  // RFC 9110, 15.5.6: a 405 response lists the allowed methods.
  if (request.method != "GET" && request.method != "HEAD") {
    PageResponse response = plain_response(405, "Only GET and HEAD are supported.");
    response.headers.emplace_back("Allow", "GET, HEAD");
    return response;
  }
  const auto path = clean_path(request.target);
  if (!path) return plain_response(400, "The target is not a valid path.");
  if (const auto page = pages_.find(*path); page != pages_.end()) {
    if (page->second.is_local_only && !request.is_local) {
      return plain_response(403, "This page is for the gateway's own host only.");
    }
    PageResponse response;
    response.headers = {{"Content-Type", page->second.type}, {"Cache-Control", "no-store"}};
    response.body = std::make_shared<const std::string>(page->second.make());
    return response;
  }
  const auto found = find_file(*path);
  const File* file = found ? read(*found) : nullptr;
  if (file == nullptr) return plain_response(404, "Not found.");

  PageResponse response;
  response.headers = {
      {"ETag", file->tag},
      {"Cache-Control",
       is_named_after_content(*path) ? "public, max-age=31536000, immutable" : "no-cache"},
      {"Vary", "Accept-Encoding"}};
  // RFC 9110, 13.1.2: the browser has this version already.
  if (request.if_none_match.find(file->tag) != std::string::npos) {
    response.status = 304;
    response.body = std::make_shared<const std::string>();
    return response;
  }
  response.headers.emplace_back("Content-Type", file->type);
  response.body = file->bytes;
  if (file->zipped && accepts_gzip(request.accept_encoding)) {
    response.headers.emplace_back("Content-Encoding", "gzip");
    response.body = file->zipped;
  }
  return response;
}

std::optional<fs::path> WebPages::find_file(const std::string& path) const {
  // Robots and scenes are read by the app as well; they are beside it in the data folder.
  const bool is_data = path.rfind("/robots/", 0) == 0 || path.rfind("/scenes/", 0) == 0;
  const fs::path folder = is_data ? data_ : data_ / "web";
  fs::path file = folder / fs::path(path).relative_path();
  std::error_code error;
  if (path.back() == '/') file /= "index.html";
  // /screen is the page screen.html.
  if (file.extension().empty()) file += ".html";
  // canonical() also fails for files that do not exist.
  const fs::path real_file = fs::canonical(file, error);
  if (error || !fs::is_regular_file(real_file, error)) return std::nullopt;
  return real_file;
}

const WebPages::File* WebPages::read(const fs::path& path) {
  std::error_code error;
  const auto changed = fs::last_write_time(path, error);
  const uintmax_t size = error ? 0 : fs::file_size(path, error);
  if (error || size > kMaxFileBytes) return nullptr;
  File& file = files_[path.string()];
  // Unchanged on disk: served from memory.
  if (file.bytes && file.changed == changed && file.size == size) return &file;

  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) return nullptr;
  file.changed = changed;
  file.size = size;
  file.tag = content_tag(bytes);
  file.type = mime_type(path);
  file.zipped = nullptr;
  const FileType* type = find_type(path);
  if (type != nullptr && type->is_compressible) {
    // Compressed once, and kept only where that makes the file smaller.
    std::string zipped = gzip(bytes);
    if (zipped.size() < bytes.size()) {
      file.zipped = std::make_shared<const std::string>(std::move(zipped));
    }
  }
  file.bytes = std::make_shared<const std::string>(std::move(bytes));
  return &file;
}

}  // namespace nao::gateway
