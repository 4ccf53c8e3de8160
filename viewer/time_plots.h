#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace nao::viewer {

/** Values of one field over time. */
struct PlotSeries {
  std::string channel;
  /** Path of the field, as NumberField::path: "joint_position[HeadYaw]". */
  std::string field;
  struct Point {
    /** s, the time line of the messages. */
    double time;
    double value;
  };
  /** Oldest first; finite values only. */
  std::deque<Point> points;
};

/** The fields that are plotted, with their recent values. */
class TimePlots {
 public:
  /** @param window  Duration that is kept, s. */
  explicit TimePlots(double window = 10) : window_(window) {}

  /** Adds a curve unless it exists. */
  void add(const std::string& channel, const std::string& field);
  void remove(size_t index);

  /** Adds the values of a message to the curves of its channel.
   * @param time  s; if it is earlier than the last one, the curve restarts. */
  void receive(const std::string& channel, const uint8_t* data, int num_bytes, double time);

  /** Removes all values; the curves stay. */
  void clear();

  double window() const { return window_; }
  const std::vector<PlotSeries>& series() const { return series_; }

 private:
  bool has_curve_of(const std::string& channel) const;

  double window_;
  std::vector<PlotSeries> series_;
};

}  // namespace nao::viewer
