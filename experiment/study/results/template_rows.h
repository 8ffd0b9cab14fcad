/// Objects whose gaze is brought to the surface of one of them: the template.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/base/diagnostics.h"

namespace overt {

/// A place of an object that corresponds to those of the same name on other objects.
struct Landmark {
    std::string object; ///< id
    std::string name;
    glm::dvec3 place_mm{0.0}; ///< in the object's own millimetres, on its surface or not
};

/// Reads landmarks from a table with commas under a line of names: object, landmark, x_mm, y_mm, z_mm. A cell
/// may stand in double quotes, without commas in it. Findings go to `diagnostics` with their places.
std::vector<Landmark> read_landmarks(const std::filesystem::path& file, Diagnostics& diagnostics);

/// Which object is the template, and by which places others are brought to it.
struct TemplateChoice {
    std::string object;              ///< id of the template; empty: there is none, and each object is its own
    std::vector<std::string> lists;  ///< ids of the protocol's [[points]] whose places correspond, by number
    std::vector<Landmark> landmarks; ///< given beside or in place of these
    std::string file;                ///< that has them; empty: none
};

/// How well an object's surface was brought to the template's. Lengths are the template's own millimetres.
struct TemplateFitRow {
    int object = 0; ///< index into StudyResults::objects
    int landmarks = 0;
    std::string warp;                  ///< "thin plate", "similarity", or "the same surface"
    double scale = 1.0;                ///< how much longer things become
    std::optional<double> left_out_mm; ///< see LandmarkWarp::left_out
    double away_mm = 0.0; ///< of its surface from the template before it is laid onto it: mean over the area
    double turned_share = 0.0; ///< of its area that comes to lie on a surface that faces the other way
    std::optional<double> gaze_away_mm; ///< as away_mm, mean over the counted fixations
    int fixations = 0;                  ///< counted
};

} // namespace overt
