#pragma once

#include <tinyxml.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** Numbers of an attribute such as "0 0 1". @return Nothing unless they are `count` finite ones. */
std::optional<std::vector<double>> read_numbers(const TiXmlElement& element, const char* name,
                                                size_t count);
/** The numbers of an attribute that read_numbers() refuses, in a form that it reads: with commas or
 * semicolons between them, with decimal commas, or one number for all. @return Empty: it is none.
 */
std::string repaired_numbers(const TiXmlElement& element, const char* name, size_t count);
double read_number(const TiXmlElement& element, const char* name, double otherwise);

/** The `origin` of an element; the identity if it has none. */
Eigen::Isometry3d read_origin(const TiXmlElement& parent);
void write_origin(TiXmlElement& parent, const Eigen::Isometry3d& pose);

/** Moment of inertia of a ball of water, which stands for a link whose inertia is not known, kg
 * m^2.
 * @param mass  kg. */
double ball_moment(double mass);

/** <inertial> of such a link. @param mass  kg. */
TiXmlElement make_inertial(double mass);

std::string to_text(const TiXmlDocument& document);
/** Twelve digits. */
std::string to_text(double number);
std::string to_text(const Eigen::Vector3d& vector);

}  // namespace nao
