// Sockets of the loopback interface; the robot is a fake on a bus inside the process.
#include "test/phone-gateway/server/network/live_gateway.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <random>

#include "phone-gateway/clients/cpp/phone_client.h"

namespace nao::gateway {
namespace {

using naoremote::Notice;

/** s. Long, since the machine may be busy; nothing here measures time. */
constexpr double kDeadline = 30;

class LiveGatewayTest : public testing::Test {
 protected:
  PhoneClient::Options phone_options(const std::string& name) const {
    PhoneClient::Options options;
    options.port = gateway_.tcp_port();
    options.name = name;
    options.timeout = kDeadline;
    return options;
  }

  /** Waits for a condition that the gateway's thread fulfils. */
  template <class Condition>
  static bool wait_until(Condition condition) {
    const double deadline = monotonic_seconds() + kDeadline;
    while (!condition()) {
      if (monotonic_seconds() > deadline) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }

  /** Sends bytes to a port and returns everything received until the gateway closes. */
  static std::string exchange(uint16_t port, const std::string& bytes) {
    MessageSocket socket("127.0.0.1", port, kDeadline);
    std::string answer;
    try {
      socket.send_raw(bytes);
      const double deadline = monotonic_seconds() + kDeadline;
      while (monotonic_seconds() < deadline) {
        char part[4096];
        const ssize_t size = recv(socket.descriptor(), part, sizeof part, 0);
        if (size > 0) answer.append(part, static_cast<size_t>(size));
        if (size == 0 || (size < 0 && errno != EAGAIN)) break;
        if (size < 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    } catch (const ConnectionError&) {
      // The gateway has closed the connection before all bytes were sent.
    }
    return answer;
  }

  std::string http(const std::string& request_line, const std::string& headers = "") const {
    return exchange(
        gateway_.http_port(),
        request_line + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + headers + "\r\n");
  }

  LiveGateway gateway_;
};

TEST_F(LiveGatewayTest, SendsTheRobotToAPostureAndReportsTheResult) {
  PhoneClient phone(phone_options("Ana"));
  EXPECT_EQ(phone.robot().name(), "NAO");
  ASSERT_EQ(phone.take_control().error(), naoremote::OK);
  const auto response = phone.go_to_posture("Crouch");
  ASSERT_EQ(response.error(), naoremote::OK) << response.message();
  const auto result = phone.wait_for_result(response.request_id(), kDeadline);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->status(), Notice::DONE);
  EXPECT_TRUE(phone.run_until(
      [&] { return phone.get_state(false).state_and_image().state().posture() == "Crouch"; },
      kDeadline));
}

TEST_F(LiveGatewayTest, StreamsStatesAndImages) {
  int num_states = 0;
  int num_images = 0;
  PhoneClient::Handlers handlers;
  handlers.on_state = [&](const naoremote::State& state) {
    ++num_states;
    EXPECT_EQ(state.joint_position_size(), 4);
  };
  handlers.on_image = [&](const naoremote::Image& image) {
    ++num_images;
    EXPECT_EQ(image.jpeg().size(), 7000u);
  };
  PhoneClient phone(phone_options("Ana"), handlers);
  ASSERT_EQ(phone.subscribe(30, 15).error(), naoremote::OK);
  EXPECT_TRUE(phone.run_until([&] { return num_states >= 20 && num_images >= 10; }, kDeadline));
}

TEST_F(LiveGatewayTest, TurnsAJointAndReportsItsAngle) {
  PhoneClient phone(phone_options("Ana"));
  phone.take_control();
  ASSERT_EQ(phone.change_joints("head", 0.25, 0, 0).error(), naoremote::OK);
  EXPECT_TRUE(phone.run_until(
      [&] {
        const auto state = phone.get_state(false).state_and_image().state();
        return std::abs(state.joint_position(0) - 0.25f) < 1e-6f;
      },
      kDeadline));
}

TEST_F(LiveGatewayTest, EndsTheWalkOfADriverWhoseConnectionBreaks) {
  {
    PhoneClient phone(phone_options("Ana"));
    phone.take_control();
    ASSERT_EQ(phone.walk_turn(0.15, 0, 0).error(), naoremote::OK);
    ASSERT_TRUE(wait_until([&] { return !gateway_.motion().walks().empty(); }));
    EXPECT_EQ(gateway_.motion().walks().back().vx, 0.15);
  }
  EXPECT_TRUE(wait_until([&] { return gateway_.motion().walks().back().vx == 0; }));
}

TEST_F(LiveGatewayTest, ReportsThatMotionIsUnavailableAndAvailableAgain) {
  std::vector<Notice> notices;
  PhoneClient::Handlers handlers;
  handlers.on_notice = [&](const Notice& notice) {
    if (notice.kind() == Notice::COMPONENT_CHANGED && notice.component() == Notice::MOTION) {
      notices.push_back(notice);
    }
  };
  PhoneClient phone(phone_options("Ana"), handlers);
  phone.take_control();
  gateway_.motion().is_silent = true;
  ASSERT_TRUE(phone.run_until([&] { return !notices.empty(); }, kDeadline));
  EXPECT_FALSE(notices.back().is_available());
  EXPECT_EQ(phone.go_to_posture("Crouch").error(), naoremote::ROBOT_UNAVAILABLE);
  gateway_.motion().is_silent = false;
  ASSERT_TRUE(phone.run_until([&] { return notices.size() == 2; }, kDeadline));
  EXPECT_TRUE(notices.back().is_available());
  EXPECT_EQ(phone.go_to_posture("Crouch").error(), naoremote::OK);
}

TEST_F(LiveGatewayTest, AcceptsMessagesOfUpTo64KB) {
  MessageSocket socket("127.0.0.1", gateway_.tcp_port(), kDeadline);
  socket.send(std::string(kMaxRequestBytes, '\xff'));
  const auto answer = socket.receive(kDeadline);
  ASSERT_TRUE(answer.has_value());
  naoremote::ServerMessage message;
  ASSERT_TRUE(message.ParseFromString(*answer));
  EXPECT_EQ(message.response().error(), naoremote::INVALID_REQUEST);
  socket.send_raw(std::string("\x00\x01\x00\x01", 4));
  const auto goodbye = socket.receive(kDeadline);
  ASSERT_TRUE(goodbye.has_value());
  ASSERT_TRUE(message.ParseFromString(*goodbye));
  EXPECT_EQ(message.notice().kind(), Notice::CLOSING);
  EXPECT_THROW((void)socket.receive(kDeadline), ConnectionError);
}

TEST_F(LiveGatewayTest, ClosesAConnectionWithoutConnect) {
  MessageSocket silent("127.0.0.1", gateway_.tcp_port(), kDeadline);
  MessageSocket half("127.0.0.1", gateway_.tcp_port(), kDeadline);
  half.send_raw(std::string("\0\0\0\x10half", 8));
  for (MessageSocket* socket : {&silent, &half}) {
    EXPECT_TRUE(socket->receive(kDeadline).has_value()) << "the reason";
    EXPECT_THROW((void)socket->receive(kDeadline), ConnectionError);
  }
  EXPECT_TRUE(wait_until([&] { return gateway_.num_sessions() == 0; }));
}

TEST_F(LiveGatewayTest, ServesClientsInSpiteOfRandomBytes) {
  PhoneClient good(phone_options("good"));
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    std::string bytes(1 + random() % 3000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const uint16_t port = i % 2 == 0 ? gateway_.tcp_port() : gateway_.http_port();
    MessageSocket socket("127.0.0.1", port, kDeadline);
    try {
      socket.send_raw(bytes);
    } catch (const ConnectionError&) {
      // It has been thrown out already.
    }
    if (i % 20 == 0) {
      ASSERT_EQ(good.ping().error(), naoremote::OK);
    }
  }
  EXPECT_EQ(good.ping().error(), naoremote::OK);
  EXPECT_TRUE(wait_until([&] { return gateway_.num_sessions() == 1; }));
}

TEST_F(LiveGatewayTest, ServesClientsInSpiteOfAFloodAndAStalledReader) {
  // Neither of the two reads; one sends requests without end, the other subscribes to everything.
  MessageSocket flood("127.0.0.1", gateway_.tcp_port(), kDeadline);
  MessageSocket stalled("127.0.0.1", gateway_.tcp_port(), kDeadline);
  naoremote::Request request;
  request.mutable_connect()->set_protocol_version(1);
  flood.send(request.SerializeAsString());
  stalled.send(request.SerializeAsString());
  request.mutable_subscribe()->set_state_rate(60);
  request.mutable_subscribe()->set_image_rate(30);
  stalled.send(request.SerializeAsString());
  request.mutable_ping();
  std::string many;
  for (int i = 0; i < 500; ++i) many += frame(request.SerializeAsString());

  int num_states = 0;
  PhoneClient::Handlers handlers;
  handlers.on_state = [&](const naoremote::State&) { ++num_states; };
  PhoneClient good(phone_options("good"), handlers);
  ASSERT_EQ(good.subscribe(30, 15).error(), naoremote::OK);
  for (int round = 0; round < 20; ++round) {
    (void)::send(flood.descriptor(), many.data(), many.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    const int num_before = num_states;
    ASSERT_TRUE(good.run_until([&] { return num_states >= num_before + 3; }, kDeadline));
    EXPECT_EQ(good.ping().error(), naoremote::OK);
  }
}

TEST_F(LiveGatewayTest, AcceptsClientsInSpiteOfManyHalfOpenConnections) {
  std::vector<std::unique_ptr<MessageSocket>> half_open;
  for (int i = 0; i < 400; ++i) {
    const uint16_t port = i % 2 == 0 ? gateway_.tcp_port() : gateway_.http_port();
    half_open.push_back(std::make_unique<MessageSocket>("127.0.0.1", port, kDeadline));
    if (i % 100 == 50) {
      PhoneClient good(phone_options("good"));
      EXPECT_EQ(good.ping().error(), naoremote::OK);
    }
  }
  PhoneClient good(phone_options("good"));
  EXPECT_EQ(good.ping().error(), naoremote::OK);
  EXPECT_LE(gateway_.num_sessions(), 130);
}

TEST_F(LiveGatewayTest, ServesPagesAndRefusesOtherRequests) {
  EXPECT_NE(http("GET /").find("<p>app</p>"), std::string::npos);
  EXPECT_NE(http("GET /metrics").find("nao_gateway_clients 0"), std::string::npos);
  EXPECT_NE(http("GET /../secret").find(" 400 "), std::string::npos);
  EXPECT_NE(http("POST /", "Content-Length: 0\r\n").find(" 405 "), std::string::npos);
  EXPECT_NE(http("GET /ws").find(" 426 "), std::string::npos);
  EXPECT_NE(http("GET /", "X: " + std::string(10000, 'x') + "\r\n").find(" 431 "),
            std::string::npos);
  const std::string head = http("HEAD /");
  EXPECT_NE(head.find("Content-Length: 10"), std::string::npos);
  EXPECT_EQ(head.find("<p>"), std::string::npos);
}

TEST_F(LiveGatewayTest, PublishesMetricsOfEachClient) {
  PhoneClient phone(phone_options("Ana"));
  phone.ping();
  const std::string metrics = http("GET /metrics");
  const std::string label = "{client=\"" + std::to_string(phone.connected().client_id()) + "\"";
  for (const char* name : {"requests_total", "messages_sent_total", "frames_skipped_total",
                           "messages_waiting", "round_trip_seconds"}) {
    const std::string line = std::string("nao_gateway_client_") + name + label;
    EXPECT_NE(metrics.find(line), std::string::npos) << line << " is not in\n" << metrics;
  }
}

TEST_F(LiveGatewayTest, RefusesOtherHostsAndOrigins) {
  const std::string rebound = exchange(
      gateway_.http_port(), "GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n");
  EXPECT_NE(rebound.find(" 421 "), std::string::npos);
  EXPECT_EQ(rebound.find("app"), std::string::npos);
  const std::string websocket =
      "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const std::string foreign =
      exchange(gateway_.http_port(),
               "GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade, close\r\n"
               "Origin: http://evil.example\r\n" +
                   websocket + "\r\n");
  EXPECT_NE(foreign.find(" 403 "), std::string::npos);
}

TEST_F(LiveGatewayTest, ExecutesTheOperatorsRequests) {
  PhoneClient phone(phone_options("Ana"));
  phone.take_control();
  const auto list = operate("127.0.0.1", gateway_.tcp_port(), naoremote::Operate::LIST);
  ASSERT_EQ(list.clients().clients_size(), 1);
  EXPECT_TRUE(list.clients().clients(0).is_driver());
  EXPECT_EQ(operate("127.0.0.1", gateway_.tcp_port(), naoremote::Operate::TAKE).error(),
            naoremote::OK);
  EXPECT_EQ(phone.go_to_posture("Crouch").error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(operate("127.0.0.1", gateway_.tcp_port(), naoremote::Operate::KICK,
                    phone.connected().client_id())
                .error(),
            naoremote::OK);
  EXPECT_THROW(phone.run_for(kDeadline), ConnectionError);
}

/** Frames of a WebSocket (RFC 6455, 5.2) of a client that reads slowly. */
class SlowWebSocket {
 public:
  struct Frame {
    int opcode = 0;
    std::string payload;
  };

  explicit SlowWebSocket(uint16_t port) : socket_("127.0.0.1", port, kDeadline) {
    constexpr int kFewBytes = 4096;
    setsockopt(socket_.descriptor(), SOL_SOCKET, SO_RCVBUF, &kFewBytes, sizeof kFewBytes);
    socket_.send_raw(
        "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
    while (received_.find("\r\n\r\n") == std::string::npos) receive();
    received_.erase(0, received_.find("\r\n\r\n") + 4);
  }

  /** @param payload  Below 126 bytes. */
  void send(int opcode, const std::string& payload) {
    const std::string no_mask(4, '\0');
    socket_.send_raw(
        std::string{static_cast<char>(0x80 | opcode), static_cast<char>(0x80 | payload.size())} +
        no_mask + payload);
  }

  Frame next() {
    take_in(2);
    const int opcode = static_cast<uint8_t>(received_[0]) & 0x0f;
    size_t size = static_cast<uint8_t>(received_[1]);
    const size_t num_size_bytes = size < 126 ? 0 : size == 126 ? 2 : 8;
    take_in(2 + num_size_bytes);
    if (num_size_bytes > 0) size = 0;
    for (size_t i = 0; i < num_size_bytes; ++i) {
      size = size << 8 | static_cast<uint8_t>(received_[2 + i]);
    }
    const size_t begin = 2 + num_size_bytes;
    take_in(begin + size);
    Frame frame{opcode, received_.substr(begin, size)};
    received_.erase(0, begin + size);
    return frame;
  }

 private:
  void take_in(size_t num_bytes) {
    while (received_.size() < num_bytes) receive();
  }
  void receive() {
    pollfd polled{socket_.descriptor(), POLLIN, 0};
    if (poll(&polled, 1, static_cast<int>(kDeadline * 1e3)) != 1) throw Error("nothing comes");
    char part[1024];
    const ssize_t size = recv(socket_.descriptor(), part, sizeof part, 0);
    if (size <= 0) throw Error("the gateway has closed the connection");
    received_.append(part, static_cast<size_t>(size));
  }

  MessageSocket socket_;
  std::string received_;
};

// The images do not fit into the socket: their rest waits while the answers to pings are written.
TEST(LiveGateway, SendsWholeFramesToASlowWebSocket) {
  constexpr int kBinary = 2;
  constexpr int kPing = 9;
  constexpr int kPong = 10;
  LiveGateway::Options options;
  options.image_bytes = 200000;
  options.limits.silence_timeout = kDeadline;
  LiveGateway gateway(options);
  SlowWebSocket client(gateway.http_port());
  naoremote::Request request;
  request.mutable_connect()->set_protocol_version(1);
  client.send(kBinary, request.SerializeAsString());
  request.mutable_subscribe()->set_state_rate(60);
  request.mutable_subscribe()->set_image_rate(30);
  client.send(kBinary, request.SerializeAsString());
  int num_images = 0;
  for (int ping = 0; num_images < 3; ++ping) {
    client.send(kPing, std::to_string(ping));
    while (true) {
      const SlowWebSocket::Frame frame = client.next();
      if (frame.opcode == kPong) {
        EXPECT_EQ(frame.payload, std::to_string(ping));
        break;
      }
      ASSERT_EQ(frame.opcode, kBinary);
      naoremote::ServerMessage message;
      ASSERT_TRUE(message.ParseFromString(frame.payload));
      num_images += message.has_image() ? 1 : 0;
    }
  }
}

TEST(LiveGateway, NamesThePortThatIsInUse) {
  LiveGateway gateway;
  GatewayCore core({{make_test_robot(), {}}}, GatewayLimits{}, {}, {});
  WebPages pages("/");
  NetworkOptions options;
  options.bind = "127.0.0.1";
  options.http_port = gateway.http_port();
  options.tcp_port = 0;
  try {
    const Network network(options, AccessRules({}, {}), core, pages);
    FAIL() << "two gateways listen on one port";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(std::to_string(gateway.http_port())), std::string::npos) << text;
    EXPECT_NE(text.find("--http-port"), std::string::npos) << text;
  }
}

// The announcement is renewed during the drain, too, and names the port.
TEST(NetworkTest, KnowsItsPortsUntilItsEnd) {
  Bus bus("memq://");
  GatewayDaemon daemon(bus, {make_test_robot()}, GatewayLimits(), "secret");
  const TemporaryFolder data;
  WebPages pages(data.path());
  NetworkOptions options;
  options.bind = "127.0.0.1";
  options.http_port = 0;
  options.tcp_port = 0;
  Network network(options, AccessRules({}, {}), daemon.core(), pages);
  const uint16_t http_port = network.http_port();
  const uint16_t tcp_port = network.tcp_port();
  network.drain(0);
  EXPECT_EQ(network.http_port(), http_port);
  EXPECT_EQ(network.tcp_port(), tcp_port);
}

}  // namespace
}  // namespace nao::gateway
