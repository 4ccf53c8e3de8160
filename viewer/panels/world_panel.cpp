#include <imgui.h>

#include "viewer/message_store.h"
#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"
#include "viewer/viewer_commands.h"

namespace nao::viewer {
namespace {

/** @return nullptr if the truth is not current. */
const naolcm::world_truth_t* current_truth(const MessageStore& store, double now) {
  // Longer than for other states: a simulator that is slower than real time publishes less often.
  const auto& truth = store.truth();
  return truth && now - truth->time < 3 * kStateTimeout ? &truth->message : nullptr;
}

void show_truth(const naolcm::world_truth_t* truth) {
  if (truth == nullptr) {
    ImGui::TextColored(kBadColor, "No simulator: waiting for %s", kWorldTruthChannel);
    return;
  }
  ImGui::Text("%.2f s  scene %s  %.2f x real time%s", 1e-6 * static_cast<double>(truth->utime),
              truth->scene.c_str(), truth->real_time_factor,
              truth->is_paused != 0 ? "  paused" : "");
  ImGui::TextColored(kFaintColor, "late: %lld commands, %lld ticks",
                     static_cast<long long>(truth->num_late_commands),
                     static_cast<long long>(truth->num_late_ticks));
}

void show_controls(ViewerCommands& commands, bool is_paused) {
  if (button(is_paused ? "Resume" : "Pause", "Pauses or resumes the simulation.")) {
    commands.send_world_command(is_paused ? "resume" : "pause");
  }
  ImGui::SameLine();
  if (button("Step", "Simulates one tick while paused.")) commands.send_world_command("step", 1);
  ImGui::SameLine();
  if (button("Step 100", "Simulates 100 ticks while paused.")) {
    commands.send_world_command("step", 100);
  }
  ImGui::SameLine();
  if (button("Reset", "Puts robot and ball back to their initial places.")) {
    commands.send_world_command("reset");
  }
  ImGui::TextColored(kFaintColor, "Drag the ball to move it.");
  ImGui::TextColored(kFaintColor, "Ctrl + drag on the robot pushes it.");
  if (!commands.last_outcome().empty()) {
    ImGui::TextWrapped("%s", commands.last_outcome().c_str());
  }
}

}  // namespace

void draw_world_panel(const MessageStore& store, ViewerCommands* commands, PanelState& state,
                      double now) {
  place(8, 8, 296, 170);
  if (begin_panel("World", state)) {
    const naolcm::world_truth_t* truth = current_truth(store, now);
    show_truth(truth);
    if (commands == nullptr) {
      show_no_commands();
    } else {
      show_controls(*commands, truth != nullptr && truth->is_paused != 0);
    }
  }
  ImGui::End();
}

}  // namespace nao::viewer
