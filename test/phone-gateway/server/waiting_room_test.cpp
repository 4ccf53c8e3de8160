#include "phone-gateway/server/waiting_room.h"

#include <gtest/gtest.h>

#include <vector>

namespace nao {
namespace {

TEST(WaitingRoom, ClosesTheOldestForOneTooMany) {
  WaitingRoom room(2);
  std::vector<int> closed;
  std::vector<WaitingRoom::Place> places(3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(room.enter(
                  "10.0.0.1",
                  [&, i] {
                    closed.push_back(i);
                    room.leave(places[i]);
                  },
                  places[i]),
              i == 2);
  }
  EXPECT_EQ(closed, std::vector<int>{0});
  EXPECT_EQ(room.size(), 2u);
}

TEST(WaitingRoom, ClosesAnotherForEachWhileTheFirstAreStillOnTheirWayOut) {
  WaitingRoom room(2);
  std::vector<int> closed;
  std::vector<WaitingRoom::Place> places(6);
  for (int i = 0; i < 6; ++i)
    room.enter(
        "10.0.0.1", [&closed, i] { closed.push_back(i); }, places[i]);
  EXPECT_EQ(closed, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(room.size(), 2u);
  for (const int i : {2, 0, 3, 1}) room.leave(places[i]);
  EXPECT_EQ(room.size(), 2u);
  room.leave(places[4]);
  EXPECT_EQ(room.size(), 1u);
}

TEST(WaitingRoom, LetsACrowdPushOutItsOwnOnly) {
  WaitingRoom room(3);
  std::vector<std::string> closed;
  const auto enter = [&](const std::string& address) {
    WaitingRoom::Place place;
    return room.enter(
        address, [&closed, address] { closed.push_back(address); }, place);
  };
  EXPECT_FALSE(enter("phone"));
  for (int i = 0; i < 10; ++i) enter("crowd");
  EXPECT_EQ(closed, std::vector<std::string>(8, "crowd"));
  EXPECT_TRUE(enter("another phone"));
  EXPECT_EQ(closed, std::vector<std::string>(9, "crowd"));
}

}  // namespace
}  // namespace nao
