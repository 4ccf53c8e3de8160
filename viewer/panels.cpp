#include "viewer/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "message_reflection/number_fields.h"
#include "messages/command.h"
#include "messages/mode.h"

namespace nao {
namespace {

/** A state older than this is shown as gone, s. */
constexpr double kStale = 0.5;
constexpr double kProgramGone = 3;
const ImVec4 kGood(0.45f, 0.85f, 0.45f, 1);
const ImVec4 kBad(0.95f, 0.45f, 0.4f, 1);
const ImVec4 kFaint(0.65f, 0.68f, 0.72f, 1);
const ImU32 kCurveColors[] = {IM_COL32(110, 190, 255, 255), IM_COL32(255, 170, 80, 255),
                              IM_COL32(130, 220, 120, 255), IM_COL32(245, 110, 130, 255),
                              IM_COL32(200, 150, 255, 255), IM_COL32(240, 225, 110, 255)};

/** Explains the last control when the mouse rests on it. */
void hint(const char* text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

bool button(const char* label, const char* explanation) {
  const bool is_pressed = ImGui::Button(label);
  hint(explanation);
  return is_pressed;
}

/** The next button goes on the same line if it fits. */
void flow(const char* next_label) {
  const float width = ImGui::CalcTextSize(next_label).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float right = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (right < ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
}

void place(float x, float y, float width, float height) {
  ImGui::SetNextWindowPos({x, y}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({width, height}, ImGuiCond_FirstUseEver);
}

/** Begins a panel, which hides what lies behind it. @return Whether it is unfolded. */
bool begin(const char* title, PanelState& state) {
  const bool is_open = ImGui::Begin(title);
  const ImVec2 position = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  // Its rounded corners let the view through.
  const float margin = ImGui::GetStyle().WindowRounding;
  const float bottom = ImGui::GetIO().DisplaySize.y - position.y - size.y;
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  state.covered.push_back({static_cast<int>(scale.x * (position.x + margin)),
                           static_cast<int>(scale.y * (bottom + margin)),
                           static_cast<int>(scale.x * (position.x + size.x - margin)),
                           static_cast<int>(scale.y * (bottom + size.y - margin))});
  return is_open;
}

/** Shows why the controls that follow do nothing. */
void say_log_only() {
  ImGui::TextColored(kFaint, "A log is shown: no commands.");
}

const naolcm::world_truth_t* current(const MessageStore& store, double now) {
  const auto& truth = store.truth();
  return truth && now - truth->time < 3 * kStale ? &truth->message : nullptr;
}

}  // namespace

void draw_world_panel(const MessageStore& store, CommandSender* commands, PanelState& state,
                      double now) {
  place(8, 8, 296, 170);
  if (begin("World", state)) {
    const naolcm::world_truth_t* truth = current(store, now);
    if (truth == nullptr) {
      ImGui::TextColored(kBad, "No simulator: waiting for %s", kWorldTruthChannel);
    } else {
      ImGui::Text("%.2f s  scene %s  %.2f x real time%s", 1e-6 * static_cast<double>(truth->utime),
                  truth->scene.c_str(), truth->real_time_factor,
                  truth->is_paused != 0 ? "  paused" : "");
      ImGui::TextColored(kFaint, "late: %lld commands, %lld ticks",
                         static_cast<long long>(truth->num_late_commands),
                         static_cast<long long>(truth->num_late_ticks));
    }
    if (commands == nullptr) {
      say_log_only();
    } else {
      const bool is_paused = truth != nullptr && truth->is_paused != 0;
      if (button(is_paused ? "Resume" : "Pause",
                 "Lets the simulated time stand still, or go on.")) {
        commands->change_world(is_paused ? "resume" : "pause");
      }
      ImGui::SameLine();
      if (button("Step", "Computes one tick of 10 ms, while paused.")) {
        commands->change_world("step", 1);
      }
      ImGui::SameLine();
      if (button("Step 100", "Computes one second, while paused.")) {
        commands->change_world("step", 100);
      }
      ImGui::SameLine();
      if (button("Reset", "Puts robot and ball back to where they started.")) {
        commands->change_world("reset");
      }
      ImGui::TextColored(kFaint, "Drag the ball to move it.");
      ImGui::TextColored(kFaint, "Ctrl + drag on the robot pushes it.");
      if (!commands->last_outcome().empty()) {
        ImGui::TextWrapped("%s", commands->last_outcome().c_str());
      }
    }
  }
  ImGui::End();
}

void draw_motion_panel(const MessageStore& store, const RobotModel& model, CommandSender* commands,
                       PanelState& state, double now) {
  place(8, 186, 296, 420);
  state.is_walking = false;
  if (begin("Motion", state)) {
    const auto& motion = store.motion_state();
    if (!motion || now - motion->time > kStale) {
      ImGui::TextColored(kBad, "No motion: waiting for %s", store.channels().motion_state.c_str());
    } else {
      const naolcm::motion_state_t& message = motion->message;
      ImGui::TextColored(kGood, "%s", to_string(static_cast<Mode>(message.mode)));
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
        ImGui::TextColored(kFaint, "balance %+.0f mm", 1e3 * message.balance_margin);
      } else {
        ImGui::TextColored(kFaint, "no foot carries weight");
      }
      ImGui::SameLine();
      ImGui::TextColored(kFaint, "  stiffness %.0f %%", 100 * message.stiffness);
    }
    if (commands == nullptr) {
      say_log_only();
    } else {
      if (button("Stop", "Ends any motion: a walk at its next double support.")) commands->stop();
      ImGui::SameLine();
      ImGui::SetNextItemWidth(110);
      ImGui::SliderFloat("speed", &state.posture_speed, 0.05f, 1, "%.2f");
      hint("Fraction of the maximum speed, for postures.");
      ImGui::Separator();
      bool is_first = true;
      for (const Posture& posture : model.postures()) {
        if (!is_first) flow(posture.name.c_str());
        is_first = false;
        if (button(posture.name.c_str(), "Goes to this posture.")) {
          commands->go_to_posture(posture.name, state.posture_speed);
        }
      }
      ImGui::Separator();
      is_first = true;
      for (const std::string& action : model.actions()) {
        if (!is_first) flow(action.c_str());
        is_first = false;
        if (button(action.c_str(), "Does this action.")) commands->act(action);
      }
      ImGui::Separator();
      const WalkLimits& limits = model.walk_limits();
      ImGui::SliderFloat("ahead, m/s", &state.vx, -static_cast<float>(limits.backward),
                         static_cast<float>(limits.forward), "%.2f");
      hint("Walking speed ahead; negative walks back.");
      ImGui::SliderFloat("left, m/s", &state.vy, -static_cast<float>(limits.sideways),
                         static_cast<float>(limits.sideways), "%.2f");
      hint("Walking speed to the left; negative walks to the right.");
      ImGui::SliderFloat("turn, rad/s", &state.wz, -static_cast<float>(limits.turning),
                         static_cast<float>(limits.turning), "%.2f");
      hint("Turning speed to the left; negative turns to the right.");
      ImGui::Button("Walk while held");
      hint("Walks as long as the mouse button is held down here.");
      state.is_walking = ImGui::IsItemActive();
    }
    ImGui::Separator();
    ImGui::TextColored(kFaint, "Results, newest first");
    ImGui::BeginChild("results");
    for (auto result = store.results().rbegin(); result != store.results().rend(); ++result) {
      const naolcm::command_result_t& message = result->message;
      const bool is_bad =
          message.status == message.STATUS_REFUSED || message.status == message.STATUS_FAILED;
      ImGui::PushTextWrapPos(0);
      ImGui::TextColored(is_bad ? kBad : kFaint, "%s %s %s",
                         to_string(static_cast<CommandKind>(message.command_kind)),
                         to_string(static_cast<ResultStatus>(message.status)),
                         message.reason.c_str());
      ImGui::PopTextWrapPos();
    }
    ImGui::EndChild();
  }
  ImGui::End();
}

void draw_view_panel(PanelState& state, const std::vector<std::string>& problems) {
  place(8, 614, 296, 178);
  if (begin("View", state)) {
    ViewChoice& choice = state.choice;
    ImGui::Columns(2, nullptr, false);
    ImGui::Checkbox("estimate", &choice.estimated_robot);
    hint("The robot as nao-motion estimates it from its sensors.");
    ImGui::Checkbox("truth", &choice.true_robot);
    hint("The robot as the simulator knows it; bluish beside the estimate.");
    ImGui::Checkbox("see through", &choice.see_through);
    hint("Draws the estimated robot translucent, so that the marks inside show.");
    ImGui::Checkbox("forces", &choice.contact_forces);
    hint("Contact forces of the simulator: 1 cm is 2 N, 40 cm at most.");
    ImGui::Checkbox("follow", &state.follow);
    hint("Keeps the robot in the middle.");
    ImGui::NextColumn();
    ImGui::Checkbox("centre of mass", &choice.center_of_mass);
    hint("Estimated centre of mass, and where it stands over the ground (orange).");
    ImGui::Checkbox("pressure", &choice.center_of_pressure);
    hint("Centre of pressure under the feet, from the foot sensors (purple).");
    ImGui::Checkbox("support", &choice.support_polygon);
    hint("Support polygon of the feet that carry weight (blue).");
    ImGui::Checkbox("footsteps", &choice.footsteps);
    hint("Footsteps that are planned: left orange, right blue.");
    if (button("align", "Puts the estimate where the true robot is now.")) {
      state.wants_alignment = true;
    }
    ImGui::Columns(1);
    ImGui::TextColored(kFaint, "drag: turn  right: move  wheel: zoom");
    for (const std::string& problem : problems) {
      ImGui::PushTextWrapPos(0);
      ImGui::TextColored(kBad, "%s", problem.c_str());
      ImGui::PopTextWrapPos();
    }
  }
  ImGui::End();
}

void draw_camera_panel(const MessageStore& store, const PictureTexture& picture,
                       PanelState& state) {
  const float width = ImGui::GetIO().DisplaySize.x;
  place(width - 344, 8, 336, 312);
  // Closed or folded away, nobody watches, and the camera need not draw.
  state.watches_camera = begin("Head camera", state);
  if (state.watches_camera) {
    for (const char* camera : {"top", "bottom"}) {
      if (ImGui::RadioButton(camera, state.camera == camera)) state.camera = camera;
      hint("Which of the two head cameras to watch.");
      ImGui::SameLine();
    }
    if (picture.texture() == 0) {
      ImGui::TextColored(kBad, "waiting");
      ImGui::TextColored(kFaint, "for %s", store.channels().head_camera_image.c_str());
    } else {
      const naolcm::image_t& image = store.image()->message;
      ImGui::TextColored(kFaint, "%s %dx%d %.1f kB", image.camera.c_str(), image.width,
                         image.height, 1e-3 * image.size_bytes);
      const float shown = ImGui::GetContentRegionAvail().x;
      ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(picture.texture())),
                   {shown, shown * static_cast<float>(picture.height()) /
                               static_cast<float>(picture.width())});
    }
  }
  ImGui::End();
}

void draw_programs_panel(const MessageStore& store, PanelState& state, double now) {
  const float width = ImGui::GetIO().DisplaySize.x;
  place(width - 344, 328, 336, 150);
  if (begin("Programs", state)) {
    if (store.programs().empty()) ImGui::TextColored(kFaint, "none heard of yet");
    for (const auto& [key, status] : store.programs()) {
      const bool is_gone = now - status.time > kProgramGone;
      const bool is_ready = status.message.state == "ready";
      ImGui::TextColored(is_gone    ? kFaint
                         : is_ready ? kGood
                                    : kBad,
                         "%s", status.message.program.c_str());
      ImGui::SameLine(140);
      ImGui::Text("%s %s", is_gone ? "gone" : status.message.state.c_str(),
                  is_gone ? "" : status.message.detail.c_str());
      if (ImGui::IsItemHovered()) {
        std::string figures;
        const size_t num =
            std::min(status.message.metric_names.size(), status.message.metric_values.size());
        for (size_t i = 0; i < num; ++i) {
          figures += status.message.metric_names[i] + " " +
                     std::to_string(status.message.metric_values[i]) + "\n";
        }
        ImGui::SetTooltip("process %d, version %s, dropped %lld\n%s", status.message.process_id,
                          status.message.version.c_str(),
                          static_cast<long long>(status.message.num_messages_dropped),
                          figures.c_str());
      }
    }
  }
  ImGui::End();
}

namespace {

/** Curves over the last seconds, all in one range, with its bounds written beside it. */
void draw_curves(const TimePlots& plots, double now, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, height);
  ImGui::InvisibleButton("curves", size);
  hint("Newest on the right; the whole width is 10 s.");
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(18, 20, 24, 230));
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const PlotSeries& series : plots.series()) {
    for (const auto& point : series.points) {
      low = std::min(low, point.value);
      high = std::max(high, point.value);
    }
  }
  if (low > high) return;
  const double margin = std::max(0.05 * (high - low), 1e-9 + 1e-6 * std::abs(high));
  low -= margin;
  high += margin;
  for (int i = 1; i < 4; ++i) {
    const float y = corner.y + size.y * static_cast<float>(i) / 4;
    list->AddLine({corner.x, y}, {corner.x + size.x, y}, IM_COL32(60, 64, 72, 255));
  }
  std::vector<ImVec2> curve;
  for (size_t i = 0; i < plots.series().size(); ++i) {
    curve.clear();
    for (const auto& point : plots.series()[i].points) {
      const double share = 1 - (now - point.time) / plots.window();
      if (share < 0 || share > 1) continue;
      curve.push_back(
          {corner.x + static_cast<float>(share) * size.x,
           corner.y + size.y * static_cast<float>((high - point.value) / (high - low))});
    }
    list->AddPolyline(curve.data(), static_cast<int>(curve.size()),
                      kCurveColors[i % std::size(kCurveColors)], 0, 1.5f);
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", high);
  list->AddText({corner.x + 4, corner.y + 2}, IM_COL32(170, 175, 185, 255), text);
  std::snprintf(text, sizeof text, "%.4g", low);
  list->AddText({corner.x + 4, corner.y + size.y - 16}, IM_COL32(170, 175, 185, 255), text);
}

