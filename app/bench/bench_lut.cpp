#include <algorithm>
#include <array>
#include <chrono>

#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "app/cli/resident_memory.h"
#include "app/stimuli/map_figures.h"
#include "experiment/base/error.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/gl/headless_context.h"
#include "render/gl/pixel_readback.h"
#include "render/stimulus/coordinate_pass.h"

namespace overt {

namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

double milliseconds_since(SteadyTime begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The maps of all poses of an object, and how long each took to draw and read back.
struct DrawnMaps {
    std::vector<TriangleMap> maps;
    std::vector<double> times_ms;
};

DrawnMaps draw_all(const GlContext& context, const Object& object, const PoseTable& poses) {
    const glm::ivec2 size = object.scene().view.image_px;
    CoordinatePass pass(context, size);
    const MeshBuffers buffers(context, object.mesh);
    pass.draw(buffers, object.scene(), poses.angles.front()); // the first also sets things up
    DrawnMaps drawn;
    for (const ObjectPose& angle : poses.angles) {
        const SteadyTime begin = std::chrono::steady_clock::now();
        drawn.maps.push_back({size, pass.draw(buffers, object.scene(), angle)});
        drawn.times_ms.push_back(milliseconds_since(begin));
    }
    return drawn;
}

/// Maps per second when the next is drawn while the last is read back, as in a presentation.
double maps_per_second(const GlContext& context, const Object& object, const PoseTable& poses) {
    const glm::ivec2 size = object.scene().view.image_px;
    CoordinatePass pass(context, size);
    const MeshBuffers buffers(context, object.mesh);
    std::array<PixelReadback, 2> reads{PixelReadback(context, size, PixelFormat::r32ui),
                                       PixelReadback(context, size, PixelFormat::r32ui)};
    TriangleMap map{size, {}};
    map.codes.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const auto bytes = std::as_writable_bytes(std::span(map.codes));
    // A graphics processor needs more of them for a time worth measuring.
    const int count = context.description().is_software ? 12 : 600;
    const SteadyTime begin = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
        PixelReadback& read = reads[static_cast<std::size_t>(i % 2)];
        if (read.under_way())
            read.finish(bytes, true);
        const ObjectPose& angle = poses.angles[static_cast<std::size_t>(i) % poses.angles.size()];
        pass.render(buffers, clip_from_centred_object(object.scene(), angle));
        read.start(pass.target());
    }
    for (PixelReadback& read : reads)
        read.finish(bytes, true);
    return 1e3 * count / milliseconds_since(begin);
}

/// Pixels that OSMesa and EGL show differently, in all poses; nothing where EGL is no software.
std::optional<std::size_t> pixels_that_differ(const Object& object, const PoseTable& poses) {
    std::vector<DrawnMaps> drawn;
    for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl}) {
        try {
            const auto context = make_headless_context(kind);
            if (!context->description().is_software)
                return std::nullopt;
            drawn.push_back(draw_all(*context, object, poses));
        } catch (const GraphicsError&) {
            return std::nullopt;
        }
    }
    std::size_t differ = 0;
    for (std::size_t pose = 0; pose < poses.angles.size(); ++pose) {
        const auto &one = drawn[0].maps[pose].codes, &other = drawn[1].maps[pose].codes;
        for (std::size_t i = 0; i < one.size(); ++i)
            differ += one[i] != other[i];
    }
    return differ;
}

void measure_drawing(BenchFigures& figures, const GlContext& context, const Object& object,
                     const PoseTable& poses, const DrawnMaps& drawn) {
    const auto figure = [&](const char* what) { return object.id + ", " + what; };
    const auto triangles = static_cast<double>(object.mesh->triangles.size());
    figures.push_back({figure("triangles"), triangles, "triangles"});
    figures.push_back({figure("draw and read back a map, least"),
                       *std::min_element(drawn.times_ms.begin(), drawn.times_ms.end()), "ms"});
    figures.push_back({figure("draw and read back a map, median"), median(drawn.times_ms), "ms"});
    const double rate = maps_per_second(context, object, poses);
    const std::string name = figure("maps drawn and read back");
    figures.push_back(context.description().is_software ? BenchFigure{name, rate, "1/s"}
                                                        : at_least(name, rate, "1/s", 240.0));
}

void measure_maps(BenchFigures& figures, const Object& object, const PoseTable& poses,
                  std::vector<TriangleMap> maps) {
    const CoordinateMaps lookup(object.mesh, object.scene(), poses.angles, std::move(maps));
    const RayCaster rays(object.mesh);
    std::vector<double> times_ms;
    std::optional<MapCheck> check;
    // Every fifth pose: the check takes longer than the maps.
    for (std::size_t pose = 0; pose < poses.angles.size(); pose += 5) {
        const SteadyTime begin = std::chrono::steady_clock::now();
        const CoordinateImage image =
            coordinate_image(lookup, {static_cast<int>(pose)}, object.scene().view.image_px);
        times_ms.push_back(milliseconds_since(begin));
        const MapCheck one = check_map(image, rays, object.scene(), poses.angles[pose]);
        check = check ? worst_of(*check, one) : one;
    }
    figures.push_back({object.id + ", exact coordinates of a map, median", median(times_ms), "ms"});
    const BenchFigures checked = figures_of(*check, object.scene().view.image_px, object.id);
    figures.insert(figures.end(), checked.begin(), checked.end());
}

} // namespace

BenchFigures bench_lut(const BenchOptions& options) {
    const BenchScene scene = bench_scene(options);
    const PoseTable poses = poses_of(scene.protocol);
    BenchFigures figures;
    for (const Object& object : scene.objects) {
        DrawnMaps drawn;
        {
            const auto context = make_headless_context(options.context);
            drawn = draw_all(*context, object, poses);
            measure_drawing(figures, *context, object, poses, drawn);
        }
        measure_maps(figures, object, poses, std::move(drawn.maps));
        if (const auto differ = pixels_that_differ(object, poses)) {
            figures.push_back(at_most(object.id + ", pixels that differ between OSMesa and EGL",
                                      static_cast<double>(*differ), "px", 0.0));
        }
    }
    return figures;
}

} // namespace overt
