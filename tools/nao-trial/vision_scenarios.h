#pragma once

namespace nao::trial {

/** Adds the scenarios that need OpenCV or the renderer. */
void add_vision_scenarios();

}  // namespace nao::trial
