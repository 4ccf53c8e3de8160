#include "phone-gateway/server/network/fair_queue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>

namespace nao::gateway {
namespace {

using Tasks = FairQueue<std::function<void()>>;

TEST(FairQueue, HandlesReadyEventsBetweenItsItems) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  boost::asio::io_context io;
  Tasks queue(io, std::chrono::microseconds(0), [](const auto& task) { task(); });
  boost::asio::posix::stream_descriptor reader(io, ends[0]);
  int num_done = 0;
  int num_done_before_reading = -1;
  reader.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                    [&](const boost::system::error_code&) { num_done_before_reading = num_done; });
  for (int i = 0; i < 32; ++i) {
    queue.add([&] {
      if (num_done++ > 0) return;
      EXPECT_EQ(write(ends[1], "x", 1), 1);
    });
  }
  io.run();
  EXPECT_EQ(num_done, 32);
  EXPECT_LE(num_done_before_reading, 2);
  close(ends[1]);
}

TEST(FairQueue, ServesAnItemThatAnItemAdds) {
  boost::asio::io_context io;
  Tasks queue(io, std::chrono::microseconds(0), [](const auto& task) { task(); });
  int num_done = 0;
  queue.add([&] {
    ++num_done;
    queue.add([&] { ++num_done; });
  });
  io.run();
  EXPECT_EQ(num_done, 2);
}

}  // namespace
}  // namespace nao::gateway
