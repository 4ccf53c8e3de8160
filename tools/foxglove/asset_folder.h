#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace nao::foxglove {

/** The robot's files that clients may read: its URDF as "robot.urdf", and what lies beside it, such
 * as "meshes/Head.glb". No other file of the host can be read. */
class AssetFolder {
 public:
  /** @param folder  Of the robot: robots/NAME. @param urdf_file  In that folder. */
  AssetFolder(const std::filesystem::path& folder, const std::filesystem::path& urdf_file);

  /** A file by its path in the folder. @return null if there is none, or it may not be read. */
  std::shared_ptr<const std::string> read(std::string_view path);
  /** A file by a URI "package://robot/PATH". @return null as above. */
  std::shared_ptr<const std::string> read_uri(std::string_view uri);

 private:
  std::filesystem::path folder_;
  std::filesystem::path urdf_file_;
  /** Content of the files that were read, by path: clients request all meshes at once. */
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> files_;
};

/** Content type of a file by its name. */
std::string content_type(std::string_view path);

}  // namespace nao::foxglove
