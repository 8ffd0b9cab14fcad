/// Materials beside OBJ files (.mtl).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiment/scene/surface_appearance.h"

namespace overt {

/// What .mtl files say, for one mesh.
class MtlLibrary {
  public:
    /// `appearance` gets the pictures that materials need, each once, and remarks; it must outlive the
    /// library.
    explicit MtlLibrary(SurfaceAppearance& appearance) : appearance_(&appearance) {}

    /// Reads a file, whose pictures lie in its folder or below. Kd is linear, and a factor on map_Kd; norm is
    /// a picture of normals; Pr is roughness and Pm the share of metal; without Pr, Ns is what Blinn and
    /// Phong have, taken as the GGX alpha sqrt(2 / (Ns + 2)) (Walter et al. 2007). Throws InputError with
    /// line and column.
    void read(const std::filesystem::path& file);

    /// The names of what was read beside the mesh, in that order.
    const std::vector<std::string>& files() const { return files_; }

    /// Null if no file has one of that name; the first that was read counts.
    const FileMaterial* find(const std::string& name) const;

  private:
    class Reader;

    SurfaceAppearance* appearance_;
    std::map<std::string, FileMaterial> materials_;
    std::map<std::filesystem::path, int> pictures_;
    std::vector<std::string> files_;
};

} // namespace overt
