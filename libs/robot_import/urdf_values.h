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

/** An attribute; empty if the element does not have it. */
std::string text_of(const TiXmlElement& element, const char* name);
/** "joint LKneePitch", as findings name elements. */
std::string title_of(const TiXmlElement& element);
/** The link at an end of a joint, "parent" or "child"; empty if the joint names none. */
std::string link_of(const TiXmlElement& joint, const char* end);
/** kg; 0 if the link states none. */
double mass_of(const TiXmlElement& link);
/** The first child of this name, which is added if there is none. */
TiXmlElement& find_or_add(TiXmlElement& parent, const char* name);

/** The `origin` of an element; the identity if it has none. */
Eigen::Isometry3d read_origin(const TiXmlElement& parent);
void write_origin(TiXmlElement& parent, const Eigen::Isometry3d& pose);
/** Roll, pitch and yaw, rad, of R = Rz(yaw) Ry(pitch) Rx(roll), URDF's order. */
Eigen::Vector3d to_rpy(const Eigen::Matrix3d& rotation);

/** Moment of inertia of a ball of water, which stands for a link whose inertia is not known, kg
 * m^2.
 * @param mass  kg. */
double ball_moment(double mass);

/** Writes one moment about all axes through the center of mass, kg m^2. */
void set_moment(TiXmlElement& inertia, double moment);

/** <inertial> of such a link. @param mass  kg. */
TiXmlElement make_inertial(double mass);

std::string to_text(const TiXmlDocument& document);
/** Twelve digits. */
std::string to_text(double number);
std::string to_text(const Eigen::Vector3d& vector);

}  // namespace nao
