// A client of the Webots controller's image protocol, written from its description.

#include "daemons/head-camera/webots_images.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "common/error.h"

namespace nao::camera {
namespace {

class ImageClient {
 public:
  explicit ImageClient(uint16_t port) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~ImageClient() { close(descriptor_); }

  std::vector<uint8_t> read(size_t count) {
    std::vector<uint8_t> bytes(count);
    EXPECT_EQ(recv(descriptor_, bytes.data(), count, MSG_WAITALL), static_cast<ssize_t>(count));
    return bytes;
  }

 private:
  int descriptor_;
};

CameraFrame gray_frame(const std::string& camera, uint8_t upper, uint8_t lower) {
  CameraFrame frame;
  frame.camera = camera;
  frame.utime = int64_t{12000} * 70000;
  frame.bgrx[0].assign(size_t{4} * 640 * 480, lower);
  // Rows from the bottom up.
  std::fill(frame.bgrx[0].begin() + 4 * 640 * 240, frame.bgrx[0].end(), upper);
  return frame;
}

TEST(WebotsImages, SendsHeaderAndPixels) {
  WebotsImages images({"top", "bottom"}, 0);
  EXPECT_FALSE(images.has_clients("top"));
  ImageClient client(images.port(1));
  while (!images.has_clients("bottom")) std::this_thread::yield();
  EXPECT_FALSE(images.has_clients("top"));
  std::vector<uint8_t> header;
  std::vector<uint8_t> pixels;
  std::thread reader([&] {
    header = client.read(16);
    pixels = client.read(2 * 640 * 480);
  });
  const CameraFrame frame = gray_frame("bottom", 200, 50);
  // What does not fit into the socket's memory follows with the next calls.
  double now = 0;
  images.send(frame, now);
  images.send(gray_frame("top", 0, 0), now);
  for (int i = 0; i < 20; ++i) images.send(frame, now += 0.03);
  reader.join();
  // 70000 cycles, in 16 bits: 4464 = 0x1170.
  const std::vector<uint8_t> expected{'w',  'b',  'i', 'm', 'a',  'g',  'e',  0,
                                      0x70, 0x11, 1,   2,   0x80, 0x02, 0xe0, 0x01};
  EXPECT_EQ(header, expected);
  EXPECT_EQ(pixels[0], 200);
  EXPECT_EQ(pixels[1], 128);
  EXPECT_EQ(pixels[2 * 640 * 480 - 2], 50);
}

TEST(WebotsImages, ClosesAClientThatDoesNotRead) {
  WebotsImages images({"top"}, 0);
  const ImageClient client(images.port(0));
  while (!images.has_clients("top")) std::this_thread::yield();
  const CameraFrame frame = gray_frame("top", 1, 2);
  for (double now = 0; now < 3; now += 0.1) images.send(frame, now);
  EXPECT_FALSE(images.has_clients("top"));
}

TEST(WebotsImages, ReportsAPortInUse) {
  WebotsImages images({"top"}, 0);
  EXPECT_THROW(WebotsImages({"top"}, images.port(0)), Error);
}

}  // namespace
}  // namespace nao::camera
