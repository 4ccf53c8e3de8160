#include "phone-gateway/server/http/web_pages.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "test/support/temporary_folder.h"

namespace nao::gateway {
namespace {

namespace fs = std::filesystem;

std::string gunzip(const std::string& zipped) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  std::string bytes(1 << 20, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zipped.data()));
  stream.avail_in = static_cast<uInt>(zipped.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  inflateEnd(&stream);
  return bytes;
}

class WebPagesTest : public testing::Test {
 protected:
  WebPagesTest() {
    write("web/index.html", "<p>app</p>" + std::string(1000, ' '));
    write("web/assets/app-1234.js", "let a = 1;" + std::string(1000, ' '));
    write("web/icon.png", "png");
    write("web/.hidden", "secret");
    write("robots/nao/nao.urdf", "<robot/>" + std::string(1000, ' '));
    write("scenes/soccer.yaml", "field: 1");
    write("secret.txt", "secret");
    pages_ = std::make_unique<WebPages>(folder_.path() / "");
  }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_.path() / name).parent_path());
    write_text(folder_.path() / name, text);
  }

  PageResponse get(const std::string& target) {
    return pages_->respond({"GET", target, "", "", false});
  }

  static std::string header(const PageResponse& response, const std::string& name) {
    for (const auto& [key, value] : response.headers) {
      if (key == name) return value;
    }
    return "";
  }

  const TemporaryFolder folder_;
  std::unique_ptr<WebPages> pages_;
};

TEST_F(WebPagesTest, ServesTheAppAndTheRobotsFilesWithTheirTypes) {
  EXPECT_EQ(get("/").status, 200);
  EXPECT_EQ(get("/").body->substr(0, 10), "<p>app</p>");
  EXPECT_EQ(header(get("/"), "Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(get("/?x=1#y").status, 200);
  EXPECT_EQ(header(get("/robots/nao/nao.urdf"), "Content-Type"), "application/xml");
  EXPECT_EQ(get("/scenes/soccer.yaml").status, 200);
  EXPECT_EQ(get("/nothing").status, 404);
  EXPECT_EQ(get("/assets").status, 404) << "a folder";
}

TEST_F(WebPagesTest, ServesNoFileOutsideItsFolders) {
  for (const char* target :
       {"/../secret.txt", "/robots/../secret.txt", "/robots/nao/../../secret.txt",
        "/%2e%2e/secret.txt", "/robots/%2e%2e/secret.txt", "/..%2fsecret.txt",
        "/robots/..\\secret.txt", "/.hidden", "//../secret.txt", "/secret.txt",
        "/robots/nao/nao.urdf%00.png", "secret.txt", "", "*", "http://x/secret.txt", "/%", "/%4",
        "/%zz"}) {
    const PageResponse response = get(target);
    EXPECT_TRUE(response.status == 400 || response.status == 404)
        << target << " " << response.status;
    EXPECT_EQ(response.body->find("secret"), std::string::npos) << target;
  }
}

TEST_F(WebPagesTest, TreatsNoPathAsAbsolute) {
  const std::string file = (folder_.path() / "secret.txt").string();
  for (const std::string& target : {"/" + file, "//" + file, "/%2f" + file, "/robots/" + file,
                                    "/robots//" + file, "/.//" + file}) {
    const PageResponse response = get(target);
    EXPECT_TRUE(response.status == 400 || response.status == 404)
        << target << " " << response.status;
    EXPECT_EQ(response.body->find("secret"), std::string::npos) << target;
  }
}

TEST_F(WebPagesTest, CompressesForClientsThatAcceptGzip) {
  const PageResponse response =
      pages_->respond({"GET", "/robots/nao/nao.urdf", "br, gzip", "", false});
  EXPECT_EQ(header(response, "Content-Encoding"), "gzip");
  EXPECT_LT(response.body->size(), 200u);
  EXPECT_EQ(gunzip(*response.body), *get("/robots/nao/nao.urdf").body);
  EXPECT_EQ(header(get("/robots/nao/nao.urdf"), "Content-Encoding"), "");
  EXPECT_EQ(header(pages_->respond({"GET", "/", "gzip;q=0", "", false}), "Content-Encoding"), "");
  EXPECT_EQ(header(pages_->respond({"GET", "/icon.png", "gzip", "", false}), "Content-Encoding"),
            "");
}

TEST_F(WebPagesTest, LetsBrowsersCacheUnchangedFiles) {
  const std::string tag = header(get("/"), "ETag");
  EXPECT_EQ(pages_->respond({"GET", "/", "", tag, false}).status, 304);
  EXPECT_EQ(header(get("/"), "Cache-Control"), "no-cache");
  EXPECT_NE(header(get("/assets/app-1234.js"), "Cache-Control").find("immutable"),
            std::string::npos);
  write("web/index.html", "<p>new</p>");
  EXPECT_EQ(pages_->respond({"GET", "/", "", tag, false}).status, 200);
  EXPECT_EQ(*get("/").body, "<p>new</p>");
}

TEST_F(WebPagesTest, ServesLocalPagesToTheOwnHostOnly) {
  pages_->add_page("/metrics", {"text/plain", true, [] { return std::string("clients 1\n"); }});
  EXPECT_EQ(get("/metrics").status, 403);
  EXPECT_EQ(*pages_->respond({"GET", "/metrics", "", "", true}).body, "clients 1\n");
}

TEST_F(WebPagesTest, RefusesMethodsOtherThanGetAndHead) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "get"}) {
    EXPECT_EQ(pages_->respond({method, "/", "", "", true}).status, 405) << method;
  }
  EXPECT_EQ(pages_->respond({"HEAD", "/", "", "", false}).status, 200);
}

}  // namespace
}  // namespace nao::gateway
