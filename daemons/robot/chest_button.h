#pragma once

namespace nao::robot {

/** Presses of the chest button. */
enum class Press { kNone, kOnce, kTwice, kLong };

/** Distinguishes the kinds of presses of a button. A long press counts while it lasts, a single one
 * when no second press has followed it. */
class ChestButton {
 public:
  /** @param dt  Time since the last call, s. */
  Press step(bool is_pressed, double dt) {
    const bool was_pressed = is_pressed_;
    is_pressed_ = is_pressed;
    time_ = is_pressed == was_pressed ? time_ + dt : 0;
    if (is_pressed) {
      if (!was_pressed) ++num_presses_;
      if (num_presses_ == 0 || time_ < kLongTime) return Press::kNone;
      num_presses_ = 0;
      return Press::kLong;
    }
    if (num_presses_ == 0 || time_ < kPauseTime) return Press::kNone;
    const Press press = num_presses_ == 1 ? Press::kOnce : Press::kTwice;
    num_presses_ = 0;
    return press;
  }

 private:
  /** Length of a long press, s: the value with which robot soccer teams shut a robot down. */
  static constexpr double kLongTime = 3;
  /** Time after a press in which a second one belongs to it, s. Chosen: as of a mouse's double
   * click. */
  static constexpr double kPauseTime = 0.5;

  bool is_pressed_ = false;
  /** Time since the button was pressed or released, s. */
  double time_ = 0;
  /** Presses that do not yet form a kind of press. */
  int num_presses_ = 0;
};

}  // namespace nao::robot
