#include "phone-gateway/server/exhibition/visitor_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "common/error.h"
#include "phone-gateway/server/exhibition/queue_file.h"

namespace nao::gateway {
namespace {

using Phase = VisitorView::Phase;

class VisitorQueueTest : public testing::Test {
 protected:
  void pass(double time) {
    for (double t = 0; t < time - 1e-9; t += 0.1) queue_.step(0.1);
  }
  /** Time in which the driver does something each second. */
  void drive(double time) {
    for (double t = 0; t < time - 1e-9; t += 1) {
      queue_.note_command();
      pass(1);
    }
  }
  Phase phase(const std::string& key) const { return queue_.view(key).phase; }

  VisitorQueue queue_{TurnRules{}, {"Vega", "Rigel"}};
};

TEST_F(VisitorQueueTest, GivesTurnsInTheOrderOfArrival) {
  for (const char* key : {"a", "b", "c"}) EXPECT_TRUE(queue_.attend(key, false));
  pass(0.1);
  EXPECT_EQ(phase("a"), Phase::kDriving);
  EXPECT_EQ(queue_.view("a").nickname, "Vega");
  EXPECT_EQ(queue_.view("b").place, 1u);
  EXPECT_NEAR(queue_.view("c").wait, 2 * 95, 0.2);
  EXPECT_EQ(queue_.view("c").nickname, "Vega 2") << "the list begins again";
  drive(91);
  EXPECT_EQ(phase("a"), Phase::kServed);
  EXPECT_EQ(queue_.driver(), nullptr) << "between two turns";
  drive(5);
  EXPECT_EQ(phase("b"), Phase::kDriving);
}

TEST_F(VisitorQueueTest, WarnsInTheLastPartOfATurn) {
  queue_.attend("a", false);
  pass(0.1);
  drive(79);
  EXPECT_FALSE(queue_.is_warned());
  drive(2);
  EXPECT_TRUE(queue_.is_warned());
}

TEST_F(VisitorQueueTest, PassesTheTurnOfOneThatLeavesOrDoesNothing) {
  for (const char* key : {"a", "b", "c"}) queue_.attend(key, false);
  pass(0.1);
  queue_.leave("a");
  pass(5.2);
  EXPECT_EQ(phase("b"), Phase::kDriving);
  pass(15.1);
  EXPECT_EQ(phase("b"), Phase::kServed);
  pass(5.2);
  EXPECT_EQ(phase("c"), Phase::kDriving);
  EXPECT_EQ(queue_.state().counts.left, 1);
  EXPECT_EQ(queue_.state().counts.idle, 1);
}

TEST_F(VisitorQueueTest, GivesOnePlaceToAPhoneThatScansTwice) {
  for (const char* key : {"a", "b", "b", "a", "b"}) queue_.attend(key, false);
  EXPECT_EQ(queue_.state().waiting.size(), 2u);
  pass(0.1);
  queue_.attend("a", true);
  EXPECT_EQ(queue_.state().waiting.size(), 1u) << "the driver does not wait as well";
}

TEST_F(VisitorQueueTest, GivesAnotherTurnOnlyToOneThatAsksForIt) {
  queue_.attend("a", false);
  pass(0.1);
  queue_.leave("a");
  queue_.attend("a", false);
  EXPECT_EQ(phase("a"), Phase::kServed);
  queue_.attend("a", true);
  EXPECT_EQ(phase("a"), Phase::kWaiting);
  EXPECT_EQ(queue_.view("a").nickname, "Vega");
}

TEST_F(VisitorQueueTest, KeepsThePlaceOfADeadPhoneForAWhile) {
  for (const char* key : {"a", "b", "c", "d"}) queue_.attend(key, false);
  pass(0.1);
  queue_.lose("b");
  pass(11);
  EXPECT_EQ(queue_.view("c").place, 1u) << "b is passed over";
  queue_.leave("a");
  pass(5.2);
  EXPECT_EQ(phase("c"), Phase::kDriving);
  queue_.attend("b", false);
  EXPECT_EQ(queue_.view("b").place, 1u);
  queue_.lose("b");
  drive(89);
  pass(32);
  EXPECT_EQ(phase("b"), Phase::kNone) << "too long";
}

TEST_F(VisitorQueueTest, WaitsForAPhoneThatIsGoneForSecondsOnly) {
  for (const char* key : {"a", "b"}) queue_.attend(key, false);
  queue_.lose("a");
  pass(9);
  EXPECT_EQ(queue_.driver(), nullptr);
  queue_.attend("a", false);
  pass(0.1);
  EXPECT_EQ(phase("a"), Phase::kDriving);
}

TEST_F(VisitorQueueTest, StopsTheClockWhilePaused) {
  queue_.attend("a", false);
  pass(0.1);
  drive(10);
  queue_.set_paused(true);
  EXPECT_EQ(queue_.driver(), nullptr);
  pass(1000);
  queue_.set_paused(false);
  ASSERT_NE(queue_.driver(), nullptr);
  EXPECT_NEAR(queue_.state().turn_left, 80, 0.2);
  queue_.extend(30);
  EXPECT_NEAR(queue_.state().turn_left, 110, 0.2);
  queue_.skip();
  EXPECT_EQ(phase("a"), Phase::kServed);
}

TEST_F(VisitorQueueTest, LetsADriverThatARestCutShortBeTheNext) {
  for (const char* key : {"a", "b"}) queue_.attend(key, false);
  pass(0.1);
  drive(10);
  queue_.set_resting(true);
  EXPECT_EQ(queue_.view("a").place, 1u);
  pass(100);
  EXPECT_EQ(queue_.driver(), nullptr);
  queue_.set_resting(false);
  pass(5.2);
  EXPECT_EQ(phase("a"), Phase::kDriving);
  drive(60);
  queue_.set_resting(true);
  EXPECT_EQ(phase("a"), Phase::kServed) << "most of the turn was driven";
}

TEST_F(VisitorQueueTest, RemembersTheBestTime) {
  for (const char* key : {"a", "b"}) queue_.attend(key, false);
  queue_.note_challenge();
  EXPECT_EQ(queue_.state().best_time, 0) << "nobody drives";
  pass(0.1);
  drive(20);
  queue_.note_challenge();
  drive(10);
  queue_.note_challenge();
  EXPECT_NEAR(queue_.state().challenge_time, 20, 0.2) << "the first time counts";
  queue_.leave("a");
  pass(5.2);
  drive(30);
  queue_.note_challenge();
  EXPECT_NEAR(queue_.state().challenge_time, 30, 0.3);
  EXPECT_NEAR(queue_.state().best_time, 20, 0.2);
  EXPECT_EQ(queue_.state().best_nickname, "Vega");
}

/** How a simulated visitor behaves. */
enum class Habit { kDrives, kLeavesQueue, kLeavesTurn, kIdles, kPhoneDies, kPhoneDiesForGood };

struct SimulatedVisitor {
  Habit habit = Habit::kDrives;
  double arrival = 0;
  /** When the phone dies, and is back, or the visitor leaves, s after arrival. */
  double event = 0;
  double back = 0;
  bool is_here = false;
  bool has_left = false;
  int turns = 0;
  double turn_begin = -1;
  /** What was told, and when, since the last event that nobody can foresee. */
  std::vector<std::pair<double, double>> told;
  /** The same since its arrival. */
  std::vector<std::pair<double, double>> all_told;
};

// 200 visitors in eight hours, which arrive in groups, with every habit; the gateway restarts each
// half hour from the file; the operator pauses and skips.
TEST(ExhibitionDay, LosesAndServesNobodyTwiceAndTellsTheWaitingTime) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::map<std::string, SimulatedVisitor> visitors;
    for (int i = 0; i < 200; ++i) {
      SimulatedVisitor visitor;
      const int dice = static_cast<int>(uniform(0, 100));
      visitor.habit = dice < 60   ? Habit::kDrives
                      : dice < 68 ? Habit::kLeavesQueue
                      : dice < 76 ? Habit::kLeavesTurn
                      : dice < 84 ? Habit::kIdles
                      : dice < 94 ? Habit::kPhoneDies
                                  : Habit::kPhoneDiesForGood;
      // Groups of about ten.
      visitor.arrival = std::floor(uniform(0, 20)) * 1300 + uniform(0, 120);
      visitor.event = visitor.arrival + uniform(5, 300);
      visitor.back = visitor.event + uniform(1, 100);
      visitors["key-" + std::to_string(i)] = visitor;
    }
    auto queue = std::make_unique<VisitorQueue>(TurnRules{}, std::vector<std::string>{"Vega"});
    std::vector<double> errors;
    std::vector<double> all_errors;
    std::string driver;
    double restart = 1800;
    double pause_end = -1;
    std::ptrdiff_t last_absent = 0;
    const double step = 0.5;
    for (double now = 0; now < 8 * 3600; now += step) {
      bool is_unforeseen = false;
      if (now >= restart) {
        restart += 1800;
        queue = std::make_unique<VisitorQueue>(TurnRules{}, std::vector<std::string>{"Vega"},
                                               read_queue_state(write_queue_state(queue->state())));
        // Phones come back within seconds, in any order.
        for (auto& [key, visitor] : visitors) {
          if (visitor.is_here && !visitor.has_left) visitor.is_here = false;
        }
        is_unforeseen = true;
      }
      if (std::fmod(now, 5000) == 4000) {
        queue->set_paused(true);
        pause_end = now + 60;
      }
      if (now == pause_end) {
        queue->set_paused(false);
        is_unforeseen = true;
      }
      if (std::fmod(now, 7000) == 6000 && queue->driver() != nullptr) {
        queue->skip();
        is_unforeseen = true;
      }
      for (auto& [key, visitor] : visitors) {
        if (now < visitor.arrival || visitor.has_left) continue;
        if (visitor.turn_begin >= 0 && key != driver) continue;
        const bool is_dead =
            (visitor.habit == Habit::kPhoneDiesForGood && now >= visitor.event) ||
            (visitor.habit == Habit::kPhoneDies && now >= visitor.event && now < visitor.back);
        const bool has_place = queue->view(key).phase != Phase::kNone;
        if (is_dead && visitor.is_here) {
          queue->lose(key);
          visitor.is_here = false;
          is_unforeseen = true;
        } else if (!is_dead && !visitor.is_here && (!has_place || uniform(0, 3) < step)) {
          ASSERT_TRUE(queue->attend(key, false));
          // Scans twice.
          if (uniform(0, 1) < 0.2) {
            ASSERT_TRUE(queue->attend(key, false));
          }
          visitor.is_here = true;
          is_unforeseen = is_unforeseen || has_place;
        }
        const bool leaves_queue = visitor.habit == Habit::kLeavesQueue && now >= visitor.event;
        const bool leaves_turn = visitor.habit == Habit::kLeavesTurn && visitor.turn_begin >= 0 &&
                                 now - visitor.turn_begin > 30;
        if (leaves_queue || leaves_turn) {
          queue->leave(key);
          visitor.has_left = true;
          is_unforeseen = true;
        }
      }
      const Visitor* before = queue->driver();
      if (before != nullptr && visitors[before->key].is_here &&
          visitors[before->key].habit != Habit::kIdles) {
        queue->note_command();
      }
      const int num_idle = queue->state().counts.idle;
      const int num_gone = queue->state().counts.gone;
      queue->step(step);
      if (queue->state().counts.idle != num_idle) is_unforeseen = true;
      if (queue->state().counts.gone != num_gone) is_unforeseen = true;
      // A phone that does not come back soon is no longer expected.
      const auto num_absent =
          std::count_if(queue->state().waiting.begin(), queue->state().waiting.end(),
                        [](const Visitor& visitor) { return visitor.absence >= 10; });
      if (std::exchange(last_absent, num_absent) != num_absent) is_unforeseen = true;
      const std::string next = queue->driver() == nullptr ? "" : queue->driver()->key;
      if (next != driver && !next.empty() && visitors[next].turn_begin < 0) {
        SimulatedVisitor& visitor = visitors[next];
        ++visitor.turns;
        visitor.turn_begin = now;
        for (const auto& [when, wait] : visitor.told) {
          errors.push_back(std::abs(when + wait - now));
        }
        for (const auto& [when, wait] : visitor.all_told) {
          all_errors.push_back(std::abs(when + wait - now));
        }
      } else if (next != driver && !next.empty()) {
        EXPECT_FALSE(queue->state().driver->nickname.empty());
        if (driver != "") ++visitors[next].turns;
      }
      driver = next;
      if (is_unforeseen || queue->is_halted()) {
        for (auto& [key, visitor] : visitors) visitor.told.clear();
      }
      if (queue->is_halted() || std::fmod(now, 5) != 0) continue;
      for (auto& [key, visitor] : visitors) {
        if (!visitor.is_here || visitor.turn_begin >= 0 || visitor.has_left) continue;
        const VisitorView view = queue->view(key);
        if (view.phase != Phase::kWaiting) continue;
        visitor.told.emplace_back(now, view.wait);
        visitor.all_told.emplace_back(now, view.wait);
      }
    }
    int num_served = 0;
    for (const auto& [key, visitor] : visitors) {
      EXPECT_LE(visitor.turns, 1) << key << " was served twice";
      num_served += visitor.turns;
      const bool is_gone =
          visitor.habit == Habit::kLeavesQueue || visitor.habit == Habit::kPhoneDiesForGood;
      EXPECT_TRUE(is_gone || visitor.turns == 1) << key << " was lost";
    }
    EXPECT_GT(num_served, 150);
    ASSERT_GT(errors.size(), 1000u);
    EXPECT_LE(*std::max_element(errors.begin(), errors.end()), 15.0);
    // With what nobody can foresee: for people who read the results.
    std::sort(all_errors.begin(), all_errors.end());
    const std::string name = "seed_" + std::to_string(seed);
    RecordProperty(name + "_p50", std::to_string(all_errors[all_errors.size() / 2]));
    RecordProperty(name + "_p95", std::to_string(all_errors[all_errors.size() * 95 / 100]));
    EXPECT_EQ(queue->state().counts.turns, num_served);
  }
}

