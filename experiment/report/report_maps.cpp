#include "experiment/report/report_maps.h"

#include <algorithm>
#include <cmath>

#include "experiment/report/packed_array.h"
#include "experiment/report/report_page.h"
#include "experiment/surface/coarse_surface.h"

namespace overt {

namespace {

/// Bytes of all maps together, before base64; with more maps their meshes become coarser.
constexpr std::size_t most_map_bytes = 10'000'000;
constexpr std::size_t least_report_vertices = 4000;

double highest_of(const std::vector<float>& values) {
    return values.empty() ? 0.0 : static_cast<double>(*std::max_element(values.begin(), values.end()));
}

/// The mesh that the page shows of an object.
// NOLINTNEXTLINE(bugprone-exception-escape): JSON that is moved throws nothing
struct ShownMesh {
    std::vector<std::uint32_t> vertices; ///< of the study's mesh
    Json json;
};

ShownMesh shown_mesh(const StudyObject& object, std::size_t most_vertices) {
    ShownMesh shown;
    if (!object.mesh || object.mesh->triangles.empty())
        return shown;
    const Mesh& mesh = *object.mesh;
    const SurfaceGeometry geometry(mesh);
    const CoarseSurface coarse(geometry, most_vertices);
    std::vector<std::uint32_t> vertex_of_node(geometry.node_count(), 0);
    for (auto v = static_cast<std::uint32_t>(mesh.positions.size()); v-- > 0;)
        vertex_of_node[geometry.node_of(v)] = v;
    for (std::uint32_t v = 0; v < coarse.vertex_count(); ++v)
        shown.vertices.push_back(vertex_of_node[coarse.fine_node_of(v)]);
    // 16 bits between the bounds of the box.
    const Bounds bounds = mesh.bounds();
    std::vector<std::uint16_t> positions;
    for (const std::uint32_t v : shown.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            const double extent = bounds.extent()[axis];
            const double share =
                extent > 0.0 ? (static_cast<double>(mesh.positions[v][axis]) - bounds.min[axis]) / extent
                             : 0.0;
            positions.push_back(
                static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0))));
        }
    }
    std::vector<std::uint32_t> triangles;
    for (const glm::uvec3& t : coarse.mesh().triangles)
        triangles.insert(triangles.end(), {t.x, t.y, t.z});
    const bool is_small = shown.vertices.size() <= 65535;
    const std::vector<std::uint16_t> small_triangles(triangles.begin(),
                                                     is_small ? triangles.end() : triangles.begin());
    std::vector<std::uint8_t> visible;
    for (const std::uint32_t v : shown.vertices)
        visible.push_back(v < object.seconds_visible.size() && object.seconds_visible[v] <= 0.0f ? 0 : 1);
    shown.json = {{"vertices", shown.vertices.size()},
                  {"of", mesh.positions.size()},
                  {"low", json_of(bounds.min)},
                  {"high", json_of(bounds.max)},
                  {"positions", packed(positions)},
                  {"wide", !is_small},
                  {"triangles", is_small ? packed(small_triangles) : packed(triangles)},
                  {"visible", packed(visible)}};
    return shown;
}

// Values at the shown vertices as bytes from 0 to `most`.
std::string bytes_of(const std::vector<float>& values, const ShownMesh& shown, double most) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint32_t v : shown.vertices)
        bytes.push_back(static_cast<std::uint8_t>(
            std::lround(255.0 * std::clamp(most > 0.0 ? values[v] / most : 0.0, 0.0, 1.0))));
    return packed(bytes);
}

std::string signed_bytes_of(const std::vector<float>& values, const ShownMesh& shown, double most) {
    std::vector<std::int8_t> bytes;
    for (const std::uint32_t v : shown.vertices)
        bytes.push_back(static_cast<std::int8_t>(
            std::lround(127.0 * std::clamp(most > 0.0 ? values[v] / most : 0.0, -1.0, 1.0))));
    return packed(bytes);
}

Json json_of_maps(const StudyResults& results, const std::vector<ShownMesh>& shown) {
    Json maps = Json::array();
    for (const StudyMap& map : results.maps) {
        const ShownMesh& mesh = shown[static_cast<std::size_t>(map.object)];
        Json json{{"group", map.group},
                  {"object", map.object},
                  {"by", map.weighting == MapWeighting::duration ? "duration" : "count"},
                  {"peak", number(map.peak)},
                  {"mean", number(map.mean)},
                  {"total", number(map.total)},
                  {"observers", map.observers},
                  {"trials", map.trials},
                  {"fixations", map.fixations},
                  {"sigma", {number(map.least_sigma_mm, 4), number(map.most_sigma_mm, 4)}},
                  {"leak", number(map.euclidean_leak, 4)},
                  {"error",
                   {{"accuracy", number(map.error.accuracy_mm, 4)},
                    {"precision", number(map.error.precision_mm, 4)},
                    {"timing", number(map.error.timing_mm, 4)},
                    {"lut", number(map.error.lut_mm, 4)},
                    {"together", number(map.error.together_mm, 4)},
                    {"at_edge", number(map.error.at_edge, 4)},
                    {"near_edge", number(map.error.near_edge, 4)}}}};
        if (!map.density.empty() && !mesh.vertices.empty())
            json["values"] = bytes_of(map.density, mesh, map.peak);
        else
            json["absent"] = map.absent;
        maps.push_back(std::move(json));
    }
    return maps;
}

