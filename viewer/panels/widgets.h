#pragma once

#include <imgui.h>

namespace nao::viewer {

struct PanelState;

/** Text colors. */
inline const ImVec4 kGoodColor(0.45f, 0.85f, 0.45f, 1);
inline const ImVec4 kBadColor(0.95f, 0.45f, 0.4f, 1);
inline const ImVec4 kFaintColor(0.65f, 0.68f, 0.72f, 1);

/** A state older than this is not current, s. */
inline constexpr double kStateTimeout = 0.5;

/** Explains the previous control while the mouse is over it. */
void tooltip(const char* text);

/** A button with a tooltip. @return true if it was pressed. */
bool button(const char* label, const char* explanation);

/** Puts the next button on the same line if it fits. */
void same_line_if_fits(const char* next_label);

/** Sets the first position and size of the next panel, pixels. */
void place(float x, float y, float width, float height);

/** Begins a panel and registers the pixels that it covers. ImGui::End() must follow.
 * @return true if it is open (not collapsed). */
bool begin_panel(const char* title, PanelState& state);

/** Text in place of controls that need a bus. */
void show_no_commands();

}  // namespace nao::viewer
