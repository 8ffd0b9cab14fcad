#include "experiment/study/read/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// What one pose's picture shows.
struct PoseExposure {
    std::vector<float> pixels; ///< by vertex: those whose triangle has it, a third each
    std::vector<bool> visible; ///< by vertex
    std::vector<double> part_pixels;
};

/// By vertex: the largest cosine between the line of sight and the normal of a triangle that has it; 0 where
/// none faces the camera.
std::vector<float> facing(const Mesh& mesh, const glm::dvec3& eye) {
    std::vector<float> cosines(mesh.positions.size(), 0.0f);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double along = glm::dot(normal, eye - a);
        if (!(along > 0.0))
            continue;
        const auto cosine = static_cast<float>(along / (glm::length(normal) * glm::length(eye - a)));
        for (int corner = 0; corner < 3; ++corner)
            cosines[t[corner]] = std::max(cosines[t[corner]], cosine);
    }
    return cosines;
}

/// The depth at which a line of sight meets a triangle's plane, no nearer and no farther than its corners.
double depth_along(const SightLines& lines, const Mesh& mesh, const glm::uvec3& t,
                   const glm::dvec3& direction) {
    std::array<glm::dvec3, 3> corners;
    double least = 0.0, most = 0.0;
    for (int k = 0; k < 3; ++k) {
        corners[static_cast<std::size_t>(k)] = mesh.positions[t[k]];
        const double depth = lines.project(corners[static_cast<std::size_t>(k)]).z;
        least = k == 0 ? depth : std::min(least, depth);
        most = k == 0 ? depth : std::max(most, depth);
    }
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double along = glm::dot(normal, direction);
    if (along == 0.0)
        return most;
    return std::clamp(glm::dot(normal, corners[0] - lines.origin()) / along, least, most);
}

/// Whether the map shows a vertex's place, or one beside it, no nearer than the vertex. Where the surface is
/// seen obliquely, its depth changes by more from one pixel to the next.
bool shows_vertex(const CoordinateMaps& maps, PoseIndex pose, const glm::dvec3& position, double cosine) {
    const SightLines& lines = maps.sight_lines(pose);
    const glm::dvec3 seen = lines.project(position);
    const glm::ivec2 size = maps.image_px();
    if (!(seen.z > 0.0) || seen.x < 0.0 || seen.y < 0.0 || seen.x >= size.x || seen.y >= size.y)
        return false;
    const glm::ivec2 pixel(glm::floor(glm::dvec2(seen)));
    const glm::dvec3 direction = (position - lines.origin()) / seen.z;
    constexpr double steepest = 10.0;
    const double slope = std::min(std::sqrt(1.0 - cosine * cosine) / cosine, steepest);
    const double farthest = seen.z - 2.0 * (1.0 + slope) * lines.pixel_width_at(seen.z);
    constexpr std::array<glm::ivec2, 5> offsets{glm::ivec2{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const glm::ivec2& offset : offsets) {
        const glm::ivec2 at = pixel + offset;
        if (!maps.cells(pose).is_inside(at))
            continue;
        const PixelCell cell = maps.cells(pose).cell(at);
        if (cell.is_covered())
            return depth_along(lines, maps.mesh(), maps.mesh().triangles[cell.triangle()], direction) >=
                   farthest;
    }
    return false;
}

PoseExposure exposure_of_pose(const CoordinateMaps& maps, PoseIndex pose) {
    const Mesh& mesh = maps.mesh();
    PoseExposure found{std::vector<float>(mesh.positions.size(), 0.0f),
                       std::vector<bool>(mesh.positions.size(), false),
                       std::vector<double>(mesh.part_names.size(), 0.0)};
    const PoseCells& cells = maps.cells(pose);
    const glm::ivec2 size = maps.image_px();
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const PixelCell cell = cells.cell({x, y});
            if (!cell.is_covered())
                continue;
            const glm::uvec3& corners = mesh.triangles[cell.triangle()];
            for (int corner = 0; corner < 3; ++corner)
                found.pixels[corners[corner]] += 1.0f / 3.0f;
            found.part_pixels[mesh.triangle_parts[cell.triangle()]] += 1.0;
        }
    }
    const std::vector<float> cosines = facing(mesh, maps.sight_lines(pose).origin());
    for (std::size_t v = 0; v < found.visible.size(); ++v)
        found.visible[v] = found.pixels[v] > 0.0f ||
                           (cosines[v] > 0.0f && shows_vertex(maps, pose, glm::dvec3(mesh.positions[v]),
                                                              static_cast<double>(cosines[v])));
    return found;
}

} // namespace

