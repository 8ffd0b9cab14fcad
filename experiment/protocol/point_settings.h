/// Places on the surfaces of objects, and the marks that are drawn there, as a protocol states them.
/// Explained key by key in point_keys.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"

namespace overt {

/// [[points]]: a list of places, made in one of four ways. Their names are "ID.1", "ID.2", ...
struct PointListSettings {
    std::string id;
    std::string object;                         ///< an id; empty: each object has a list, made alike
    std::optional<int> evenly;                  ///< so many, spread evenly over the surface by its area
    std::string area;                           ///< of evenly: only there; empty: the whole surface
    std::optional<double> facing_deg;           ///< of evenly: only what is seen, see `frame`
    int frame = 0;                              ///< of the first motion, in the first view
    int seed = 1;                               ///< of evenly
    std::vector<double> vertices;               ///< whole numbers, from 0
    std::vector<std::array<double, 3>> places;  ///< triangle, and the weights of its first two corners
    std::vector<std::array<double, 3>> near_mm; ///< each the nearest place of the surface

    /// How many there are of each object; known without its mesh.
    int count() const {
        return evenly.value_or(static_cast<int>(vertices.size() + places.size() + near_mm.size()));
    }
    std::string name_of(int index) const { return id + "." + std::to_string(index + 1); }
};

enum class ProbeMark : std::uint8_t { dot, ring, none };
template <> inline constexpr auto names_of<ProbeMark> = enum_names<ProbeMark>("dot", "ring", "none");

/// [[task.probe]]: a mark that follows a place of the surface. Which place differs from trial to trial: it is
/// a factor of the trial's own, by the probe's id.
struct ProbeSettings {
    std::string id;
    std::string points; ///< id of a list
    std::string slot;   ///< an id; empty: the task's only one
    ProbeMark mark = ProbeMark::dot;
    double size_deg = 0.25; ///< its diameter; of a ring to the middle of its line
    double line_deg = 0.06; ///< of a ring
    std::array<double, 3> light{1.0, 0.1, 0.1};
    double rim_deg = 0.03;
};

} // namespace overt
