#include "viewer/panels/widgets.h"

#include "viewer/panels/panel_state.h"

namespace nao::viewer {

void tooltip(const char* text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

bool button(const char* label, const char* explanation) {
  const bool is_pressed = ImGui::Button(label);
  tooltip(explanation);
  return is_pressed;
}

void same_line_if_fits(const char* next_label) {
  const float width = ImGui::CalcTextSize(next_label).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float right = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (right < ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
}

void place(float x, float y, float width, float height) {
  ImGui::SetNextWindowPos({x, y}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({width, height}, ImGuiCond_FirstUseEver);
}

bool begin_panel(const char* title, PanelState& state) {
  const bool is_open = ImGui::Begin(title);
  const ImVec2 position = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  // The rounded corners do not cover what is behind them.
  const float margin = ImGui::GetStyle().WindowRounding;
  // ImGui's y runs down, OpenGL's up.
  const float bottom = ImGui::GetIO().DisplaySize.y - position.y - size.y;
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  state.covered.push_back({static_cast<int>(scale.x * (position.x + margin)),
                           static_cast<int>(scale.y * (bottom + margin)),
                           static_cast<int>(scale.x * (position.x + size.x - margin)),
                           static_cast<int>(scale.y * (bottom + size.y - margin))});
  return is_open;
}

void show_no_commands() {
  ImGui::TextColored(kFaintColor, "A log is played: no commands.");
}

}  // namespace nao::viewer
