/// The areas of a mesh that is painted, and the file that they are kept in.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "experiment/scene/making/area_painting.h"
#include "experiment/stimulus/object.h"

namespace overt {

/// Colours that are told apart also without seeing red or green (Okabe and Ito 2008), in turn, by paint
/// from 1.
glm::vec3 colour_of_paint(AreaPainting::Paint paint);

struct PaintedAreas {
    std::vector<std::string> names; ///< paint i is names[i - 1]
    AreaPainting painting;

    /// Of a mesh with the areas that it has, and `more` beside them. Throws InputError for a name that no
    /// area can have, for none, and for too many.
    PaintedAreas(const Mesh& mesh, const std::vector<std::string>& more);

    /// The paint of an area. Throws InputError if there is none of that name.
    AreaPainting::Paint paint_of(const std::string& name) const;
    /// "rim 12.0 %, foot 3.4 %, the rest 84.6 % of the surface".
    std::string shares() const;
};

/// The labels of the mesh file's own triangles, in its order, as `labels` of an object takes them: each has
/// that of the object's triangle at its middle. Throws as read_mesh_file does.
std::string labels_text(const PaintedAreas& areas, const Object& object, const ObjectSettings& settings);

} // namespace overt
