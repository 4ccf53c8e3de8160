#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace nao {

/** Values of one field over time. */
struct PlotSeries {
  std::string channel;
  /** As visit_fields() names it. */
  std::string field;
  struct Point {
    double time;
    double value;
  };
  /** Oldest first; finite values only. */
  std::deque<Point> points;
};

/** The curves that a person picked. */
class TimePlots {
 public:
  /** @param window  How much of the past is kept, s. */
  explicit TimePlots(double window = 10) : window_(window) {}

  void add(const std::string& channel, const std::string& field);
  void remove(size_t index);
  bool wants(const std::string& channel) const;

  /** Adds a message's values to the series of its channel. @param time  s; running back clears. */
  void receive(const std::string& channel, const uint8_t* data, int num_bytes, double time);

  /** Forgets the values, not the choice of fields. */
  void clear();

  double window() const { return window_; }
  const std::vector<PlotSeries>& series() const { return series_; }

 private:
  double window_;
  std::vector<PlotSeries> series_;
};

}  // namespace nao
