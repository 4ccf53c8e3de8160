#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nao::gateway {

/** The parts of an HTTP request that the response depends on. */
struct PageRequest {
  std::string method;
  /** Path and query: "/robots/nao/nao.urdf?x=1". */
  std::string target;
  std::string accept_encoding;
  std::string if_none_match;
  /** From the gateway's own host. */
  bool is_local = false;
};

/** An HTTP response. */
struct PageResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  /** Never null. For a HEAD request only its length is sent. */
  std::shared_ptr<const std::string> body;
};

/** The pages that the gateway serves over HTTP: the app, the files of robots and scenes, and pages
 * generated on request. Has no socket. */
class WebPages {
 public:
  /** A page generated at each request. */
  struct Page {
    std::string type;
    /** Served to the gateway's own host only. */
    bool is_local_only = false;
    std::function<std::string()> make;
  };

  /** @param data  Folder with web/, robots/ and scenes/. */
  explicit WebPages(std::filesystem::path data) : data_(std::move(data)) {}

  /** @param path  "/metrics". */
  void add_page(const std::string& path, Page page) { pages_[path] = std::move(page); }

  PageResponse respond(const PageRequest& request);

 private:
  /** A file in memory, with the time stamp and size of the version that was read. */
  struct File {
    std::filesystem::file_time_type changed;
    uintmax_t size = 0;
    /** ETag: changes with the content. */
    std::string tag;
    std::string type;
    std::shared_ptr<const std::string> bytes;
    /** Compressed bytes; null if they are not shorter. */
    std::shared_ptr<const std::string> zipped;
  };

  std::optional<std::filesystem::path> find_file(const std::string& path) const;
  const File* read(const std::filesystem::path& path);

  std::filesystem::path data_;
  std::map<std::string, Page> pages_;
  std::map<std::string, File> files_;
};

/** The path of a request target: without query and fragment, percent-decoded.
 * @return Nothing if it is not an absolute path, or could leave the served folder ("..", zero
 *   bytes, backslashes, hidden files). */
std::optional<std::string> clean_path(std::string_view target);

/** The MIME type for a file name. */
std::string mime_type(const std::filesystem::path& file);

}  // namespace nao::gateway
