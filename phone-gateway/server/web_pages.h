#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nao {

/** A web request, as far as the answer depends on it. */
struct WebQuestion {
  std::string method;
  /** Path and query: "/robots/nao/nao.urdf?x=1". */
  std::string target;
  std::string accept_encoding;
  std::string if_none_match;
  /** From the gateway's own host. */
  bool is_local = false;
};

/** Its answer. */
struct WebAnswer {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  /** Never null. Not to be sent to HEAD, but its length is. */
  std::shared_ptr<const std::string> body;
};

/** What the gateway serves over HTTP: the app, the robots' and scenes' files, and pages made on
 * demand. Knows no socket. */
class WebPages {
 public:
  /** A page made at each request. */
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

  WebAnswer answer(const WebQuestion& question);

 private:
  /** A file as it was when it was last read. */
  struct File {
    std::filesystem::file_time_type changed;
    uintmax_t size = 0;
    std::string tag;
    std::string type;
    std::shared_ptr<const std::string> bytes;
    /** Null where compressing gains nothing. */
    std::shared_ptr<const std::string> zipped;
  };

  std::optional<std::filesystem::path> find_file(const std::string& path) const;
  const File* read(const std::filesystem::path& path);

  std::filesystem::path data_;
  std::map<std::string, Page> pages_;
  std::map<std::string, File> files_;
};

/** The path of a target: query and fragment cut off, percent signs decoded.
 * @return nothing if it is no absolute path, or could lead out of a folder ("..", zero bytes,
 *   backslashes, hidden files). */
std::optional<std::string> clean_path(std::string_view target);

/** The MIME type for a file name. */
std::string mime_type(const std::filesystem::path& file);

}  // namespace nao
