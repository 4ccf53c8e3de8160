#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "daemons/head-camera/head_camera.h"

namespace nao {
class EventLoop;
}

namespace nao::camera {

/** Serves images to foreign programs by the protocol of the Webots LoLA controller of Bembelbots:
 * one TCP port for each camera, for each image a header of 16 bytes and the pixels.
 *
 * Header, integers little-endian: "wbimage" and 0; tick, uint16: LoLA cycles of 12 ms by robot
 * time; camera, uint8, from 0 in the order of the robot's description; bytes a pixel, uint8: 2;
 * width and height, uint16. Pixels: YUYV, rows from the top down. Nothing is read from clients.
 * Source: the controller's README. */
class WebotsImages {
 public:
  /** Listens on the loopback interface. @param cameras  Names. @param port  Port of the first
   * camera; the next ones follow. 0: free ports. @throws Error  if a port is in use. */
  WebotsImages(const std::vector<std::string>& cameras, uint16_t port);
  ~WebotsImages();
  WebotsImages(const WebotsImages&) = delete;
  WebotsImages& operator=(const WebotsImages&) = delete;

  /** Port of a camera, by its index. */
  uint16_t port(size_t camera) const { return servers_[camera].port; }

  /** Accepts clients that wait. Never blocks. @return Whether a client wants this camera's images.
   */
  bool has_clients(const std::string& camera);
  /** Sends an image to every client of its camera. A client that has not taken the last image gets
   * none; after 1 s of that its connection is closed. Waits at most 10 ms for each client.
   * @param frame  640x480. @param now  s, monotonic. */
  void send(const CameraFrame& frame, double now);

 private:
  struct Client {
    int descriptor;
    /** Bytes of message that were sent so far. */
    size_t num_sent;
    std::vector<uint8_t> message;
    /** When the last image was taken completely, s. */
    double last_time;
  };
  struct Server {
    std::string camera;
    int descriptor;
    uint16_t port;
    std::deque<Client> clients;
  };

  Server* find(const std::string& camera);
  /** @return False if the client has gone. */
  static bool continue_sending(Client& client, double now, int wait_ms);

  std::vector<Server> servers_;
  std::vector<uint8_t> message_;
};

}  // namespace nao::camera
