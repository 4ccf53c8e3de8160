#include "viewer/time_plots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "message_reflection/number_fields.h"

namespace nao::viewer {

void TimePlots::add(const std::string& channel, const std::string& field) {
  const bool is_known = std::any_of(series_.begin(), series_.end(), [&](const PlotSeries& series) {
    return series.channel == channel && series.field == field;
  });
  if (!is_known) series_.push_back({channel, field, {}});
}

void TimePlots::remove(size_t index) {
  if (index < series_.size()) series_.erase(series_.begin() + static_cast<std::ptrdiff_t>(index));
}

bool TimePlots::has_curve_of(const std::string& channel) const {
  return std::any_of(series_.begin(), series_.end(),
                     [&](const PlotSeries& series) { return series.channel == channel; });
}

void TimePlots::receive(const std::string& channel, const uint8_t* data, int num_bytes,
                        double time) {
  if (!has_curve_of(channel)) return;
  const std::span message(data, static_cast<size_t>(num_bytes));
  visit_numbers(message, [&](const NumberField& field) {
    if (!std::isfinite(field.value)) return;
    for (PlotSeries& series : series_) {
      if (series.channel != channel || series.field != field.path) continue;
      if (!series.points.empty() && time < series.points.back().time) series.points.clear();
      series.points.push_back({time, field.value});
      while (series.points.front().time < time - window_) series.points.pop_front();
    }
  });
}

void TimePlots::clear() {
  for (PlotSeries& series : series_) series.points.clear();
}

}  // namespace nao::viewer
