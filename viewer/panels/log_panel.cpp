#include <imgui.h>

#include "viewer/log_player.h"
#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"

namespace nao::viewer {

void draw_log_panel(LogPlayer& player, PanelState& state) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  place(312, display.y - kPlotsHeight - 72, display.x - 320, 56);
  if (begin_panel("Log", state)) {
    if (button(player.is_paused ? "Play" : "Pause", "Plays or pauses the log.")) {
      player.is_paused = !player.is_paused;
    }
    ImGui::SameLine();
    auto speed = static_cast<float>(player.speed);
    ImGui::SetNextItemWidth(90);
    if (ImGui::SliderFloat("##speed", &speed, 0.1f, 10, "%.1f x", ImGuiSliderFlags_Logarithmic)) {
      player.speed = speed;
    }
    tooltip("Speed of playing, relative to real time.");
    ImGui::SameLine();
    auto time = static_cast<float>(player.time());
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##time", &time, 0, static_cast<float>(player.duration()), "%.2f s")) {
      state.requested_log_time = time;
    }
    tooltip("Drag to any time of the recording.");
  }
  ImGui::End();
}

}  // namespace nao::viewer