/** Lets a person pick a channel and one of its fields. */
void draw_field_picker(const MessageStore& store, TimePlots& plots, PanelState& state) {
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
  hint("Channel whose messages have the wanted field.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(150);
  ImGui::InputText("##filter", state.field_filter, sizeof state.field_filter);
  hint("Part of the field's name, to shorten the list.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(150);
  const auto raw = store.raw().find(state.plot_channel);
  if (ImGui::BeginCombo("##field", "add a field")) {
    if (raw != store.raw().end()) {
      visit_numbers(raw->second, [&](const NumberField& field) {
        if (field.path.find(state.field_filter) == std::string::npos) return;
        char text[160];
        std::snprintf(text, sizeof text, "%s = %.5g %s", field.path.c_str(), field.value,
                      field.constant.c_str());
        if (ImGui::Selectable(text)) plots.add(state.plot_channel, field.path);
      });
    }
    ImGui::EndCombo();
  }
  hint("Any number of a message may be plotted.");
}

}  // namespace

void draw_plots_panel(const MessageStore& store, TimePlots& plots, PanelState& state, double now) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  place(312, display.y - kPlotsHeight - 8, display.x - 320, kPlotsHeight);
  if (begin("Plots", state)) {
    draw_field_picker(store, plots, state);
    for (size_t i = 0; i < plots.series().size(); ++i) {
      const PlotSeries& series = plots.series()[i];
      ImGui::PushID(static_cast<int>(i));
      if (i > 0) flow((series.channel + "." + series.field + " 000.00000 x").c_str());
      if (ImGui::SmallButton("x")) {
        plots.remove(i);
        ImGui::PopID();
        break;
      }
      hint("Removes this curve.");
      ImGui::SameLine();
      ImGui::PushStyleColor(ImGuiCol_Text, kCurveColors[i % std::size(kCurveColors)]);
      ImGui::Text("%s.%s %.4g", series.channel.c_str(), series.field.c_str(),
                  series.points.empty() ? std::nan("") : series.points.back().value);
      ImGui::PopStyleColor();
      ImGui::PopID();
    }
    draw_curves(plots, now, std::max(40.0f, ImGui::GetContentRegionAvail().y));
  }
  ImGui::End();
}

void draw_log_panel(LogPlayer& player, PanelState& state) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  place(312, display.y - kPlotsHeight - 72, display.x - 320, 56);
  if (begin("Log", state)) {
    if (button(player.is_paused ? "Play" : "Pause", "Plays the log on, or stands still.")) {
      player.is_paused = !player.is_paused;
    }
    ImGui::SameLine();
    auto speed = static_cast<float>(player.speed);
    ImGui::SetNextItemWidth(90);
    if (ImGui::SliderFloat("##speed", &speed, 0.1f, 10, "%.1f x", ImGuiSliderFlags_Logarithmic)) {
      player.speed = speed;
    }
    hint("How fast the log is played.");
    ImGui::SameLine();
    auto time = static_cast<float>(player.time());
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##time", &time, 0, static_cast<float>(player.duration()), "%.2f s")) {
      state.wished_log_time = time;
    }
    hint("Drag to any moment of the recording.");
  }
  ImGui::End();
}

}  // namespace nao