Json json_of_differences(const std::vector<DifferenceMap>& maps, const std::vector<ShownMesh>& shown) {
    Json differences = Json::array();
    for (const DifferenceMap& map : maps) {
        const ShownMesh& mesh = shown[static_cast<std::size_t>(map.object)];
        double most = 0.0;
        for (const float value : map.difference)
            most = std::max(most, std::abs(static_cast<double>(value)));
        Json clusters = Json::array();
        for (const DifferenceMap::Cluster& cluster : map.clusters)
            clusters.push_back(
                {{"area", number(cluster.area_mm2)},
                 {"mass", number(cluster.mass)},
                 {"difference", number(cluster.difference, 4)},
                 {"centre", json_of(cluster.centroid_mm)},
                 {"part", cluster.part ? Json(static_cast<int>(*cluster.part)) : Json(nullptr)},
                 {"p", number(cluster.p)},
                 {"p_all", number(cluster.p_of_all)},
                 {"tfce_p", number(cluster.free_p)}});
        Json json{{"keys", json_of(map.keys)},
                  {"object", map.object},
                  {"column", map.column},
                  {"a", map.a},
                  {"b", map.b},
                  {"most", number(most)},
                  {"threshold", number(map.threshold_t)},
                  {"least_p", number(map.least_p)},
                  {"tfce_least_p", number(map.free_least_p)},
                  {"tfce_area", number(map.free_area_mm2)},
                  {"observers", map.observers},
                  {"clusters", clusters}};
        if (!map.difference.empty() && !mesh.vertices.empty()) {
            json["values"] = signed_bytes_of(map.difference, mesh, most);
            std::vector<std::uint8_t> numbers;
            for (const std::uint32_t v : mesh.vertices)
                numbers.push_back(v < map.cluster.size()
                                      ? static_cast<std::uint8_t>(std::min<int>(map.cluster[v], 255))
                                      : 0);
            json["cluster"] = packed(numbers);
        } else {
            json["absent"] = map.absent;
        }
        differences.push_back(std::move(json));
    }
    return differences;
}

} // namespace

ReportMaps report_maps(const StudyResults& results) {
    const std::size_t maps = results.maps.size() + results.differences.size() + results.answer_maps.size();
    const std::size_t vertices = std::clamp(most_map_bytes / std::max<std::size_t>(1, maps),
                                            least_report_vertices, most_report_vertices);
    Json objects = Json::array();
    std::vector<ShownMesh> shown;
    for (const StudyObject& object : results.objects) {
        shown.push_back(shown_mesh(object, vertices));
        objects.push_back({{"id", object.id},
                           {"title", object.title},
                           {"parts", object.part_names},
                           {"camera", json_of(object.camera.position)},
                           {"target", json_of(object.camera.target)},
                           {"fov", object.camera.vertical_fov.value},
                           {"axis", json_of(object.axis_point)},
                           {"screen", {object.screen.screen_px.x, object.screen.screen_px.y}},
                           {"origin", {object.screen.image_origin_px.x, object.screen.image_origin_px.y}},
                           {"image", {object.screen.image_px.x, object.screen.image_px.y}},
                           {"px_per_deg", number(object.screen.px_per_deg_at_centre())},
                           {"mm_per_unit", number(object.mm_per_unit)},
                           {"shown_size", number(object.shown_size)},
                           {"remark", object.remark},
                           {"mesh", shown.back().json}});
        const ShownMesh& mesh = shown.back();
        const std::size_t vertex_count = object.mesh ? object.mesh->positions.size() : 0;
        if (mesh.vertices.empty())
            continue;
        if (object.exposure_density.size() == vertex_count) {
            const double most = highest_of(object.exposure_density);
            objects.back()["exposure"] = {{"most", number(most)},
                                          {"values", bytes_of(object.exposure_density, mesh, most)}};
        }
        if (object.seconds_visible.size() == vertex_count) {
            const double most = highest_of(object.seconds_visible);
            objects.back()["seconds"] = {{"most", number(most)},
                                         {"values", bytes_of(object.seconds_visible, mesh, most)}};
        }
    }
    return {std::move(objects), json_of_maps(results, shown), json_of_differences(results.differences, shown),
            json_of_differences(results.answer_maps, shown)};
}

} // namespace overt
