#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "message_reflection/number_fields.h"
#include "viewer/message_store.h"
#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"
#include "viewer/time_plots.h"

namespace nao::viewer {
namespace {

const ImU32 kCurveColors[] = {IM_COL32(110, 190, 255, 255), IM_COL32(255, 170, 80, 255),
                              IM_COL32(130, 220, 120, 255), IM_COL32(245, 110, 130, 255),
                              IM_COL32(200, 150, 255, 255), IM_COL32(240, 225, 110, 255)};
constexpr ImU32 kBackgroundColor = IM_COL32(18, 20, 24, 230);
constexpr ImU32 kGridColor = IM_COL32(60, 64, 72, 255);
constexpr ImU32 kAxisColor = IM_COL32(170, 175, 185, 255);

ImU32 curve_color(size_t curve) {
  return kCurveColors[curve % std::size(kCurveColors)];
}

/** Range of values of a plot. */
struct Range {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  bool is_empty() const { return low > high; }
};

/** Range of all curves with a margin of 5 %; a constant value gets a small one. */
Range range_of(const TimePlots& plots) {
  Range range;
  for (const PlotSeries& series : plots.series()) {
    for (const auto& point : series.points) {
      range.low = std::min(range.low, point.value);
      range.high = std::max(range.high, point.value);
    }
  }
  if (range.is_empty()) return range;
  const double margin =
      std::max(0.05 * (range.high - range.low), 1e-9 + 1e-6 * std::abs(range.high));
  range.low -= margin;
  range.high += margin;
  return range;
}

/** Draws all curves over the time window, in one range, with its limits written beside it. */
void draw_curves(const TimePlots& plots, double now, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, height);
  ImGui::InvisibleButton("curves", size);
  tooltip("Newest on the right; the whole width is 10 s.");
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, kBackgroundColor);
  const Range range = range_of(plots);
  if (range.is_empty()) return;
  for (int i = 1; i < 4; ++i) {
    const float y = corner.y + size.y * static_cast<float>(i) / 4;
    list->AddLine({corner.x, y}, {corner.x + size.x, y}, kGridColor);
  }
  std::vector<ImVec2> curve;
  for (size_t i = 0; i < plots.series().size(); ++i) {
    curve.clear();
    for (const auto& point : plots.series()[i].points) {
      // 0 at the left edge, 1 at the right one.
      const double fraction = 1 - (now - point.time) / plots.window();
      if (fraction < 0 || fraction > 1) continue;
      curve.push_back({corner.x + static_cast<float>(fraction) * size.x,
                       corner.y + size.y * static_cast<float>((range.high - point.value) /
                                                              (range.high - range.low))});
    }
    // One polyline for each curve; points outside of the window are left out.
    list->AddPolyline(curve.data(), static_cast<int>(curve.size()), curve_color(i), 0, 1.5f);
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", range.high);
  list->AddText({corner.x + 4, corner.y + 2}, kAxisColor, text);
  std::snprintf(text, sizeof text, "%.4g", range.low);
  list->AddText({corner.x + 4, corner.y + size.y - 16}, kAxisColor, text);
}

/** List of the numbers in a channel's newest message; selecting one adds its curve. */
void show_field_list(const std::vector<uint8_t>& message, TimePlots& plots,
                     const PanelState& state) {
  visit_numbers(message, [&](const NumberField& field) {
    if (field.path.find(state.field_filter) == std::string::npos) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s = %.5g %s", field.path.c_str(), field.value,
                  field.constant.c_str());
    if (ImGui::Selectable(text)) plots.add(state.plot_channel, field.path);
  });
}

/** Controls that select a channel and one of its fields. */
void show_field_picker(const MessageStore& store, TimePlots& plots, PanelState& state) {
  ImGui::SetNextItemWidth(190);
  if (ImGui::BeginCombo("##channel",
                        state.plot_channel.empty() ? "channel" : state.plot_channel.c_str())) {
    for (const auto& [channel, data] : store.raw()) {
      if (ImGui::Selectable(channel.c_str(), channel == state.plot_channel)) {
        state.plot_channel = channel;
      }
    }
    ImGui::EndCombo();
  }
  tooltip("Channel of the field.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(150);
  ImGui::InputText("##filter", state.field_filter, sizeof state.field_filter);
  tooltip("Part of the field's name, to shorten the list.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(150);
  const auto raw = store.raw().find(state.plot_channel);
  if (ImGui::BeginCombo("##field", "add a field")) {
    if (raw != store.raw().end()) show_field_list(raw->second, plots, state);
    ImGui::EndCombo();
  }
  tooltip("Any number of a message can be plotted.");
}

/** Names and last values of the curves, each with a button that removes it. */
void show_legend(TimePlots& plots) {
  for (size_t i = 0; i < plots.series().size(); ++i) {
    const PlotSeries& series = plots.series()[i];
    ImGui::PushID(static_cast<int>(i));
    if (i > 0) same_line_if_fits((series.channel + "." + series.field + " 000.00000 x").c_str());
    if (ImGui::SmallButton("x")) {
      plots.remove(i);
      ImGui::PopID();
      // The list has changed; the others are drawn in the next frame.
      break;
    }
    tooltip("Removes this curve.");
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, curve_color(i));
    ImGui::Text("%s.%s %.4g", series.channel.c_str(), series.field.c_str(),
                series.points.empty() ? std::nan("") : series.points.back().value);
    ImGui::PopStyleColor();
    ImGui::PopID();
  }
}

}  // namespace

void draw_plots_panel(const MessageStore& store, TimePlots& plots, PanelState& state, double now) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  place(312, display.y - kPlotsHeight - 8, display.x - 320, kPlotsHeight);
  if (begin_panel("Plots", state)) {
    show_field_picker(store, plots, state);
    show_legend(plots);
    draw_curves(plots, now, std::max(40.0f, ImGui::GetContentRegionAvail().y));
  }
  ImGui::End();
}

}  // namespace nao::viewer
