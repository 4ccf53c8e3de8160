#include <imgui.h>

#include "robot_model/robot_model.h"
#include "viewer/image_texture.h"
#include "viewer/message_store.h"
#include "viewer/panels/panel_state.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"

namespace nao::viewer {

void draw_camera_panel(const MessageStore& store, const RobotModel& model,
                       const ImageTexture& image, PanelState& state) {
  const float width = ImGui::GetIO().DisplaySize.x;
  place(width - 344, 8, 336, 312);
  // While it is closed or collapsed, no images are requested.
  state.is_camera_open = begin_panel("Head camera", state);
  if (state.is_camera_open) {
    for (const CameraModel& camera : model.cameras()) {
      if (ImGui::RadioButton(camera.name.c_str(), state.camera == camera.name)) {
        state.camera = camera.name;
      }
      tooltip("The camera whose images are requested.");
      ImGui::SameLine();
    }
    if (image.texture() == 0) {
      ImGui::TextColored(kBadColor, "waiting");
      ImGui::TextColored(kFaintColor, "for %s", store.channels().head_camera_image.c_str());
    } else {
      const naolcm::image_t& message = store.image()->message;
      ImGui::TextColored(kFaintColor, "%s %dx%d %.1f kB", message.camera.c_str(), message.width,
                         message.height, 1e-3 * message.size_bytes);
      const float shown = ImGui::GetContentRegionAvail().x;
      ImGui::Image(
          reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(image.texture())),
          {shown, shown * static_cast<float>(image.height()) / static_cast<float>(image.width())});
    }
  }
  ImGui::End();
}

}  // namespace nao::viewer
