/// The named areas of an object's surface, which may lie in one another, beside one another, or overlap.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/scene/mesh.h"

namespace overt {

/// Name of the area that is shown first where an object has it: the paper's.
inline constexpr std::string_view head_area = "head";

/// Name of what no area takes.
inline constexpr std::string_view rest_part = "body";

/// Stands between the areas in the name of a part.
inline constexpr char between_areas = '/';

/// Which areas there are, and which parts belong to each. A triangle has one part: all triangles that belong
/// to the same areas are one, and its name is theirs, the largest first: "head/eyes" belongs to "head" and to
/// "eyes". So meshes, maps and look-ups have a byte for each place, and whoever asks for areas asks for its
/// part's.
class Areas {
  public:
    Areas() = default;
    /// By the names of all parts, in their order. A surface of which all is rest_part has no areas.
    explicit Areas(std::span<const std::string> part_names);

    /// Each once, in the order in which the parts name them first.
    const std::vector<std::string>& names() const { return names_; }
    std::size_t size() const { return names_.size(); }
    bool empty() const { return names_.empty(); }

    /// Index into names(); nothing if there is no such area.
    std::optional<std::size_t> find(std::string_view name) const;
    bool has(std::string_view name) const { return find(name).has_value(); }

    /// Whether the part belongs to the area; no part belongs to none.
    bool holds(std::size_t area, std::optional<PartIndex> part) const {
        return part && area < members_.size() && *part < members_[area].size() && members_[area][*part];
    }

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<bool>> members_; ///< by area and PartIndex
};

/// The areas that a part of that name belongs to.
std::vector<std::string_view> areas_of_part(std::string_view part_name);
/// Whether it is one of them; the rest of a surface counts as an area here, too.
bool part_is_in_area(std::string_view part_name, std::string_view area);

/// Of names of areas: "head" if it is there, else the first that is not the rest of the surface, else the
/// first; empty if there are none.
std::string_view usual_area(std::span<const std::string> names);

/// Two areas that have triangles in common, while neither holds the other.
struct AreaOverlap {
    std::string a, b;
    double shared_area = 0.0; ///< in the square of the mesh's unit
    double share_of_a = 0.0, share_of_b = 0.0;
};
std::vector<AreaOverlap> overlapping_areas(const Mesh& mesh);

} // namespace overt
