#include <imgui.h>

#include <algorithm>

#include "viewer/message_store.h"
#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"

namespace nao::viewer {
namespace {

/** A program without a status for this time is not running, s: two of its messages were lost. */
constexpr double kProgramTimeout = 3;

void show_figures(const naolcm::daemon_status_t& status) {
  std::string figures;
  const size_t num = std::min(status.metric_names.size(), status.metric_values.size());
  for (size_t i = 0; i < num; ++i) {
    figures += status.metric_names[i] + " " + std::to_string(status.metric_values[i]) + "\n";
  }
  ImGui::SetTooltip("robot %s, process %d, version %s, dropped %lld\n%s",
                    status.robot.empty() ? "all" : status.robot.c_str(), status.process_id,
                    status.version.c_str(), static_cast<long long>(status.num_messages_dropped),
                    figures.c_str());
}

}  // namespace

void draw_programs_panel(const MessageStore& store, PanelState& state, double now) {
  const float width = ImGui::GetIO().DisplaySize.x;
  place(width - 344, 328, 336, 150);
  if (begin_panel("Programs", state)) {
    if (store.programs().empty()) ImGui::TextColored(kFaintColor, "no status received");
    for (const auto& [key, status] : store.programs()) {
      const bool is_silent = now - status.time > kProgramTimeout;
      const bool is_ready = status.message.state == "ready";
      ImGui::TextColored(is_silent  ? kFaintColor
                         : is_ready ? kGoodColor
                                    : kBadColor,
                         "%s", status.message.program.c_str());
      ImGui::SameLine(140);
      ImGui::Text("%s %s", is_silent ? "not running" : status.message.state.c_str(),
                  is_silent ? "" : status.message.detail.c_str());
      if (ImGui::IsItemHovered()) show_figures(status.message);
    }
  }
  ImGui::End();
}

}  // namespace nao::viewer
