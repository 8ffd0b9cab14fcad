#include "experiment/scene/sculptures/sculptures.h"

#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/scene/sculptures/contouring.h"
#include "experiment/scene/sculptures/figures.h"

namespace overt {

namespace {

constexpr std::array<SculptureDescription, 3> descriptions{
    {{"muse", "Muse", "A young woman in a long robe and a cloak, her right hand raised to her breast."},
     {"runner", "Runner", "A young man who bends to fasten his sandal, his head far to one side."},
     {"scholar", "Scholar", "A bearded man in a cloak that leaves his chest bare, a scroll in his hand."}}};

/// Height that cell_share refers to, mm.
constexpr double nominal_height_mm = 600.0;

Figure model(std::string_view name) {
    if (name == "muse")
        return model_muse();
    if (name == "runner")
        return model_runner();
    if (name == "scholar")
        return model_scholar();
    std::vector<std::string_view> names;
    for (const SculptureDescription& description : descriptions)
        names.push_back(description.name);
    throw InputError(
        fmt::format("There is no sculpture named “{}”; those shipped are {}.", name, fmt::join(names, ", ")));
}

/// Turns the surface into a mesh about the axis through the middle of its box, standing on z = 0.
Mesh mesh_of(const ClosedSurface& surface) {
    Bounds box{surface.positions.front(), surface.positions.front()};
    for (const glm::dvec3& position : surface.positions) {
        box.min = glm::min(box.min, position);
        box.max = glm::max(box.max, position);
    }
    const glm::dvec3 origin(box.centre().x, box.centre().y, box.min.z);
    Mesh mesh;
    mesh.part_names = {"head", "body", "plinth"};
    mesh.triangles = surface.triangles;
    mesh.positions.reserve(surface.positions.size());
    for (const glm::dvec3& position : surface.positions)
        mesh.positions.emplace_back(position - origin);
    return mesh;
}

} // namespace

std::span<const SculptureDescription> shipped_sculptures() { return descriptions; }

Mesh make_sculpture(std::string_view name, double cell_share, int threads) {
    if (!(cell_share >= 0.001 && cell_share <= 0.05))
        throw InputError(
            fmt::format("A sculpture's cell share must be from 0.001 to 0.05, not {}.", cell_share));
    const Figure figure = model(name);
    const Clay whole = figure.whole();
    ContourRequest request;
    request.distance = [&](const glm::dvec3& point) { return whole.distance(point); };
    request.cell_mm = cell_share * figure.cell_factor * nominal_height_mm;
    request.box_mm = {whole.ball().centre - whole.ball().radius, whole.ball().centre + whole.ball().radius};
    request.box_mm = {glm::max(request.box_mm.min, figure.box_mm.min) - 2.0 * request.cell_mm,
                      glm::min(request.box_mm.max, figure.box_mm.max) + 2.0 * request.cell_mm};
    request.fovea = figure.fovea;
    request.threads = threads;
    const ClosedSurface surface = contour(request);

    Mesh mesh = mesh_of(surface);
    mesh.triangle_parts.resize(surface.triangles.size());
    constexpr std::size_t per_turn = 4096;
    const auto label = [&](int turn) {
        const std::size_t first = static_cast<std::size_t>(turn) * per_turn;
        for (std::size_t i = first; i < std::min(surface.triangles.size(), first + per_turn); ++i) {
            const glm::uvec3 t = surface.triangles[i];
            const glm::dvec3 sum = surface.positions[t.x] + surface.positions[t.y] + surface.positions[t.z];
            mesh.triangle_parts[i] = figure.part_at(sum / 3.0);
        }
    };
    parallel_for(static_cast<int>((surface.triangles.size() + per_turn - 1) / per_turn), label, threads);
    return mesh;
}

} // namespace overt
