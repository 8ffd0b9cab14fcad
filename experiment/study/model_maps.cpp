#include "experiment/study/model_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/scene/files/vertex_values.h"

namespace overt {

namespace {

/// Finds the nearest of many points within a reach.
class PointGrid {
  public:
    PointGrid(const std::vector<glm::dvec3>& points, double scale, double reach)
        : points_(points), scale_(scale), reach_(reach) {
        for (std::uint32_t i = 0; i < points.size(); ++i)
            cells_[key(cell_of(scale * points[i]))].push_back(i);
    }

    std::optional<std::uint32_t> nearest(const glm::dvec3& place) const {
        const glm::ivec3 middle = cell_of(place);
        double least = reach_ * reach_;
        std::optional<std::uint32_t> found;
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) {
                for (int z = -1; z <= 1; ++z) {
                    const auto cell = cells_.find(key(middle + glm::ivec3(x, y, z)));
                    if (cell == cells_.end())
                        continue;
                    for (const std::uint32_t i : cell->second) {
                        const glm::dvec3 off = scale_ * points_[i] - place;
                        if (glm::dot(off, off) < least) {
                            least = glm::dot(off, off);
                            found = i;
                        }
                    }
                }
            }
        }
        return found;
    }

  private:
    glm::ivec3 cell_of(const glm::dvec3& place) const { return glm::ivec3(glm::floor(place / reach_)); }
    static std::uint64_t key(const glm::ivec3& cell) {
        constexpr std::uint64_t mask = (1u << 21u) - 1;
        return (static_cast<std::uint64_t>(cell.x) & mask) << 42u |
               (static_cast<std::uint64_t>(cell.y) & mask) << 21u |
               (static_cast<std::uint64_t>(cell.z) & mask);
    }

    const std::vector<glm::dvec3>& points_;
    double scale_, reach_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// The file's numbers by node of a surface, its lengths times `scale` being millimetres; nothing if it is of
/// another shape, or lies elsewhere.
std::optional<std::vector<double>> on_surface(const VertexValues& model, const SurfaceGeometry& surface,
                                              double scale) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& place : surface.node_positions_mm()) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const double diagonal = glm::length(high - low);
    if (!(diagonal > 0.0))
        return std::nullopt;
    const PointGrid grid(model.positions, scale, 0.02 * diagonal);
    std::vector<double> by_node;
    std::size_t found = 0;
    for (const glm::dvec3& place : surface.node_positions_mm()) {
        const std::optional<std::uint32_t> nearest = grid.nearest(place);
        found += nearest.has_value();
        by_node.push_back(nearest ? model.values[*nearest] : 0.0);
        if (by_node.size() - found > surface.node_count() / 50)
            return std::nullopt;
    }
    return by_node;
}

} // namespace

std::vector<ModelMap> model_maps(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                 const StudyOptions& options) {
    std::vector<ModelMap> maps;
    for (const ModelFile& file : options.models) {
        const VertexValues model = read_vertex_values(file.file);
        if (std::ranges::any_of(model.values, [](double value) { return value < 0.0; }) ||
            std::ranges::all_of(model.values, [](double value) { return value == 0.0; }))
            throw InputError(
                fmt::format("--model {}: {} has numbers below 0, or all are 0: give how probable gaze is "
                            "at each vertex, per area and on any scale.",
                            file.file.string(), model.property));
        std::vector<std::string> names;
        bool is_known = file.object.empty(), fits = false;
        for (std::size_t i = 0; i < results.objects.size(); ++i) {
            const StudyObject& object = results.objects[i];
            names.push_back(object.id);
            if (!file.object.empty() && object.id != file.object)
                continue;
            is_known = true;
            if (!surfaces[i].geometry || !object.mm_per_unit)
                continue;
            auto by_node = on_surface(model, *surfaces[i].geometry, 1.0);
            if (!by_node)
                by_node = on_surface(model, *surfaces[i].geometry, *object.mm_per_unit);
            if (!by_node)
                continue;
            fits = true;
            maps.push_back({file.file.stem().string(), static_cast<int>(i), std::move(*by_node)});
        }
        if (!is_known)
            throw InputError(fmt::format("--model {}={}: there is no such object; there are {}.", file.object,
                                         file.file.string(), fmt::join(names, ", ")));
        if (!fits)
            throw InputError(
                fmt::format("--model {}: its vertices do not lie on the surface of {}. Reckon the model on "
                            "the mesh that overt "
                            "analyze --meshes writes, which has the object's own place and millimetres.",
                            file.file.string(), file.object.empty() ? "any object" : file.object));
    }
    return maps;
}

} // namespace overt