TEST(QueueFile, KeepsEverything) {
  VisitorQueue queue(TurnRules{}, {"Vega", "Rigel"});
  for (const char* key : {"a", "b", "c"}) queue.attend(key, false);
  for (int i = 0; i < 100; ++i) queue.step(0.1);
  queue.note_challenge();
  queue.skip();
  for (int i = 0; i < 60; ++i) queue.step(0.1);
  queue.set_paused(true);
  queue.counts().falls = 3;
  const std::string text = write_queue_state(queue.state());
  EXPECT_EQ(write_queue_state(read_queue_state(text)), text);
  EXPECT_NE(write_exhibition_report(queue.state()).find("Best time: 9.9 s, Vega"),
            std::string::npos);
}

TEST(QueueFile, RefusesWhatItDoesNotWrite) {
  const std::string text = write_queue_state({});
  EXPECT_NO_THROW(read_queue_state(text));
  EXPECT_THROW(read_queue_state(text.substr(0, text.size() / 2)), Error);
  for (
      const auto& [good, bad] : std::map<std::string, std::string>{
          {"\"version\":1", "\"version\":2"},
          {"\"waiting\":[]", "\"waiting\":3"},
          {"\"waiting\":[]",
           R"("waiting":[{"key":"a","nickname":"","absence":0},{"key":"a","nickname":"","absence":0}])"},
          {"\"turn_left\":0", "\"turn_left\":-1"}}) {
    std::string changed = text;
    const size_t place = changed.find(good);
    ASSERT_NE(place, std::string::npos) << good << " in " << text;
    changed.replace(place, good.size(), bad);
    EXPECT_THROW(read_queue_state(changed), Error) << bad;
  }
}

}  // namespace
}  // namespace nao::gateway
