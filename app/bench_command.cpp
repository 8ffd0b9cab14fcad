#include "app/bench_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cache_folder.h"
#include "experiment/error.h"
#include "experiment/scene/sculptures/sculptures.h"

namespace overt {

namespace {

struct Benchmark {
    std::string_view name;
    BenchFigures (*measure)(const BenchOptions&);
};

constexpr Benchmark benchmarks[] = {{"lut", bench_lut},         {"reproject", bench_reproject},
                                    {"present", bench_present}, {"frames", bench_frames},
                                    {"bake", bench_bake},       {"export", bench_export}};

} // namespace

BenchScene bench_scene(const BenchOptions& options) {
    BenchScene scene;
    scene.protocol.name = "bench";
    scene.protocol.view.width_px = scene.protocol.view.height_px = options.size_px;
    if (!options.mesh.empty()) {
        SculptureSettings settings;
        settings.id = options.mesh.stem().string();
        settings.mesh = options.mesh;
        settings.up = options.up;
        scene.protocol.sculptures.push_back(std::move(settings));
    } else {
        for (const SculptureDescription& shipped : shipped_sculptures()) {
            SculptureSettings settings;
            settings.id = settings.shipped = std::string(shipped.name);
            scene.protocol.sculptures.push_back(std::move(settings));
        }
    }
    scene.sculptures = load_sculptures(scene.protocol, cache_folder());
    return scene;
}

int run_bench(const BenchOptions& options) {
    const auto chosen = std::find_if(std::begin(benchmarks), std::end(benchmarks),
                                     [&](const Benchmark& one) { return one.name == options.what; });
    if (chosen == std::end(benchmarks))
        throw InputError(fmt::format("there is no benchmark «{}»: see overt bench --help", options.what));
    const BenchFigures figures = chosen->measure(options);
    if (options.json) {
        fmt::print("{}\n", to_json(figures).dump(2));
    } else {
        print_table(figures);
    }
    return all_hold(figures) ? 0 : 1;
}

} // namespace overt
