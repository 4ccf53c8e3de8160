#include <imgui.h>

#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"

namespace nao::viewer {
namespace {

void checkbox(const char* label, bool& value, const char* explanation) {
  ImGui::Checkbox(label, &value);
  tooltip(explanation);
}

}  // namespace

void draw_view_panel(PanelState& state, const std::vector<std::string>& problems) {
  place(8, 614, 296, 178);
  if (begin_panel("View", state)) {
    ViewChoice& choice = state.choice;
    ImGui::Columns(2, nullptr, false);
    checkbox("estimate", choice.estimated_robot,
             "The robot as nao-motion estimates it from its sensors.");
    checkbox("truth", choice.true_robot,
             "The robot as the simulator computes it; bluish beside the estimate.");
    checkbox("see through", choice.translucent,
             "Draws the estimated robot translucent, so that markings inside are visible.");
    checkbox("forces", choice.contact_forces,
             "Contact forces of the simulator: 1 cm is 2 N, 40 cm at most.");
    checkbox("follow", state.follow, "Keeps the robot in the middle of the view.");
    ImGui::NextColumn();
    checkbox("center of mass", choice.com,
             "Estimated center of mass, and its projection on the ground (orange).");
    checkbox("pressure", choice.center_of_pressure,
             "Center of pressure under the feet, from the foot sensors (purple).");
    checkbox("support", choice.support_polygon,
             "Support polygon of the feet that carry weight (blue).");
    checkbox("footsteps", choice.footsteps, "Planned footsteps: left orange, right blue.");
    if (button("align", "Moves the estimate to the true robot's place.")) {
      state.is_alignment_requested = true;
    }
    ImGui::Columns(1);
    ImGui::TextColored(kFaintColor, "drag: rotate  right: pan  wheel: zoom");
    for (const std::string& problem : problems) {
      ImGui::PushTextWrapPos(0);
      ImGui::TextColored(kBadColor, "%s", problem.c_str());
      ImGui::PopTextWrapPos();
    }
  }
  ImGui::End();
}

}  // namespace nao::viewer
