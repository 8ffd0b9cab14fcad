#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "app/bench_command.h"
#include "render/coordinate_pass.h"

namespace overt {

namespace {

constexpr int repeats = 9;

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Times of drawing and reading back one map after another, sorted.
std::vector<double> times_of_drawing(const GlContext& context, const Sculpture& sculpture) {
    CoordinatePass pass(context, sculpture.scene.view.image_px);
    const MeshBuffers buffers(context, sculpture.mesh);
    std::vector<double> times_s;
    for (int i = 0; i <= repeats; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        pass.draw(buffers, sculpture.scene, {-20.0 + 5.0 * i});
        if (i > 0) // the first one also sets things up
            times_s.push_back(seconds_since(begin));
    }
    std::sort(times_s.begin(), times_s.end());
    return times_s;
}

} // namespace

BenchFigures bench_lut(const BenchOptions& options) {
    const BenchScene scene = bench_scene(options);
    BenchFigures figures;
    const auto context = make_headless_context(options.context);
    for (const Sculpture& sculpture : scene.sculptures) {
        const std::vector<double> times_s = times_of_drawing(*context, sculpture);
        figures.push_back({sculpture.id + ", draw and read back, least", 1e3 * times_s.front(), "ms"});
        figures.push_back(
            {sculpture.id + ", draw and read back, median", 1e3 * times_s[times_s.size() / 2], "ms"});
    }
    return figures;
}

} // namespace overt
