#pragma once

#include <tinyxml.h>

#include "robot_import/repair_log.h"

namespace nao {

/** Sum of the distances of the joints from the root to the farthest link, m. */
double measure_chain(const TiXmlElement& robot);

/** Converts to URDF's units what can only be meant in others: ranges and rotations in degrees,
 * lengths in millimetres, masses in grams. Each is reported. */
void repair_units(TiXmlElement& robot, RepairLog& log);

/** Factor that brings a mesh to metres: 0.001 for one that is far larger than the robot, 1000 for
 * one that is far smaller, otherwise 1.
 * @param extent  Diagonal of the box about the mesh with the scale of the file, m.
 * @param chain   measure_chain() of the robot, m; 0: not known. */
double mesh_unit(double extent, double chain);

}  // namespace nao
