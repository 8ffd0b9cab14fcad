#include "experiment/scene/areas.h"

#include <algorithm>

namespace overt {

namespace {

/// Rounding of sums over triangles.
constexpr double all_of_an_area = 1.0 - 1e-9;

} // namespace

std::vector<std::string_view> areas_of_part(std::string_view part_name) {
    std::vector<std::string_view> areas;
    for (;;) {
        const std::size_t end = part_name.find(between_areas);
        areas.push_back(part_name.substr(0, end));
        if (end == part_name.npos)
            return areas;
        part_name.remove_prefix(end + 1);
    }
}

bool part_is_in_area(std::string_view part_name, std::string_view area) {
    const std::vector<std::string_view> areas = areas_of_part(part_name);
    return std::ranges::find(areas, area) != areas.end();
}

std::string_view usual_area(std::span<const std::string> names) {
    if (std::ranges::find(names, head_area) != names.end())
        return head_area;
    const auto named = std::ranges::find_if(names, [](auto& name) { return name != rest_part; });
    return named != names.end() ? *named : names.empty() ? std::string_view() : names.front();
}

Areas::Areas(std::span<const std::string> part_names) {
    if (part_names.size() == 1 && part_names.front() == rest_part)
        return;
    for (std::size_t part = 0; part < part_names.size(); ++part) {
        for (const std::string_view name : areas_of_part(part_names[part])) {
            const auto at = std::ranges::find(names_, name) - names_.begin();
            if (at == std::ssize(names_)) {
                names_.emplace_back(name);
                members_.emplace_back(part_names.size(), false);
            }
            members_[static_cast<std::size_t>(at)][part] = true;
        }
    }
}

std::optional<std::size_t> Areas::find(std::string_view name) const {
    const auto found = std::ranges::find(names_, name);
    return found == names_.end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(found - names_.begin()));
}

std::vector<AreaOverlap> overlapping_areas(const Mesh& mesh) {
    const Areas areas(mesh.part_names);
    const std::vector<double> sizes = mesh.part_areas();
    const auto size_of = [&](std::size_t a, std::size_t b) {
        double sum = 0.0;
        for (std::size_t part = 0; part < sizes.size(); ++part) {
            const auto index = static_cast<PartIndex>(part);
            sum += areas.holds(a, index) && areas.holds(b, index) ? sizes[part] : 0.0;
        }
        return sum;
    };
    std::vector<AreaOverlap> overlaps;
    for (std::size_t a = 0; a < areas.size(); ++a) {
        for (std::size_t b = a + 1; b < areas.size(); ++b) {
            const double shared = size_of(a, b), of_a = size_of(a, a), of_b = size_of(b, b);
            if (shared > 0.0 && shared < all_of_an_area * std::min(of_a, of_b))
                overlaps.push_back(
                    {areas.names()[a], areas.names()[b], shared, shared / of_a, shared / of_b});
        }
    }
    return overlaps;
}

} // namespace overt
