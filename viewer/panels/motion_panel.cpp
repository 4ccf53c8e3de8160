#include <imgui.h>

#include <cmath>

#include "messages/body_condition.h"
#include "messages/command.h"
#include "messages/mode.h"
#include "robot_model/robot_model.h"
#include "viewer/message_store.h"
#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"
#include "viewer/viewer_commands.h"

namespace nao::viewer {
namespace {

void show_motion_state(const naolcm::motion_state_t& message) {
  ImGui::TextColored(kGoodColor, "%s", to_string(static_cast<Mode>(message.mode)));
  ImGui::SameLine();
  ImGui::Text("%s", message.posture.c_str());
  if (message.command_kind != message.COMMAND_KIND_NONE) {
    ImGui::Text("%s %s", to_string(static_cast<CommandKind>(message.command_kind)),
                message.command_name.c_str());
    if (std::isfinite(message.command_progress)) {
      ImGui::ProgressBar(static_cast<float>(message.command_progress), {-1, 12}, "");
    }
  }
  if (std::isfinite(message.balance_margin)) {
    ImGui::TextColored(kFaintColor, "balance %+.0f mm", 1e3 * message.balance_margin);
  } else {
    ImGui::TextColored(kFaintColor, "no foot carries weight");
  }
  ImGui::SameLine();
  ImGui::TextColored(kFaintColor, "  stiffness %.0f %%", 100 * message.stiffness);
}

/** A real robot's battery, hottest motor and warnings; a simulated body has none. */
void show_body(const MessageStore& store, double now) {
  const auto& body = store.body_state();
  if (!body || now - body->time > kStateTimeout) return;
  const BodyCondition condition = summarize(body->message);
  if (!condition.is_known()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, condition.warnings.empty() ? kFaintColor : kBadColor);
  ImGui::TextWrapped("%s", to_sentence(condition).c_str());
  ImGui::PopStyleColor();
}

void show_posture_buttons(const RobotModel& model, ViewerCommands& commands, PanelState& state) {
  bool is_first = true;
  for (const Posture& posture : model.postures()) {
    if (!is_first) same_line_if_fits(posture.name.c_str());
    is_first = false;
    if (button(posture.name.c_str(), "Moves to this posture.")) {
      commands.go_to_posture(posture.name, state.posture_speed);
    }
  }
}

void show_action_buttons(const RobotModel& model, ViewerCommands& commands) {
  bool is_first = true;
  for (const Action& action : model.actions()) {
    if (!is_first) same_line_if_fits(action.name.c_str());
    is_first = false;
    if (button(action.name.c_str(), "Executes this action.")) commands.start_action(action.name);
  }
}

void show_walk_controls(const WalkLimits& limits, PanelState& state) {
  ImGui::SliderFloat("forward, m/s", &state.vx, -static_cast<float>(limits.backward),
                     static_cast<float>(limits.forward), "%.2f");
  tooltip("Commanded velocity forward; negative: backward.");
  ImGui::SliderFloat("left, m/s", &state.vy, -static_cast<float>(limits.sideways),
                     static_cast<float>(limits.sideways), "%.2f");
  tooltip("Commanded velocity to the left; negative: to the right.");
  ImGui::SliderFloat("turn, rad/s", &state.wz, -static_cast<float>(limits.turning),
                     static_cast<float>(limits.turning), "%.2f");
  tooltip("Commanded turning rate to the left; negative: to the right.");
  ImGui::Button("Walk while held");
  tooltip("Walks while the mouse button is held down here.");
  state.is_walking = ImGui::IsItemActive();
}

void show_controls(const RobotModel& model, ViewerCommands& commands, PanelState& state) {
  if (button("Stop", "Ends any motion: a walk at its next double support.")) commands.stop();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(110);
  ImGui::SliderFloat("speed", &state.posture_speed, 0.05f, 1, "%.2f");
  tooltip("Fraction of the maximum speed, for postures.");
  ImGui::Separator();
  show_posture_buttons(model, commands, state);
  ImGui::Separator();
  show_action_buttons(model, commands);
  ImGui::Separator();
  show_walk_controls(model.walk_limits(), state);
}

void show_results(const MessageStore& store) {
  ImGui::TextColored(kFaintColor, "Results, newest first");
  ImGui::BeginChild("results");
  for (auto result = store.results().rbegin(); result != store.results().rend(); ++result) {
    const naolcm::command_result_t& message = result->message;
    const bool is_bad =
        message.status == message.STATUS_REFUSED || message.status == message.STATUS_FAILED;
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(is_bad ? kBadColor : kFaintColor, "%s %s %s",
                       to_string(static_cast<CommandKind>(message.command_kind)),
                       to_string(static_cast<ResultStatus>(message.status)),
                       message.reason.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::EndChild();
}

}  // namespace

void draw_motion_panel(const MessageStore& store, const RobotModel& model, ViewerCommands* commands,
                       PanelState& state, double now) {
  place(8, 186, 296, 420);
  // Set by the button below while it is held: a closed panel must not keep the robot walking.
  state.is_walking = false;
  if (begin_panel("Motion", state)) {
    const auto& motion = store.motion_state();
    if (!motion || now - motion->time > kStateTimeout) {
      ImGui::TextColored(kBadColor, "No motion: waiting for %s",
                         store.channels().motion_state.c_str());
    } else {
      show_motion_state(motion->message);
    }
    show_body(store, now);
    if (commands == nullptr) {
      show_no_commands();
    } else {
      show_controls(model, *commands, state);
    }
    ImGui::Separator();
    show_results(store);
  }
  ImGui::End();
}

}  // namespace nao::viewer
