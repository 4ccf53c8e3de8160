#pragma once

#include "tools/vision-dataset/random_scene.h"

namespace nao::vision {

/** Places the camera so that it looks at the thing of a kind other than kMixed, and adds that thing
 * and the ball. */
void add_hard_objects(RandomScene& scene, const RobotModel& model, const SceneFile& file,
                      SceneKind kind, Random& random);

/** Glare, too much or too little light, for the kinds that have it. After ImageEffects::vary(). */
void vary_exposure(RandomScene& scene, SceneKind kind, Random& random);

}  // namespace nao::vision