Exposure exposure_of(const CoordinateMaps& maps, std::span<const double> seconds) {
    const std::size_t vertices = maps.mesh().positions.size();
    Exposure exposure{std::vector<float>(vertices, 0.0f), std::vector<double>(vertices, 0.0),
                      std::vector<double>(maps.mesh().part_names.size(), 0.0)};
    // A few poses at a time: what each gives is added in their order.
    constexpr std::size_t at_a_time = 8;
    for (std::size_t begin = 0; begin < seconds.size(); begin += at_a_time) {
        std::vector<PoseExposure> found(std::min(at_a_time, seconds.size() - begin));
        parallel_for(static_cast<int>(found.size()), [&](int i) {
            const std::size_t pose = begin + static_cast<std::size_t>(i);
            if (seconds[pose] > 0.0)
                found[static_cast<std::size_t>(i)] =
                    exposure_of_pose(maps, PoseIndex{static_cast<int>(pose)});
        });
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double lit = seconds[begin + i];
            for (std::size_t v = 0; v < found[i].pixels.size(); ++v) {
                exposure.seconds_visible[v] += found[i].visible[v] ? static_cast<float>(lit) : 0.0f;
                exposure.pixel_seconds[v] += lit * static_cast<double>(found[i].pixels[v]);
            }
            for (std::size_t part = 0; part < found[i].part_pixels.size(); ++part)
                exposure.part_pixel_seconds[part] += lit * found[i].part_pixels[part];
        }
    }
    return exposure;
}

std::vector<ExposureRow> exposure_rows(const AreaExposure& of, int object, const Areas& areas) {
    struct Sum {
        double area = 0.0, never = 0.0, seconds = 0.0, pixels = 0.0; ///< mm^2, mm^2, mm^2 s, px s
    };
    std::vector<Sum> parts(of.mesh.part_names.size());
    Sum all;
    const double mm2 = of.mm_per_unit * of.mm_per_unit;
    for (std::size_t i = 0; i < of.mesh.triangles.size(); ++i) {
        const glm::uvec3& t = of.mesh.triangles[i];
        const glm::dvec3 a(of.mesh.positions[t.x]), b(of.mesh.positions[t.y]), c(of.mesh.positions[t.z]);
        const double third = 0.5 * glm::length(glm::cross(b - a, c - a)) * mm2 / 3.0;
        Sum& part = parts[of.mesh.triangle_parts[i]];
        for (int corner = 0; corner < 3; ++corner) {
            const auto visible = static_cast<double>(of.exposure.seconds_visible[t[corner]]);
            for (Sum* sum : {&part, &all}) {
                sum->area += third;
                sum->never += visible > 0.0 ? 0.0 : third;
                sum->seconds += third * visible;
            }
        }
    }
    for (std::size_t part = 0; part < parts.size(); ++part)
        all.pixels += parts[part].pixels = of.exposure.part_pixel_seconds[part];
    const auto row_of = [&](const std::string& name, const Sum& sum) {
        ExposureRow row;
        row.object = object;
        row.area = name;
        row.area_mm2 = sum.area;
        row.share_of_area = all.area > 0.0 ? sum.area / all.area : 0.0;
        row.never_visible = sum.area > 0.0 ? sum.never / sum.area : 0.0;
        row.seconds_visible = sum.area > 0.0 ? sum.seconds / sum.area : 0.0;
        row.share_of_exposure = all.pixels > 0.0 ? sum.pixels / all.pixels : 0.0;
        if (sum.seconds > 0.0)
            row.foreshortening = sum.pixels * of.px_mm2 / sum.seconds;
        return row;
    };
    std::vector<ExposureRow> rows{row_of({}, all)};
    for (std::size_t area = 0; area < areas.size(); ++area) {
        Sum sum;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            if (!areas.holds(area, static_cast<PartIndex>(part)))
                continue;
            sum.area += parts[part].area;
            sum.never += parts[part].never;
            sum.seconds += parts[part].seconds;
            sum.pixels += parts[part].pixels;
        }
        rows.push_back(row_of(areas.names()[area], sum));
    }
    return rows;
}

} // namespace overt
